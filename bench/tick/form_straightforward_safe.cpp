// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

namespace {

/// The straightforward tick before the library's limiter; the arm's parameters stay while the device has not the torque
/// asked.
class SafeTick : public StraightforwardTick {
 public:
  using StraightforwardTick::StraightforwardTick;

  SafeTorque<3> safe_step(Time now, const TickInput<3>& in) {
    const Eigen::Vector3d wanted = step(now, in.F_h, in.tool, in.device.q, in.device.qdot, obeyed_);
    const auto [torque, status] = limiter_.limit(now, in.device.joint_state(), wanted);
    obeyed_ = torque.value() == wanted;
    return torque;
  }

 private:
  SafetyLimiter<Omni<>> limiter_{SafetyLimiter<Omni<>>::Settings{}};
  bool obeyed_ = true;
};

}  // namespace

Form straightforward_safe_form() {
  return Form::of<double>("straightforward_with_safety", SafeTick(TickParts<double>::settings()),
                          [](auto& tick, Time now, const auto& in) { return tick.safe_step(now, in); });
}

}  // namespace limpid::bench
