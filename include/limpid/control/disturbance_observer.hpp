// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/observer_step.hpp>
#include <limpid/control/q_filter.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <array>
#include <bit>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

namespace limpid {

/// Disturbance observer of each axis, Fig. 1: makes the device follow its nominal plant P_n = 1/(m s + b), eq. (5).
///
///     d_hat = Q [F_device + F_operator - P_n^-1 v]        F_device = command + d_hat
///
/// d_hat estimates F_xd of (4), what the device takes beyond m v' + b v. All forces are positive with the velocity, so
/// that the paper's F_d of (6), which resists it, is -F_device; a wall's command is -(K x + B v).
///
/// The velocity is that at the tick, F_device is held until the next one. Q's direct feed-through of the force that is
/// being computed is an algebraic loop; it is solved:  d_hat = (q_0 command + the rest)/(1 - q_0).
///
/// Between ticks x follows the law of its form at any spacing of the ticks: its state is that of the filters in
/// continuous time. The first call and the first after a longer pause start it at rest, with the estimate so far.
///
/// One Q serves all axes; for axes with different ones take an observer each.
/// @tparam Q     a QFilter of relative degree >= 1
/// @tparam Axes  number of independent axes
/// @realtime     no allocation, no throw; about n (n + 6) flops an axis for a Q of order n; some 10 n^3 more, or a
/// matrix
///               exponential, where a tick is not as long as the last one
template <QFilter Q, int Axes = 1>
class DisturbanceObserver {
  using Equation = detail::ObserverEquation<Q>;
  using Step = detail::ObserverStep<Q>;

 public:
  using Scalar = QFilterScalar<Q>;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  /// What the operator's hand does to the device, N, positive with the velocity.
  ///
  /// A type of its own without a default, because an observer that is not told of the hand takes it for a disturbance
  /// and cancels it: at a cut-off of 50 Hz the device answers a hand of 5 Hz with 0.099 of its nominal motion, and a
  /// press of -5 N against a virtual wall ends at x = 0. A device without a force sensor has no use for the observer.
  struct OperatorForce {
    Vector value;
    explicit OperatorForce(const Vector& newtons) noexcept : value{newtons} {}
  };

  /// What the device itself applied from the last tick to this one, behind limiters and saturation, N, positive with
  /// the velocity. A type of its own without a default, because an observer that takes for it the force that it asked
  /// for counts what a limiter took away as a disturbance, and winds up.
  struct AppliedForce {
    Vector value;
    explicit AppliedForce(const Vector& newtons) noexcept : value{newtons} {}
  };

  struct Settings {
    Q filter{};
    Vector mass = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< nominal m, kg, > 0
    /// Nominal b, N s/m, >= 0, its square finite.
    Vector damping = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    /// Tustin errs by 1.4e-4 for a Q of 50 Hz at 1 kHz, implicit Euler by 1.1e-2 and the step-invariant form by 0.1 to
    /// 0.2, in the same time (bench/time_error).
    ObserverForm form = ObserverForm::tustin;
    Duration longest_step = std::chrono::milliseconds(100);  ///< after a longer pause it starts again
  };

  struct Output {
    Vector force;        ///< to the device, N: command + disturbance; always finite
    Vector disturbance;  ///< d_hat, N; always finite
    /// not_finite, clock_backwards: the state and d_hat are the last ones, and the force is the command with them;
    /// where the command is not finite either, the last force
    Status status;
  };

  /// @throws std::invalid_argument  where a setting cannot serve, or the filter breaks a law of QFilterTraits
  explicit DisturbanceObserver(const Settings& settings)
      : equation_{settings.filter},
        form_{settings.form},
        longest_step_{settings.longest_step},
        damping_{settings.damping} {
    detail::check_q_filter(settings.filter, "DisturbanceObserver");
    expect(is_finite(settings.mass) && (settings.mass > Scalar{0}).all(), "DisturbanceObserver: mass", "finite and > 0",
           settings.mass);
    expect(is_finite(damping_) && (damping_ >= Scalar{0}).all(), "DisturbanceObserver: damping", "finite and >= 0",
           damping_);
    expect(is_finite(Vector(damping_ * damping_)), "DisturbanceObserver: damping", "small enough to be squared",
           damping_);
    expect(
        form_ == ObserverForm::tustin || form_ == ObserverForm::step_invariant || form_ == ObserverForm::backward_euler,
        "DisturbanceObserver: form", "one of ObserverForm", static_cast<int>(form_));
    expect(longest_step_ > Duration::zero(), "DisturbanceObserver: longest_step", "> 0 s", longest_step_);
    tau_ = QFilterTraits<Q>::time_constant(settings.filter);
    expect(in_seconds<Scalar>(longest_step_) / tau_ * std::numeric_limits<Scalar>::epsilon() < Scalar(0.125),
           "DisturbanceObserver: longest_step", "short enough for 1 - q_0 not to be lost in rounding", longest_step_);
    momentum_ = settings.mass / tau_;
    expect(is_finite(momentum_), "DisturbanceObserver: filter", "a finite mass over its time constant", tau_);
    direct_ = lanes(equation_.c[n - 1] * momentum_);
  }

  /// @param command   what the device is to be given, N, but for the disturbance
  /// @param hand      the operator's force at `now`
  /// @param velocity  at `now`, m/s
  /// @param applied   by the device since the last call; the first call does not ask for it
  [[nodiscard]] Output update(Time now, const Vector& command, const OperatorForce& hand, const Vector& velocity,
                              const AppliedForce& applied) noexcept {
    if (started_ && now <= last_) return held(command, Status::clock_backwards);
    const Duration length = elapsed(now, last_);
    if (!started_ || length > longest_step_) return start(now, command, hand.value, velocity);
    if (length != length_) return advance_other(now, length, command, hand.value, velocity, applied.value);
    if constexpr (std::floating_point<Scalar>) {
      return advance_flat(now, command, hand.value, velocity, applied.value);
    } else {
      return advance(all_states, now, lanes(command), lanes(hand.value), lanes(velocity), lanes(applied.value));
    }
  }

 private:
  static constexpr int n = QFilterTraits<Q>::order;
  using Axis = Lanes<Axes, Scalar>;      // one number of each axis, side by side
  using States = std::array<Axis, n>;    // x_0 to x_(n-1) of all axes
  using Column = std::array<Scalar, n>;  // the same for all axes
  // Told here, so that it depends on no compiler flags: a packet across two cache lines is read late.
  static constexpr std::size_t alignment =
      std::has_single_bit(sizeof(Axis)) && sizeof(Axis) <= 64 ? sizeof(Axis) : alignof(Scalar);

  static constexpr std::make_integer_sequence<std::size_t, n> all_states{};

  static Axis lanes(const Vector& values) noexcept { return to_lanes<Axes>(values); }

  // x_i of the tick less its term now_[i] F_device: what the device applied is known one tick later.
  [[nodiscard]] Axis state(std::size_t i, const Axis& hand, const Axis& velocity, const Axis& applied) const noexcept {
    return (now_[i] * hand + applied_[i] * applied + velocity_now_[i] * velocity) + ahead_[i];
  }

  // What this tick gives to x_i of the next one, where that comes after the same time.
  template <std::size_t... j>
  [[nodiscard]] Axis ahead(std::index_sequence<j...>, std::size_t i, const States& x, const Axis& hand,
                           const Axis& velocity) const noexcept {
    const Axis inputs = before_[i] * hand + velocity_before_[i] * velocity;
    return (inputs + ... + (Phi_[i][j] * x[j]));
  }

  template <std::size_t... i>
  [[nodiscard]] Output advance(std::index_sequence<i...>, Time now, const Axis& command, const Axis& hand,
                               const Axis& velocity, const Axis& applied) noexcept {
    const States x{state(i, hand, velocity, applied)...};
    const Axis d_hat = loop_ * (feedthrough_ * command + x[n - 1] - direct_ * velocity);
    const Axis force = command + d_hat;
    // Zero where all is finite: every input reaches a state, the command the force.
    if (!(((force + ... + x[i]) * Scalar{0}).sum() == Scalar{0})) return held(axes_of(command), Status::not_finite);
    keep(now, x, hand, velocity);
    force_ = force;
    d_hat_ = d_hat;
    return {axes_of(force), axes_of(d_hat), Status::ok};
  }

  void keep(Time now, const States& x, const Axis& hand, const Axis& velocity) noexcept {
    last_ = now;
    x_ = x;
    hand_ = hand;
    velocity_ = velocity;
    for (std::size_t i = 0; i < n; ++i) ahead_[i] = ahead(all_states, i, x, hand, velocity);
  }

  static Vector axes_of(const Axis& values) noexcept { return values.template head<Axes>(); }

  // `advance` with all that it calls, whatever the compiler has spent on inlining elsewhere; a scalar of many digits
  // has too much of that.
  [[nodiscard, gnu::flatten]] Output advance_flat(Time now, const Vector& command, const Vector& hand,
                                                  const Vector& velocity, const Vector& applied) noexcept {
    return advance(all_states, now, lanes(command), lanes(hand), lanes(velocity), lanes(applied));
  }

  // A tick of another length than the last one.
  [[nodiscard, gnu::noinline]] Output advance_other(Time now, Duration length, const Vector& command,
                                                    const Vector& hand, const Vector& velocity,
                                                    const Vector& applied) noexcept {
    const bool finite = is_finite(command) && is_finite(hand) && is_finite(velocity);
    const States x = x_, ahead = ahead_;
    const Duration last_length = length_;
    if (!finite || !set_step(length, applied)) return held(command, Status::not_finite);
    const Output output = advance(all_states, now, lanes(command), lanes(hand), lanes(velocity), lanes(applied));
    if (output.status == Status::ok) [[likely]]
      return output;
    set_law(last_length, step_of(last_length));  // `applied` is not in x_ where the call that brought it is refused
    x_ = x;
    ahead_ = ahead;
    return held(command, output.status);
  }

  [[nodiscard, gnu::noinline]] Output start(Time now, const Vector& command, const Vector& hand,
                                            const Vector& velocity) noexcept {
    const Vector d_hat = axes_of(d_hat_), force = command + d_hat;
    bool finite = is_finite(hand) && is_finite(force);
    States x = zero_states();
    for (int axis = 0; axis < Axes; ++axis) {
      const auto at_rest = equation_.at_rest(d_hat[axis], momentum_[axis] * velocity[axis]);
      for (std::size_t i = 0; i < n; ++i) x[i][axis] = at_rest[static_cast<int>(i)] - now_[i] * force[axis];
    }
    for (const Axis& x_i : x) finite = finite && is_finite(x_i);
    if (!finite) return held(command, Status::not_finite);
    started_ = true;
    keep(now, x, lanes(hand), lanes(velocity));
    force_ = lanes(force);
    return {force, d_hat, Status::ok};
  }

  [[nodiscard, gnu::noinline]] Output held(const Vector& command, Status status) noexcept {
    const Vector d_hat = axes_of(d_hat_), force = command + d_hat;
    if (!is_finite(force)) return {axes_of(force_), d_hat, status | Status::not_finite};
    force_ = lanes(force);
    return {force, d_hat, status};
  }

  static States zero_states() noexcept {
    States zeros;
    zeros.fill(Axis::Zero());
    return zeros;
  }

  // False, with nothing changed, where `applied` cannot be used.
  [[nodiscard]] bool set_step(Duration length, const Vector& applied) noexcept {
    const Step step = step_of(length);
    States x = x_;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += (now_[i] - step.force.now[static_cast<int>(i)]) * lanes(applied);  // the same state of the tick
      if (!is_finite(x[i])) return false;
    }
    set_law(length, step);
    keep(last_, x, Axis(hand_), Axis(velocity_));
    return true;
  }

  [[nodiscard]] Step step_of(Duration length) const noexcept {
    return Step(equation_, form_, in_seconds<Scalar>(length) / tau_);
  }

  void set_law(Duration length, const Step& step) noexcept {
    const auto at_applied = (step.Phi.lazyProduct(step.force.now) + step.force.before).eval();
    length_ = length;
    const Axis momentum = lanes(momentum_), damping = lanes(damping_);
    for (std::size_t i = 0; i < n; ++i) {
      const int row = static_cast<int>(i);
      now_[i] = step.force.now[row];
      before_[i] = step.force.before[row];
      applied_[i] = at_applied[row];
      velocity_now_[i] = momentum * step.momentum.now[row] - damping * now_[i];
      velocity_before_[i] = momentum * step.momentum.before[row] - damping * before_[i];
      for (std::size_t j = 0; j < n; ++j) Phi_[i][j] = step.Phi(row, static_cast<int>(j));
    }
    feedthrough_ = now_[n - 1];
    loop_ = Scalar{1} / (Scalar{1} - feedthrough_);
  }

  // For ticks of this length:
  alignas(alignment) States velocity_now_ = zero_states();
  alignas(alignment) States velocity_before_ = zero_states();
  alignas(alignment) Axis direct_ = Axis::Zero();  // c_(n-1) m/tau
  Column now_{}, before_{}, applied_{};
  std::array<Column, n> Phi_{};
  Scalar feedthrough_{0}, loop_{1};  // q_0, 1/(1 - q_0)
  Duration length_{};

  alignas(alignment) States ahead_ = zero_states();
  bool started_ = false;
  Time last_{};
  // Of the last tick. Its x is x_ + now_ F_device.
  alignas(alignment) States x_ = zero_states();
  alignas(alignment) Axis hand_ = Axis::Zero(), velocity_ = Axis::Zero();
  alignas(alignment) Axis force_ = Axis::Zero(), d_hat_ = Axis::Zero();  // last good ones

  Equation equation_;
  ObserverForm form_;
  Duration longest_step_;
  Scalar tau_{0};
  Vector damping_, momentum_{};  // b, m/tau
};

}  // namespace limpid
