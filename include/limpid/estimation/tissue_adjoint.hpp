// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace limpid {

/// What the end of a tool's path in a tissue has of everything before it: three quantities, their derivatives by the
/// state and by all parameters of the law, backwards from step to step.
///
/// The adjoint of the linearised motion, m x'' = F_h - F_e, with the tangent of the law half-way: exact for a tangent
/// that is constant and forces that are linear over the step, as in (4.25). What the law remembers of the path, the
/// branches' stretches and the bristle, follows the mean velocity of a step, and pushes back. Where contact begins or
/// ends with a jump of the force, an instant that moves by dt leaves v another by jump/m dt.
/// @tparam Law  TissueLaw
/// @realtime    no allocation, no throw for built-in scalars; some 300 flops a step
template <typename Law>
class TissueAdjoint {
 public:
  using Scalar = typename Law::Scalar;
  using State = typename Law::State;
  using Point = typename Law::Point;
  using Rows = Eigen::Matrix<Scalar, Law::states, 3>;  // of the quantities, transposed: a column each
  using Three = Eigen::Array<Scalar, 1, 3>;

  /// The quantities are x, v and the force that is remembered, all at the end.
  void begin(const Law& law, const State& s) noexcept {
    x_ << Scalar{1}, Scalar{0}, Scalar{0};
    v_ << Scalar{0}, Scalar{1}, Scalar{0};
    const Three force(Scalar{0}, Scalar{0}, Scalar{1});
    for (int i = 0; i < Law::branches; ++i) chi_[std::size_t(i)] = force * stiffness(law, s, i);
    bristle_ = force * friction(law, s);
    residual_ = force;
    at_start_.setZero();
    whole_.setZero();
  }

  /// Over one piece of the path, backwards; adds what the force at its end has to say.
  /// @param a, b  its start and its end
  /// @param fade  of the residual force over it
  void back(const Law& law, const State& s, const Point& a, const Point& b, const typename Law::Piece& piece,
            const Scalar& fade, Rows& H) noexcept {
    const Scalar half = Scalar{1} / Scalar{2}, per_mass = Scalar{1} / law.settings().mass, h = piece.length;
    const Scalar x = half * (a.x + b.x), v = half * (a.v + b.v);
    const Scalar k = piece.pressed ? law.elastic(s, x).slope + law.damping_slope(s, x) * v : Scalar{0};
    const Scalar kappa = k * per_mass;
    const Scalar beta = ((piece.pressed ? law.damping(s, x) : Scalar{0}) + law.settings().tool_damping) * per_mass;
    if (piece.jump != Scalar{0}) shift_event(law, s, b, piece.jump * per_mass, H);
    step_.set(One(kappa), One(beta), h);
    const Scalar g = step_.impulse_response()[0], r1 = step_.step_response()[0];
    const Scalar r2 = step_.ramp_response()[0] / h, r1_end = r1 / h;  // of a force at the end alone: r2, r1_end
    set_memory(law, a.memory.bristle, piece.pressed ? v : Scalar{0}, h);

    const Three from_memory = piece.pressed ? mean_velocity(law) : Three::Zero();
    const Scalar coupling = piece.pressed ? mean_velocity_of_force(law, s) : Scalar{0};
    const Three end = (r2 * x_ + r1_end * (v_ + half * from_memory)) *
                      (-per_mass / (Scalar{1} + half * coupling * r1_end * per_mass));
    const Three mean = half * (from_memory + coupling * end), v_end = v_ + mean;
    if (piece.pressed) {
      add_force(law, s, end);
      at_start_ += end;
    }
    if (!(at_start_ == Scalar{0}).all()) add(law, H, b, at_start_);
    at_start_ = ((r1 - r2) * x_ + (g - r1_end) * v_end) * -per_mass;
    fade_memory(law, fade);
    whole_ += end + at_start_;
    if (piece.pressed) {
      add_force(law, s, at_start_);
    } else {
      at_start_.setZero();
    }
    const Three x_end = x_;
    x_ = (Scalar{1} - kappa * r1) * x_end - kappa * g * v_end;
    v_ = g * x_end + (Scalar{1} - beta * g - kappa * r1) * v_end + mean;
  }

  /// Adds what is left at the path's start.
  void finish(const Law& law, const Point& start, Rows& H) noexcept {
    add(law, H, start, at_start_);
    H.row(Law::position) = x_.matrix();
    H.row(Law::velocity) = v_.matrix();
    H.row(Law::residual) = residual_.matrix();
  }

  /// Of a constant force of the tissue of 1 N, over all steps.
  [[nodiscard]] const Three& of_constant_force() const noexcept { return whole_; }

  /// Adds what the force at a point has of each parameter, times the weights.
  static void add(const Law& law, Rows& H, const Point& p, const Three& weights) noexcept {
    const auto w = law.knots().at(p.x);
    const auto at = [&](int place, const Scalar& value) { H.row(place) += (weights * value).matrix(); };
    for (std::size_t k = 0; k < 4; ++k) at(Law::coefficient(w.first + static_cast<int>(k)), w.value[k]);
    const auto [first, second] = law.damper_weights(p.x);
    at(Law::damper(first), p.v * (Scalar{1} - second));
    at(Law::damper(first + 1), p.v * second);
    if (law.settings().relaxation) {
      for (int i = 0; i < Law::branches; ++i) at(Law::first_branch + i, p.memory.chi[std::size_t(i)]);
    }
    if (law.settings().dry_friction) at(Law::friction, p.memory.bristle);
  }

 private:
  using One = Eigen::Array<Scalar, 1, 1>;

  // The tool crosses the edge later by (de - dx)/v, c' de = -dc; a graze has no derivative. What is remembered begins
  // there with contact; what it has of the instant at which contact ends is neglected.
  void shift_event(const Law& law, const State& s, const Point& at, const Scalar& jump_per_mass, Rows& H) noexcept {
    const Scalar slope = std::max(law.elastic(s, at.x).slope, law.settings().least_slope);
    if (at.v == Scalar{0}) return;
    Three shift = v_ * (jump_per_mass / at.v);
    if (jump_per_mass > Scalar{0}) shift -= travel_remembered(law, at);
    x_ -= shift;
    const auto w = law.knots().at(at.x);
    for (std::size_t k = 0; k < 4; ++k) {
      H.row(Law::coefficient(w.first + static_cast<int>(k))) -= (shift * (w.value[k] / slope)).matrix();
    }
  }

  // Of a travel from there, by what is remembered of it.
  [[nodiscard]] Three travel_remembered(const Law& law, const Point& at) const noexcept {
    Three sum = Three::Zero();
    if (law.settings().relaxation) {
      for (const Three& chi : chi_) sum += chi;
    }
    const Scalar end(at.v < Scalar{0} ? -1 : 1);
    if (law.settings().dry_friction) sum += bristle_ * ((end - at.memory.bristle) * end / law.settings().presliding);
    return sum;
  }

  static Scalar stiffness(const Law& law, const State& s, int i) noexcept {
    return law.settings().relaxation ? s[Law::first_branch + i] : Scalar{0};
  }
  static Scalar friction(const Law& law, const State& s) noexcept {
    return law.settings().dry_friction ? s[Law::friction] : Scalar{0};
  }

  // How the memory at a step's end hangs on its start's and on the mean velocity.
  void set_memory(const Law& law, const Scalar& bristle, const Scalar& v, const Scalar& h) noexcept {
    using std::abs;
    using std::exp;
    if (law.settings().relaxation && h != length_) {
      branch_ = Law::Branch::step_of(law.settings().lags, h);
      length_ = h;
    }
    if (!law.settings().dry_friction) return;
    const Scalar end = v < Scalar{0} ? Scalar{-1} : Scalar{1}, travel = h / law.settings().presliding;
    bristle_decay_ = exp(-abs(v) * travel);
    bristle_gain_ = (end - bristle) * end * travel * bristle_decay_;
  }

  // Derivatives by the mean velocity of a step, from those by the memory at its end.
  [[nodiscard]] Three mean_velocity(const Law& law) const noexcept {
    Three sum = Three::Zero();
    if (law.settings().relaxation) {
      for (std::size_t i = 0; i < chi_.size(); ++i) sum += branch_.gain[i] * chi_[i];
    }
    if (law.settings().dry_friction) sum += bristle_gain_ * bristle_;
    return sum;
  }
  // N s/m, of the remembered force.
  [[nodiscard]] Scalar mean_velocity_of_force(const Law& law, const State& s) const noexcept {
    Scalar sum{0};
    if (law.settings().relaxation) {
      for (int i = 0; i < Law::branches; ++i) sum += branch_.gain[std::size_t(i)] * stiffness(law, s, i);
    }
    if (law.settings().dry_friction) sum += bristle_gain_ * friction(law, s);
    return sum;
  }

  void add_force(const Law& law, const State& s, const Three& weights) noexcept {
    if (law.settings().relaxation) {
      for (int i = 0; i < Law::branches; ++i) chi_[std::size_t(i)] += weights * stiffness(law, s, i);
    }
    if (law.settings().dry_friction) bristle_ += weights * friction(law, s);
    residual_ += weights;
  }

  void fade_memory(const Law& law, const Scalar& fade) noexcept {
    if (law.settings().relaxation) {
      for (std::size_t i = 0; i < chi_.size(); ++i) chi_[i] *= branch_.decay[i];
    }
    if (law.settings().dry_friction) bristle_ *= bristle_decay_;
    residual_ *= fade;
  }

  SecondOrderStep<1, Scalar> step_{};
  typename Law::Branch::Step branch_{};
  Scalar length_{0}, bristle_decay_{1}, bristle_gain_{0};
  Three x_{}, v_{}, bristle_{}, residual_{};
  std::array<Three, std::size_t(Law::branches)> chi_{};
  Three at_start_{}, whole_{};  // of the force at the start of the last step; of all
};

}  // namespace limpid
