// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/estimation/axis_sample.hpp>
#include <limpid/estimation/tissue_adjoint.hpp>
#include <limpid/signal/history.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace limpid {

/// The tool's way from one sample to the next in a tissue of a given law, and what x, v and F_e at its end have of each
/// parameter.
/// @tparam Law       TissueLaw
/// @tparam Capacity  steps at most
/// @realtime         no allocation, no throw for built-in scalars; some 500 flops a step
template <typename Law, std::size_t Capacity>
class TissueReplay {
 public:
  using Scalar = typename Law::Scalar;
  using State = typename Law::State;
  using Point = typename Law::Point;
  using Piece = typename Law::Piece;
  using Adjoint = TissueAdjoint<Law>;
  using Rows = typename Adjoint::Rows;
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
    piece_count_ = 0;
    for (std::size_t i = 0; i < step_count_; ++i) {
      if (piece_count_ + most_pieces > pieces_.size()) return false;
      law.template step<false>(s, p, steps_[i].F0, steps_[i].F1, steps_[i].h,
                               [&](const Point& end, const Piece& piece) {
                                 pieces_[piece_count_] = piece;
                                 path_[++piece_count_] = end;
                               });
    }
    return abs(p.x - z.x) < Scalar(5) / Scalar(100) && abs(p.v - z.v) < Scalar(5);
  }

  /// Depths of the path that was kept, those farther than `near` from x left out; x itself is within. m.
  [[nodiscard]] std::pair<Scalar, Scalar> range(const Scalar& x, const Scalar& near) const noexcept {
    using std::abs;
    std::pair<Scalar, Scalar> range{x, x};
    for (std::size_t i = 0; i <= piece_count_; ++i) {
      if (i > 0 && !(abs(path_[i].x - x) < near)) continue;
      range.first = std::min(range.first, path_[i].x);
      range.second = std::max(range.second, path_[i].x);
    }
    return range;
  }

  /// What is measured less what the path that was kept comes to.
  /// @param pushes  whether the sample's force shows that the tissue does, whatever the law says
  void compare(const Law& law, const State& s, const AxisSample<Scalar>& z, bool pushes, Evaluation& e) const noexcept {
    const Point& p = e.end = path_[piece_count_];
    const Point at = at_sample(z);
    e.y = {z.x - p.x, z.v - p.v, z.force - (pushes ? law.pressed_force(s, at) : law.force(s, at))};
  }

  /// What the end of the path that was kept has of s, beside `compare`.
  /// @return  false where that has no bounds
  [[nodiscard]] bool linearise(const Law& law, const State& s, const AxisSample<Scalar>& z, bool pushes,
                               Evaluation& e) noexcept {
    const Point at = at_sample(z);
    differentiate(law, s, at, pushes || law.pressed(s, at), e);
    return (e.H.array().abs() < Scalar(1'000'000)).all() && is_finite(e.y);
  }

 private:
  struct Step {
    Scalar h, F0, F1;
  };
  static constexpr std::size_t most_pieces = Law::most_pieces;  // of a step

  // Of the residual force over a piece; most are as long as the one before.
  [[nodiscard]] Scalar fade(const Law& law, const Scalar& length) noexcept {
    if (length != fade_length_) {
      fade_length_ = length;
      fade_ = law.residual_left(length);
    }
    return fade_;
  }

  void add_step(const Law& law, const Scalar& h, const Scalar& F0, const Scalar& F1) noexcept {
    steps_[step_count_++] = {h, F0, F1};
    residual_left_ *= fade(law, h);
  }

  // Where and how the sample was, with what the path has left in memory.
  [[nodiscard]] Point at_sample(const AxisSample<Scalar>& z) const noexcept {
    const Point& end = path_[piece_count_];
    return {z.x, z.v, end.residual, end.memory};
  }

  // d(x, v, F_e)/ds, backwards along the path, and the force's own at the sample.
  void differentiate(const Law& law, const State& s, const Point& at, bool pressed, Evaluation& e) noexcept {
    e.H.setZero();
    adjoint_.begin(law, s);
    for (std::size_t i = piece_count_; i-- > 0;) {
      adjoint_.back(law, s, path_[i], path_[i + 1], pieces_[i], fade(law, pieces_[i].length), e.H);
    }
    adjoint_.finish(law, path_[0], e.H);
    if (pressed) {
      Adjoint::add(law, e.H, at, typename Adjoint::Three(Scalar{0}, Scalar{0}, Scalar{1}));
    } else {
      e.H.col(2).setZero();
    }
    e.x_gain = adjoint_.of_constant_force()[0];
    e.v_gain = adjoint_.of_constant_force()[1];
    e.residual_left = residual_left_;
  }

  Adjoint adjoint_{};
  std::array<Step, Capacity> steps_{};
  std::array<Piece, Capacity + 64> pieces_{};
  std::array<Point, Capacity + 65> path_{};
  std::size_t step_count_ = 0, piece_count_ = 0;
  Scalar fade_length_{0}, fade_{1};
  Scalar residual_left_{1};
};

}  // namespace limpid
