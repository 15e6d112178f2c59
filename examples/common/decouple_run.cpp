// SPDX-License-Identifier: MIT
#include "decouple_device.hpp"

#include <limpid/control/disturbance_observer.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/device/simulated_five_bar.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

namespace limpid::examples {

namespace {

using namespace std::chrono_literals;
using Vector = Eigen::Array2d;

constexpr Duration tick = 1ms;

// What of the operator's force, the velocity and the force applied in the last tick the device is to apply, N.
using Control = std::function<Vector(Time, const Vector& hand, const Vector& v, const Vector& applied)>;

template <QFilter Q>
Control observed_by(const Q& filter) {
  using Observer = DisturbanceObserver<Q, 2>;
  Observer observer({.filter = filter,
                     .mass = Vector::Constant(nominal_mass),
                     .damping = Vector::Constant(nominal_damping),
                     .form = ObserverForm::tustin});
  return [observer](Time now, const Vector& hand, const Vector& v, const Vector& applied) mutable -> Vector {
    const Vector command = Vector::Zero();  // the hand alone moves the device
    return observer
        .update(now, command, typename Observer::OperatorForce(hand), v, typename Observer::AppliedForce(applied))
        .force;
  };
}

Control control_of(const std::optional<Observer>& observer) {
  if (!observer) return [](Time, const Vector&, const Vector&, const Vector&) -> Vector { return Vector::Zero(); };
  switch (observer->kind) {
    case QKind::butterworth:
      return observed_by(ButterworthQ<>{.cutoff = observer->cutoff});
    case QKind::umeno_hori:
      return observed_by(UmenoHoriQ<>{.cutoff = observer->cutoff});
    default:
      return observed_by(FirstOrderQ<>{.cutoff = observer->cutoff});
  }
}

// The parts of vx and vy at the force's frequency.
struct Correlation {
  std::complex<double> x, y;

  void add(double angle, const Vector& v) {
    x += std::polar(v[0], -angle);
    y += std::polar(v[1], -angle);
  }
};

}  // namespace

DecoupleTrace run(const DecoupleRun& what) {
  const FiveBar<> robot;
  SimulatedFiveBar<> device({.realism = what.realism});
  // The start is 0.05 rad from a limit, nearer than the limiter's default margin.
  SafetyLimiter<FiveBar<>> limiter({.robot = robot, .joint_margin = 0.01, .joint_band = 0.01});
  const Control control = control_of(what.observer);
  const double omega = 2 * std::numbers::pi * what.frequency, T = in_seconds(tick);
  const double last = std::max(1.0, std::floor(what.frequency)) / what.frequency;  // whole periods, about a second
  const int settled = 2500, ticks = settled + static_cast<int>(std::lround(last / T));
  const Eigen::Vector3d from = robot.at(device.true_state().q).position();
  Vector applied = Vector::Zero();
  Correlation correlation;
  DecoupleTrace trace;
  double least = 0, greatest = 0;
  for (int k = 0; k < ticks; ++k) {
    const Time now = k * tick;
    const double angle = omega * k * T;
    const Vector hand(-what.force * std::cos(angle), 0);
    trace.status |= device.advance(now, {hand[0], hand[1], 0});
    const auto seen = device.read(now);
    const auto is = device.true_state();
    const auto pose = robot.at(is.q);
    const Eigen::Vector3d tip = pose.position() - from;
    trace.t.push_back(k * T);
    trace.x.push_back(tip[0]);
    trace.y.push_back(tip[1]);
    if (k == settled) least = greatest = tip[1];
    if (k >= settled) {
      correlation.add(angle, (pose.jacobian() * is.qdot).head<2>().array());
      least = std::min(least, tip[1]);
      greatest = std::max(greatest, tip[1]);
    }
    const Eigen::Matrix2d J = robot.at(seen.q).jacobian().topRows<2>();
    const Vector v = (J * seen.qdot).array();
    const Vector wanted = control(now, hand, v, applied);
    const auto safe = limiter.limit(now, seen.joint_state(), J.transpose() * wanted.matrix(), seen.status);
    applied = J.transpose().inverse() * safe.torque.value();
    trace.status |= safe.status | device.write(safe.torque);
    if (has(trace.status, Status::fault | Status::not_finite | Status::clock_backwards)) return trace;
  }
  trace.ratio = std::abs(correlation.y) / std::abs(correlation.x);
  trace.y_range = greatest - least;
  trace.ended = true;
  return trace;
}

}  // namespace limpid::examples
