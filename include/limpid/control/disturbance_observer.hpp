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
    Vector mass = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());     ///< nominal m, kg, > 0
    Vector damping = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< nominal b, N s/m, >= 0
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
    expect(longest_step_ > Duration::zero(), "DisturbanceObserver: longest_step", "> 0 s", longest_step_);
    tau_ = QFilterTraits<Q>::time_constant(settings.filter);
    momentum_ = settings.mass / tau_;
    expect(is_finite(momentum_), "DisturbanceObserver: filter", "a finite mass over its time constant", tau_);
    direct_ = equation_.c[n - 1] * momentum_;
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
    if (length != length_) {
      if (!is_finite(command) || !is_finite(hand.value) || !is_finite(velocity) || !set_step(length, applied.value)) {
        return held(command, Status::not_finite);
      }
    }
    return advance(all_axes, now, command, hand.value, velocity, applied.value);
  }

 private:
  static constexpr int n = QFilterTraits<Q>::order;
  static constexpr int rows = lanes_for<Scalar>(n);  // the states of an axis fill a packet
  using States = Eigen::Array<Scalar, rows * Axes, 1, Eigen::DontAlign>;
  using Column = Eigen::Array<Scalar, rows, 1, Eigen::DontAlign>;
  // Told here, so that it depends on no compiler flags: a packet across two cache lines is read late.
  static constexpr std::size_t alignment =
      std::has_single_bit(sizeof(Column)) && sizeof(Column) <= 64 ? sizeof(Column) : alignof(Scalar);

  static auto of(auto& states, int axis) noexcept { return states.template segment<rows>(rows * axis); }

  static constexpr std::make_integer_sequence<int, Axes> all_axes{};
  static constexpr std::make_integer_sequence<int, n> all_states{};

  struct OfAxis {
    Column x;  // what of the state of the tick does not depend on what the device applies from then on
    Scalar force, d_hat;

    // Zeros where all is finite: every input reaches all of x, the command the force.
    [[nodiscard]] EIGEN_ALWAYS_INLINE Column check() const noexcept { return (x + force) * Scalar{0}; }
  };

  // The state of a tick is x_ + now_ F_device, where what the device applied is known one tick later.
  template <int... i>
  [[nodiscard]] EIGEN_ALWAYS_INLINE Column next_state(std::integer_sequence<int, i...>, int axis, const Scalar& hand,
                                                      const Scalar& velocity, const Scalar& applied) const noexcept {
    const Column inputs = now_ * hand + before_ * hand_[axis] + applied_ * applied +
                          of(velocity_now_, axis) * velocity + of(velocity_before_, axis) * velocity_[axis];
    return (inputs + ... + (Phi_[i] * x_[rows * axis + i]));
  }

  [[nodiscard]] EIGEN_ALWAYS_INLINE OfAxis observe(int axis, const Scalar& command, const Scalar& hand,
                                                   const Scalar& velocity, const Scalar& applied) const noexcept {
    const Column x = next_state(all_states, axis, hand, velocity, applied);
    const Scalar rest = x[n - 1] - direct_[axis] * velocity;
    const Scalar d_hat = loop_ * (feedthrough_ * command + rest);
    return {x, command + d_hat, d_hat};
  }

  // Axis by axis without a loop, since compilers leave one of three passes as it is, and entry by entry: what was
  // written so and is read as a packet would have to wait for memory.
  template <int... axis>
  [[nodiscard]] EIGEN_ALWAYS_INLINE Output advance(std::integer_sequence<int, axis...>, Time now, const Vector& command,
                                                   const Vector& hand, const Vector& velocity,
                                                   const Vector& applied) noexcept {
    const std::array<OfAxis, Axes> next{observe(axis, command[axis], hand[axis], velocity[axis], applied[axis])...};
    if (!((next[axis].check() + ...).sum() == Scalar{0})) return held(command, Status::not_finite);
    Output output;
    output.status = Status::ok;
    last_ = now;
    (keep(axis, next[axis], hand[axis], velocity[axis], output), ...);
    return output;
  }

  EIGEN_ALWAYS_INLINE void keep(int axis, const OfAxis& next, const Scalar& hand, const Scalar& velocity,
                                Output& output) noexcept {
    of(x_, axis) = next.x;
    hand_[axis] = hand;
    velocity_[axis] = velocity;
    output.force[axis] = force_[axis] = next.force;
    output.disturbance[axis] = d_hat_[axis] = next.d_hat;
  }

  [[nodiscard, gnu::noinline]] Output start(Time now, const Vector& command, const Vector& hand,
                                            const Vector& velocity) noexcept {
    const Vector force = command + d_hat_;
    States x = States::Zero();
    for (int axis = 0; axis < Axes; ++axis) {
      const auto at_rest = equation_.at_rest(d_hat_[axis], momentum_[axis] * velocity[axis]);
      of(x, axis) = padded(at_rest) - now_ * force[axis];
    }
    if (!is_finite(x) || !is_finite(hand) || !is_finite(force)) return held(command, Status::not_finite);
    started_ = true;
    last_ = now;
    x_ = x;
    hand_ = hand;
    velocity_ = velocity;
    force_ = force;
    return {force, d_hat_, Status::ok};
  }

  [[nodiscard, gnu::noinline]] Output held(const Vector& command, Status status) noexcept {
    const Vector force = command + d_hat_;
    if (is_finite(force)) force_ = force;
    return {force_, d_hat_, is_finite(force) ? status : status | Status::not_finite};
  }

  static Column padded(const typename Equation::Column& column) noexcept {
    Column full = Column::Zero();
    full.template head<n>() = column.array();
    return full;
  }

  // False, with nothing changed, where `applied` cannot be used.
  [[nodiscard, gnu::noinline]] bool set_step(Duration length, const Vector& applied) noexcept {
    const Step step(equation_, form_, in_seconds<Scalar>(length) / tau_);
    const Column now = padded(step.force.now);
    States x = x_;
    for (int axis = 0; axis < Axes; ++axis) of(x, axis) += (now_ - now) * applied[axis];  // the same state of the tick
    if (!is_finite(x)) return false;
    x_ = x;
    for (int axis = 0; axis < Axes; ++axis) {
      of(velocity_now_, axis) = padded(momentum_[axis] * step.momentum.now - damping_[axis] * step.force.now);
      of(velocity_before_, axis) = padded(momentum_[axis] * step.momentum.before - damping_[axis] * step.force.before);
    }
    for (int i = 0; i < n; ++i) Phi_[static_cast<std::size_t>(i)] = padded(step.Phi.col(i));
    length_ = length;
    now_ = now;
    before_ = padded(step.force.before);
    applied_ = padded(step.Phi.lazyProduct(step.force.now) + step.force.before);
    feedthrough_ = step.force.now[n - 1];
    loop_ = Scalar{1} / (Scalar{1} - feedthrough_);
    return true;
  }

  alignas(alignment) States x_ = States::Zero();
  alignas(alignment) std::array<Column, n> Phi_;
  alignas(alignment) Column now_ = Column::Zero();
  alignas(alignment) Column before_ = Column::Zero();
  alignas(alignment) Column applied_ = Column::Zero();
  alignas(alignment) States velocity_now_ = States::Zero();
  alignas(alignment) States velocity_before_ = States::Zero();
  Vector direct_;                    // c_(n-1) m/tau
  Scalar feedthrough_{0}, loop_{1};  // q_0, 1/(1 - q_0)
  Duration length_{};                // of the tick for which these are

  bool started_ = false;
  Time last_{};
  Vector hand_ = Vector::Zero(), velocity_ = Vector::Zero();  // at the last tick
  Vector force_ = Vector::Zero(), d_hat_ = Vector::Zero();    // last good ones

  Equation equation_;
  ObserverForm form_;
  Duration longest_step_;
  Scalar tau_{0};
  Vector damping_, momentum_{};  // b, m/tau
};

}  // namespace limpid
