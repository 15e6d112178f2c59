// SPDX-License-Identifier: MIT
#include "calibrate_tuning.hpp"

#include <limpid/core/expect.hpp>
#include <limpid/device/simulated_omni.hpp>

#include <algorithm>
#include <utility>

namespace limpid::examples {

namespace {

constexpr Duration tick_length = std::chrono::milliseconds(1);
constexpr double fading = 2;  // s

// From 0 to 1 over [0, 1], without a step of its first two derivatives; and those.
struct Rise {
  double value = 1, slope = 0, bend = 0;
};

Rise rise(double part) {
  if (part >= 1) return {};
  const double p = std::max(part, 0.0), p2 = p * p, p3 = p2 * p;
  return {p3 * (10 - 15 * p + 6 * p2), 30 * p2 * (1 - 2 * p + p2), 60 * p * (1 - 3 * p + 2 * p2)};
}

}  // namespace

TuningTask::TuningTask(const Settings& settings)
    : settings_{settings}, controller_{tuned_controller(settings.theta0)}, limiter_{settings.limiter} {
  expect(settings.length > Duration::zero(), "TuningTask: length", "> 0 s", settings.length);
  expect(settings.blend >= Duration::zero(), "TuningTask: blend", ">= 0 s", settings.blend);
  record_.reserve(static_cast<std::size_t>(settings.length / tick_length) + 1000);
}

DesiredJoints<3> TuningTask::wanted(double t) const noexcept {
  DesiredJoints<3> sines = tuning_reference(t, tuning_pose());
  if (settings_.blend == Duration::zero()) return sines;
  const double blend = in_seconds(settings_.blend);
  const auto [s, slope, bend] = rise(t / blend);
  const Eigen::Vector3d way = sines.q - start_;
  return {start_ + s * way, s * sines.qdot + slope / blend * way,
          s * sines.qddot + 2 * slope / blend * sines.qdot + bend / (blend * blend) * way};
}

SafetyLimiter<Omni<>>::Result TuningTask::tick(Time now, const DeviceState<3>& seen, Time taken) noexcept {
  if (!std::exchange(begun_, true)) {
    begin_ = now;
    first_taken_ = taken;
    last_taken_ = taken - tick_length;
    start_ = seen.q;
  }
  const double t = in_seconds(now - begin_), beyond = t - in_seconds(settings_.length);
  if (beyond > 0) return fade(now, seen, 1 - beyond / fading);
  const DesiredJoints<3> target = wanted(t);
  const auto [tau, said] = controller_.update(now, seen.joint_state(), target, Eigen::Vector3d::Zero(), applied_);
  const auto safe = limiter_.limit(now, seen.joint_state(), tau, seen.status | said);
  applied_ = last_ = safe.torque.value();
  status_ |= safe.status;
  if (record_.size() < record_.capacity() && std::exchange(last_taken_, taken) != taken) {
    record_.push_back({in_seconds(taken - first_taken_), seen.q, applied_, seen.q - target.q, controller_.theta_hat()});
  }
  return safe;
}

// So that the arm does not fall when the run is over.
SafetyLimiter<Omni<>>::Result TuningTask::fade(Time now, const DeviceState<3>& seen, double part) noexcept {
  done_ = part <= 0;
  return limiter_.limit(now, seen.joint_state(), std::max(part, 0.0) * last_, seen.status);
}

TuningTask simulate_tuning(const TuningTask::Settings& settings) {
  const Eigen::Vector3d q0 =
      settings.blend == Duration::zero() ? tuning_reference(0, tuning_pose()).q : Eigen::Vector3d(tuning_pose());
  SimulatedOmni<> arm({.q0 = q0, .realism = Realism::realistic});
  TuningTask task(settings);
  for (Time now{0}; now <= settings.length; now += tick_length) {
    (void)arm.advance(now, Eigen::Vector3d::Zero());
    (void)arm.write(task.tick(now, arm.read(now), now).torque);
  }
  return task;
}

}  // namespace limpid::examples
