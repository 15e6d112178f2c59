// SPDX-License-Identifier: MIT
#include "live_device.hpp"
#include "palpation_arm.hpp"

namespace limpid::examples {

namespace {

// Moves by the machine's clock.
class SimulatedLive : public LiveDevice {
 public:
  explicit SimulatedLive(const Scene& scene) : device_(make_device(scene)) {}

  void prepare(const std::stop_token&) override {}
  [[nodiscard]] std::optional<Time> grid(Duration) const override { return {}; }
  bool settle(Time) noexcept override { return true; }
  DeviceState<> read(Time now, const Eigen::Vector3d& hand) noexcept override {
    const Status status = device_.advance(now, hand);
    DeviceState<> seen = device_.read(now);
    seen.status |= status;
    return seen;
  }
  Status write(const SafeTorque<3>& torque) noexcept override { return device_.write(torque); }
  [[nodiscard]] JointState<3> joints() const noexcept override { return device_.true_state(); }
  [[nodiscard]] LiveDeviceReport report() const override { return {}; }

 private:
  SimulatedOmni<> device_;
};

}  // namespace

std::unique_ptr<LiveDevice> make_live_device(const Scene& scene) {
  if (scene.live->device == DeviceKind::usb) return make_usb_device(*scene.live);
  return std::make_unique<SimulatedLive>(scene);
}

}  // namespace limpid::examples
