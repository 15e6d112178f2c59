// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/prediction/gains.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

namespace limpid {

/// L(rho) given at knots of stiffness and damping and bilinear between them: what a design with splines comes to.
///
/// rho = (dF_e/dx, dF_e/dv) of the environment as estimated, as in ScheduledGain; it is held inside the knots' box, and
/// its rate below the one, that the design was verified for.
/// @realtime  update: no allocation, no throw; a binary search in each side's knots and some 30 flops an axis
template <int Axes = 1, Real Scalar = double>
class GainTable {
 public:
  using Row = GainRow<Axes, Scalar>;
  using Rho = Tangents<Axes, Scalar>;
  static constexpr bool scheduled = true;

  struct Settings {
    std::vector<Scalar> stiffness_knots{};  ///< N/m, two or more, rising
    std::vector<Scalar> damping_knots{};    ///< N s/m, two or more, rising
    std::vector<Row> L{};                   ///< at (stiffness i, damping j) entry i * dampings + j: N/m, N s/m
    /// Fastest change of rho in the design: N/(m s), N/m; > 0; infinite where it has no limit.
    Rho rate = {Vector::Constant(std::numeric_limits<Scalar>::infinity()),
                Vector::Constant(std::numeric_limits<Scalar>::infinity())};
  };

  GainTable() : GainTable(no_feedback()) {}
  /// @throws std::invalid_argument  as `check` does
  explicit GainTable(const Settings& settings) : s_{settings} { check(); }

  /// @throws std::invalid_argument  where knots do not rise, L is not one finite row for each or a rate not positive
  void check() const {
    check_side("GainTable: stiffness_knots", s_.stiffness_knots);
    check_side("GainTable: damping_knots", s_.damping_knots);
    expect(s_.L.size() == s_.stiffness_knots.size() * s_.damping_knots.size(), "GainTable: L", "a row for each knot",
           s_.L.size());
    for (const Row& row : s_.L) expect(is_finite(row.L1) && is_finite(row.L2), "GainTable: L", "finite", row.L1);
    expect((s_.rate.stiffness > Scalar{0}).all(), "GainTable: rate stiffness", "> 0", s_.rate.stiffness);
    expect((s_.rate.damping > Scalar{0}).all(), "GainTable: rate damping", "> 0", s_.rate.damping);
  }

  /// Schedules by `rho`, `dt` seconds after the last time (the first time without limit of rate).
  /// @return  at_bound where the box or the rate held rho back
  Status update(const Scalar& dt, const Rho& rho) noexcept {
    const bool stiffness_held = move(k_, rho.stiffness, s_.stiffness_knots, s_.rate.stiffness * dt);
    const bool damping_held = move(b_, rho.damping, s_.damping_knots, s_.rate.damping * dt);
    started_ = true;
    for (int axis = 0; axis < Axes; ++axis) interpolate(axis);
    return when(stiffness_held || damping_held, Status::at_bound);
  }

  [[nodiscard]] const Row& row() const noexcept { return row_; }

 private:
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Knots = std::vector<Scalar>;

  struct Place {
    std::size_t cell;
    Scalar part;  // of the cell, 0 to 1
  };

  static Settings no_feedback() {
    Settings none;
    none.stiffness_knots = none.damping_knots = {Scalar{0}, Scalar{1}};
    none.L.resize(4);
    return none;
  }
  static void check_side(std::string_view name, const Knots& knots) {
    expect(knots.size() >= 2, name, "two or more", knots.size());
    for (std::size_t i = 0; i < knots.size(); ++i) {
      expect(is_finite(knots[i]) && (i == 0 || knots[i - 1] < knots[i]), name, "finite and rising", knots[i]);
    }
  }

  bool move(Vector& from, const Vector& to, const Knots& knots, const Vector& most) noexcept {
    Vector target = to.max(knots.front()).min(knots.back());
    if (started_) target = target.max(from - most).min(from + most);
    from = target;
    return (target != to).any();
  }

  static Place place(const Knots& knots, const Scalar& value) noexcept {
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, value);
    const auto cell = static_cast<std::size_t>(above - knots.begin()) - 1;
    return {cell, (value - knots[cell]) / (knots[cell + 1] - knots[cell])};
  }

  void interpolate(int axis) noexcept {
    const Place k = place(s_.stiffness_knots, k_[axis]), b = place(s_.damping_knots, b_[axis]);
    const std::size_t width = s_.damping_knots.size(), first = k.cell * width + b.cell;
    const Scalar softer = Scalar{1} - k.part, looser = Scalar{1} - b.part;
    const auto mean = [&](Vector Row::*entry) {
      const auto at = [&](std::size_t node) -> const Scalar& { return (s_.L[node].*entry)[axis]; };
      return softer * (looser * at(first) + b.part * at(first + 1)) +
             k.part * (looser * at(first + width) + b.part * at(first + width + 1));
    };
    row_.L1[axis] = mean(&Row::L1);
    row_.L2[axis] = mean(&Row::L2);
  }

  Settings s_;
  Row row_{};
  Vector k_ = Vector::Zero(), b_ = Vector::Zero();  // rho
  bool started_ = false;
};

}  // namespace limpid
