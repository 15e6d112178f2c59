// SPDX-License-Identifier: MIT
#include "calibrate_ramp.hpp"

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/robot/omni_device.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace limpid::examples {

namespace {

constexpr Duration tick = std::chrono::milliseconds(1);
constexpr int ticks_a_sample = 10;

// 0, amplitude, -amplitude, amplitude; its slope is `rate`.
double triangle(double t, const SimulatedRamp& ramp) {
  const double way = t * ramp.rate, A = ramp.amplitude;
  if (way < A) return way;
  return way < 3 * A ? 2 * A - way : way - 4 * A;
}

// The limiter stands in the path of every torque; beyond the motors' limits is where the ramp is to go.
SafetyLimiter<Omni<>> ramp_limiter(double amplitude) {
  SafetyLimiter<Omni<>>::Settings settings;
  settings.safety_factor = 1;
  settings.torque_limit = OmniDevice<>::torque(Eigen::Vector3d::Constant(amplitude)).cwiseAbs();
  return SafetyLimiter<Omni<>>(settings);
}

// tau = slope command + intercept of its side, by least squares.
Eigen::Vector3d fit(const std::vector<RampSample>& samples) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [command, measured, rising] : samples) {
    const Eigen::Vector3d row(command, rising ? 1 : 0, rising ? 0 : 1);
    information += row * row.transpose();
    sum += row * measured;
  }
  return information.ldlt().solve(sum);
}

struct Plateaus {
  double at_most = 0, at_least = 0;  // measured torque at the ends of the command, N m
  bool flat = false;                 // whether it no longer follows the command there
};

Plateaus plateaus_of(const std::vector<RampSample>& loop, double amplitude) {
  const auto mean = [&](bool rising, double from, double to) {
    double sum = 0, count = 0;
    for (const auto& each : loop) {
      if (each.rising != rising || each.command < from || each.command > to) continue;
      sum += each.measured;
      ++count;
    }
    expect(count > 0, "evaluate_ramp: samples", "both sides of a loop, to both ends of the command", count);
    return sum / count;
  };
  const double A = amplitude, end = 0.95 * A, before = 0.9 * A;
  Plateaus found{mean(true, end, A), mean(false, -A, -end), false};
  const double rise =
      std::abs(found.at_most - mean(true, before, end)) + std::abs(found.at_least - mean(false, -end, -before));
  // for 5 % of the command each: following it would be a 20th of all
  found.flat = rise < 0.002 * std::abs(found.at_most - found.at_least);
  return found;
}

}  // namespace

RampResult evaluate_ramp(const std::vector<RampSample>& samples) {
  double amplitude = 0;
  for (const auto& each : samples) amplitude = std::max(amplitude, std::abs(each.command));
  expect(samples.size() >= 100 && amplitude > 0, "evaluate_ramp: samples", "100 of a loop or more", samples.size());
  const Plateaus ends = plateaus_of(samples, amplitude);
  const double range = ends.at_most - ends.at_least;
  // Where it slides: beyond the reversal, where it sticks, and before the flat end.
  std::vector<RampSample> sliding;
  for (const auto& each : samples) {
    const double part = (each.measured - ends.at_least) / range, way = each.rising ? part : 1 - part;
    if (way > 0.4 && way < 0.9) sliding.push_back(each);
  }
  expect(sliding.size() >= 20, "evaluate_ramp: samples", "20 or more where the joint slides", sliding.size());
  const Eigen::Vector3d found = fit(sliding);
  RampResult result;
  result.conversion = found[0];
  result.offset = (found[1] + found[2]) / 2;
  result.friction = (found[0] > 0 ? 1 : -1) * (found[2] - found[1]) / 2;
  result.limit = ends.flat ? std::abs(range) / 2 + result.friction : std::numeric_limits<double>::quiet_NaN();
  return result;
}

std::vector<RampSample> simulate_ramp(int joint, const SimulatedRamp& ramp) {
  SimulatedOmni<> arm({.realism = Realism::realistic});
  SafetyLimiter<Omni<>> limiter = ramp_limiter(ramp.amplitude);
  const Omni<> model;
  const Eigen::Vector3d held_at = model.at(arm.true_state().q).position();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // of the sensor on the tip, N
  std::vector<RampSample> loop;
  double last = 0;
  for (std::int64_t i = 0;; ++i) {
    const Time now = i * tick;
    const double t = in_seconds(now), command = triangle(t, ramp);
    if (t * ramp.rate >= 5 * ramp.amplitude) return loop;
    (void)arm.advance(now, force);
    const DeviceState<3> seen = arm.read(now);
    const auto pose = model.at(arm.true_state().q);
    force = ramp.stiffness * (held_at - pose.position()) - ramp.damping * (pose.jacobian() * arm.true_state().qdot);
    const bool counts = t * ramp.rate >= ramp.amplitude;  // the way to the loop is none of it
    if (counts && i % ticks_a_sample == 0) {
      const Eigen::Vector3d measured = -model.at(seen.q).jacobian().transpose() * force;
      loop.push_back({command, measured[joint], command > last});
    }
    last = command;
    const Eigen::Vector3d torque = OmniDevice<>::torque(command * Eigen::Vector3d::Unit(joint));
    (void)arm.write(limiter.limit(now, seen.joint_state(), torque).torque);
  }
}

}  // namespace limpid::examples
