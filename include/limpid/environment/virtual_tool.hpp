// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/dormand_prince.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace limpid {

/// The ideal trajectory: the tool (3.29) pressed into an environment with parameters theta by the operator's force F_h.
///
///     m_t x'' + b_t x' + k_t (x - anchor) = F_h - F_e(theta; x, x')
///
/// Exact for the stated law of F_h between ticks where the environment is linear and its axes do not feel each other;
/// else integrated to a local error of 1e-12 of position and velocity, or of 1 mm and 1 mm/s where they are smaller (or
/// as near as the scalar allows).
/// @tparam E  the environment
/// @realtime  no allocation, no throw; linear: 20 flops an axis, 120 more where a tick is not as long as the last one;
///            else bounded by DormandPrince, for simulation
template <Environment E>
class VirtualTool {
  using Traits = EnvironmentTraits<E>;

 public:
  using Scalar = typename Traits::Scalar;
  static constexpr int axes = Traits::axes;
  using Vector = EnvironmentVector<E>;
  using Theta = EnvironmentTheta<E>;
  using State = ToolState<axes, Scalar>;

  struct Settings {
    E environment{};
    Theta theta = Theta::Zero();  ///< the environment's parameters, in its units
    Tool<axes, Scalar> tool{};
    Intersample intersample = Intersample::linear;  ///< law of F_h between ticks
    Vector x0 = Vector::Zero();                     ///< position at the start, m
    Vector v0 = Vector::Zero();                     ///< velocity at the start, m/s
  };

  struct Output {
    State value;    ///< always finite
    Status status;  ///< anything but `ok`: the call changed nothing, but for a tool that is stopped, see `advance`
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit VirtualTool(const Settings& settings) : settings_{settings} {
    settings.tool.check();
    expect(is_finite(settings.theta), "VirtualTool: theta", "finite", settings.theta);
    expect(is_finite(settings.x0), "VirtualTool: x0", "finite", settings.x0);
    expect(is_finite(settings.v0), "VirtualTool: v0", "finite", settings.v0);
    const Tangents<axes, Scalar> slopes =
        Traits::tangent(settings.environment, settings.theta, settings.x0, settings.v0);
    expect(is_finite(Vector((slopes.stiffness + settings.tool.stiffness) / settings.tool.mass)) &&
               is_finite(Vector((slopes.damping + settings.tool.damping) / settings.tool.mass)),
           "VirtualTool: theta", "a finite stiffness and damping over the tool's mass", settings.theta);
    state_ = completed(settings.x0, settings.v0, Vector::Zero());
    expect(is_finite(state_), "VirtualTool: x0, v0", "a finite force of the environment", "one that is not");
  }

  /// At the last tick; before the first one the start, without an operator's force.
  [[nodiscard]] const State& state() const noexcept { return state_; }

  /// Moves to `now`.
  /// @param F_h  the operator's force at `now`, N. The first call sets the clock and the force; the tool stays.
  /// @return status  `not_finite` (F_h, or where it would lead), `clock_backwards`, `limited` (too many steps). Where
  ///                 the integrator could not follow the motion in the last call either, such as after a pause of half
  ///                 a second of a light tool, the tool is stopped where it was, and moves on from there, from `now`
  [[nodiscard]] Output advance(Time now, const Vector& F_h) noexcept {
    if (!is_finite(F_h)) return {state_, Status::not_finite};
    Vector x = state_.x, v = state_.v;
    Status status = Status::ok;
    if (started_) {
      if (now <= now_) return {state_, Status::clock_backwards};
      const Vector& end = settings_.intersample == Intersample::linear ? F_h : F_h_;
      status = move(elapsed(now, now_), F_h_, end, x, v);
      const bool again = std::exchange(lost_, status != Status::ok);
      if (lost_ && !again) return {state_, status};
      if (lost_) v.setZero();  // else what held it up would do so for ever
    }
    const State next = completed(x, v, F_h);
    if (!is_finite(next)) return {state_, Status::not_finite};
    state_ = next;
    F_h_ = F_h;
    now_ = now;
    started_ = true;
    return {state_, status};
  }

 private:
  static constexpr bool exact = LinearEnvironment<E> && DecoupledEnvironment<E>;

  struct ExactStep {
    Duration length{};
    SecondOrderStep<axes, Scalar> step;
    Vector rest = Vector::Zero();  // the constant part of the acceleration: anchor and offset, m/s^2
  };
  using Both = Eigen::Array<Scalar, 2 * axes, 1>;  // x above v
  struct Integrator {
    DormandPrince<Both> method{{.absolute = tolerance() / 1000, .relative = tolerance()}};
  };

  static Scalar tolerance() {
    return std::max(Scalar(1) / Scalar(1'000'000'000'000), Scalar(16) * std::numeric_limits<Scalar>::epsilon());
  }

  [[nodiscard]] Vector environment_force(const Vector& x, const Vector& v) const noexcept {
    return Traits::force(settings_.environment, settings_.theta, x, v);
  }

  // (3.29) solved for x''
  [[nodiscard]] Vector acceleration(const Vector& x, const Vector& v, const Vector& F_h,
                                    const Vector& F_e) const noexcept {
    const Tool<axes, Scalar>& tool = settings_.tool;
    return (F_h - F_e - tool.damping * v - tool.stiffness * (x - tool.anchor)) / tool.mass;
  }

  [[nodiscard]] State completed(const Vector& x, const Vector& v, const Vector& F_h) const noexcept {
    const Vector F_e = environment_force(x, v);
    return {x, v, acceleration(x, v, F_h, F_e), F_e};
  }

  static Both stacked(const Vector& above, const Vector& below) noexcept {
    Both both;
    both.template head<axes>() = above;
    both.template tail<axes>() = below;
    return both;
  }

  // Takes (x, v) over a tick on which the operator's force goes from F0 to F1.
  Status move(Duration length, const Vector& F0, const Vector& F1, Vector& x, Vector& v) noexcept {
    if constexpr (exact) {
      if (length != stepper_.length) set_step(length);
      stepper_.step.advance(x, v, F0 / settings_.tool.mass + stepper_.rest, F1 / settings_.tool.mass + stepper_.rest);
      return Status::ok;
    } else {
      const Scalar h = in_seconds<Scalar>(length);
      Both both = stacked(x, v);
      const Status status = stepper_.method.advance(both, Scalar{0}, h, [&](const Scalar& t, const Both& y) -> Both {
        const Vector at = y.template head<axes>(), rate = y.template tail<axes>();
        return stacked(rate, acceleration(at, rate, F0 + (F1 - F0) * (t / h), environment_force(at, rate)));
      });
      x = both.template head<axes>();
      v = both.template tail<axes>();
      return status;
    }
  }

  void set_step(Duration length) noexcept {
    const Tool<axes, Scalar>& tool = settings_.tool;
    const Vector origin = Vector::Zero();
    const Tangents<axes, Scalar> slopes = Traits::tangent(settings_.environment, settings_.theta, origin, origin);
    stepper_.length = length;
    stepper_.step.set((slopes.stiffness + tool.stiffness) / tool.mass, (slopes.damping + tool.damping) / tool.mass,
                      in_seconds<Scalar>(length));
    stepper_.rest = acceleration(origin, origin, origin, environment_force(origin, origin));
  }

  Settings settings_;
  State state_;
  Vector F_h_ = Vector::Zero();  // at the last tick
  Time now_{};
  bool started_ = false, lost_ = false;  // lost: the last call could not follow the motion
  std::conditional_t<exact, ExactStep, Integrator> stepper_{};
};

}  // namespace limpid
