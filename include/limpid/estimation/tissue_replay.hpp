// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/signal/history.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace limpid {

/// What one axis of a sample says: position, velocity, the tissue's force.
template <Real Scalar = double>
struct AxisSample {
  Time taken{};
  Scalar x{0};      ///< m
  Scalar v{0};      ///< m/s
  Scalar force{0};  ///< F_e, N
};

/// The tool's way from one sample to the next in a tissue of a given law, and what x, v and F_e at its end have of each
/// parameter.
/// @tparam Law       TissueLaw
/// @tparam Capacity  steps at most
/// @realtime         no allocation, no throw for built-in scalars; some 200 flops a step
template <typename Law, std::size_t Capacity>
class TissueReplay {
 public:
  using Scalar = typename Law::Scalar;
  using State = typename Law::State;
  using Point = typename Law::Point;
  using Rows = Eigen::Matrix<Scalar, Law::states, 3>;  // of the measurements, transposed: a column each
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  struct Evaluation {
    Rows H = Rows::Zero();        ///< d(x, v, F_e)/ds
    Vector y = Vector::Zero();    ///< measured less replayed
    Point end{};                  ///< of the replay
    Scalar x_gain{0}, v_gain{0};  ///< of a constant force of 1 N over the interval
    Scalar residual_left{1};      ///< of the residual force, at the end
  };

  /// Finds the steps between two instants, over which the operator's force (N) is linear.
  /// @return  false where there are more than Capacity, or not enough forces
  template <std::size_t N>
  [[nodiscard]] bool find_steps(const Law& law, const History<Scalar, N>& forces, Time from, Time to) noexcept {
    step_count_ = 0;
    residual_left_ = Scalar{1};
    const auto first = forces.at(from);
    if (first.status != Status::ok || forces.at(to).status != Status::ok || to <= from) return false;
    Time t = from;
    Scalar F = first.value;
    for (std::size_t i = forces.first_not_before(from); t < to; ++i) {
      if (i < forces.size() && forces.time(i) <= t) continue;
      if (step_count_ == Capacity) return false;
      const bool within = i < forces.size() && forces.time(i) <= to;
      const Time next = within ? forces.time(i) : to;
      const Scalar F1 = within ? forces.value(i) : forces.at(to).value;
      add_step(law, in_seconds<Scalar>(elapsed(next, t)), F, F1);
      t = next;
      F = F1;
    }
    return true;
  }

  /// Replays the interval from s, and keeps the path.
  /// @return  false where that leads nowhere near the sample
  [[nodiscard]] bool walk(Law& law, const State& s, const typename Law::Memory& memory,
                          const AxisSample<Scalar>& z) noexcept {
    using std::abs;
    Point p{s[Law::position], s[Law::velocity], s[Law::residual], memory};
    path_[0] = p;
    for (std::size_t i = 0; i < step_count_; ++i) {
      law.template step<false>(s, p, steps_[i].F0, steps_[i].F1, steps_[i].h);
      path_[i + 1] = p;
    }
    return abs(p.x - z.x) < Scalar(5) / Scalar(100) && abs(p.v - z.v) < Scalar(5);
  }

  /// Depths of the path that was kept, those farther than `near` from x left out; x itself is within. m.
  [[nodiscard]] std::pair<Scalar, Scalar> range(const Scalar& x, const Scalar& near) const noexcept {
    using std::abs;
    std::pair<Scalar, Scalar> range{x, x};
    for (std::size_t i = 0; i <= step_count_; ++i) {
      if (i > 0 && !(abs(path_[i].x - x) < near)) continue;
      range.first = std::min(range.first, path_[i].x);
      range.second = std::max(range.second, path_[i].x);
    }
    return range;
  }

  /// What the end of the path that was kept has of s.
  /// @return  false where that has no bounds
  [[nodiscard]] bool linearise(const Law& law, const State& s, const AxisSample<Scalar>& z,
                               Evaluation& e) const noexcept {
    const Point& p = e.end = path_[step_count_];
    sensitivities(law, s, e);
    const Point at{z.x, z.v, p.residual, p.memory};
    add_row(law, e.H, 2, at, Scalar{1});
    e.H(Law::residual, 2) = e.residual_left;
    e.y = {z.x - p.x, z.v - p.v, z.force - law.force(s, at)};
    return (e.H.array().abs() < Scalar(1'000'000)).all() && is_finite(e.y);
  }

  /// Adds what the force at a point has of each parameter, times `weight`, to one column of the rows.
  static void add_row(const Law& law, Rows& H, int column, const Point& p, const Scalar& weight) noexcept {
    const auto w = law.knots().at(p.x);
    for (std::size_t k = 0; k < 4; ++k)
      H(Law::coefficient(w.first + static_cast<int>(k)), column) += weight * w.value[k];
    const auto [first, second] = law.damper_weights(p.x);
    H(Law::damper(first), column) += weight * p.v * (Scalar{1} - second);
    H(Law::damper(first + 1), column) += weight * p.v * second;
    if (law.settings().relaxation) {
      for (int i = 0; i < Law::branches; ++i) {
        H(Law::first_branch + i, column) += weight * p.memory.chi[std::size_t(i)];
      }
    }
    if (law.settings().dry_friction) H(Law::friction, column) += weight * p.memory.bristle;
  }

 private:
  struct Step {
    Scalar h, F0, F1;
    Scalar fade;  // of the residual force
  };

  void add_step(const Law& law, const Scalar& h, const Scalar& F0, const Scalar& F1) noexcept {
    const bool alike = step_count_ > 0 && steps_[step_count_ - 1].h == h;
    const Scalar fade = alike ? steps_[step_count_ - 1].fade : law.residual_left(h);
    steps_[step_count_++] = {h, F0, F1, fade};
    residual_left_ *= fade;
  }

  // dx/ds and dv/ds at the end, backwards along the path: the adjoint of the step's trapezoidal linearisation.
  void sensitivities(const Law& law, const State& s, Evaluation& e) const noexcept {
    e.H.setZero();
    const Scalar per_mass = Scalar{1} / law.settings().mass, half = Scalar{1} / Scalar{2};
    Eigen::Matrix<Scalar, 2, 2> L = Eigen::Matrix<Scalar, 2, 2>::Identity();
    Scalar rx{0}, rv{0};
    e.x_gain = e.v_gain = Scalar{0};
    e.residual_left = residual_left_;
    for (std::size_t i = step_count_; i-- > 0;) {
      const Scalar& h = steps_[i].h;
      const Point mid = between(path_[i], path_[i + 1]);
      const Scalar k = law.elastic(s, mid.x).slope * per_mass;
      const Scalar b = (law.damping(s, mid.x) + law.settings().tool_damping) * per_mass;
      // (I - A h/2)^-1 with A = (0 1; -k -b)
      const Scalar q = h * half, determinant = Scalar{1} + q * b + q * q * k, per = Scalar{1} / determinant;
      Eigen::Matrix<Scalar, 2, 2> inverse;
      inverse << (Scalar{1} + q * b) * per, q * per, -q * k * per, per;
      const Eigen::Matrix<Scalar, 2, 1> gain = L * inverse.col(1) * (-h * per_mass);
      add_row(law, e.H, 0, mid, gain[0]);
      add_row(law, e.H, 1, mid, gain[1]);
      const Scalar& fade = steps_[i].fade;
      const Scalar mean_fade = half * (Scalar{1} + fade);
      rx = gain[0] * mean_fade + rx * fade;
      rv = gain[1] * mean_fade + rv * fade;
      e.x_gain += gain[0];
      e.v_gain += gain[1];
      const Eigen::Matrix<Scalar, 2, 2> transition =
          Scalar{2} * inverse - Eigen::Matrix<Scalar, 2, 2>::Identity();  // (I - A q)^-1 (I + A q)
      L = (L * transition).eval();
    }
    e.H.template block<2, 1>(0, 0) = L.row(0).transpose();
    e.H.template block<2, 1>(0, 1) = L.row(1).transpose();
    e.H(Law::residual, 0) = rx;
    e.H(Law::residual, 1) = rv;
  }

  static Point between(const Point& a, const Point& b) noexcept {
    const Scalar half = Scalar{1} / Scalar{2};
    Point mid{half * (a.x + b.x), half * (a.v + b.v), half * (a.residual + b.residual), {}};
    for (std::size_t i = 0; i < mid.memory.chi.size(); ++i) {
      mid.memory.chi[i] = half * (a.memory.chi[i] + b.memory.chi[i]);
    }
    mid.memory.bristle = half * (a.memory.bristle + b.memory.bristle);
    return mid;
  }

  std::array<Step, Capacity> steps_{};
  std::array<Point, Capacity + 1> path_{};
  std::size_t step_count_ = 0;
  Scalar residual_left_{1};
};

}  // namespace limpid
