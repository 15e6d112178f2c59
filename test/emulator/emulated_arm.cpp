// SPDX-License-Identifier: MIT
#include "emulated_arm.hpp"

#include "omni_board.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace limpid::emulator {
namespace {

constexpr double step = 2 * std::numbers::pi / 15000;

EmulatedArm::Vector unlimited(double value) { return EmulatedArm::Vector::Constant(value); }

// u of a 12-bit converter in [-1, 1]
double drive(std::uint16_t dac) {
  if (dac == OmniBoard::zero_dac) return 0;
  return 2 * std::min<double>(dac, 4095) / 4095 - 1;
}

std::int16_t wrapped(double count) { return static_cast<std::int16_t>(std::llround(count) & 0xffff); }

}  // namespace

JointLimits<3> EmulatedArm::Unlimited::limits() noexcept {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {.lower = unlimited(-infinity),
          .upper = unlimited(infinity),
          .torque = unlimited(1e6),
          .static_friction = unlimited(0)};
}

EmulatedArm::EmulatedArm(const Settings& settings)
    : settings_{settings},
      arm_{{.q0 = settings.q0, .realism = settings.realism, .coupling = settings.coupling}},
      gate_{{.safety_factor = 1,
             .slew = unlimited(1e12),
             .joint_margin = 0,
             .joint_band = 0,
             .workspace = false,
             .joint_overshoot = 1e9,
             .longest_gap = Duration::max(),
             .upstream_faults = Status::ok}},
      zero_{settings.home} {
  (void)gate_.limit(now_, arm_.true_state(), unlimited(0));
  (void)arm_.advance(now_, unlimited(0));
}

void EmulatedArm::write(const std::array<std::uint16_t, 3>& dac) {
  const Vector command(drive(dac[0]), drive(dac[1]), drive(dac[2]));
  torque_ = OmniDevice<>::torque(command.cwiseProduct(settings_.full_scale));
  if (settings_.realism != Realism::realistic) return;
  const Vector most = Omni<>{}.limits().torque;
  torque_ = torque_.cwiseMin(most).cwiseMax(-most);
}

void EmulatedArm::advance(Duration dt) {
  if (!free_) return;
  if (!std::exchange(started_, true)) let_go_ = now_;
  now_ += dt;
  (void)arm_.write(gate_.limit(now_, arm_.true_state(), torque_).torque);
  F_h_ = settings_.force ? settings_.force(in_seconds(now_ - let_go_)) : Vector::Zero();
  (void)arm_.advance(now_, F_h_);
}

void EmulatedArm::zero_counts() { zero_ = OmniDevice<>::device_joints(arm_.true_state().q); }

EmulatedArm::Counts EmulatedArm::counts() const {
  const Vector turned = (OmniDevice<>::device_joints(arm_.true_state().q) - zero_) / step;
  return {wrapped(turned[0]), wrapped(-turned[1]), wrapped(turned[2])};
}

}  // namespace limpid::emulator
