// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/prediction/gains.hpp>
#include <limpid/prediction/held_tangents.hpp>
#include <limpid/prediction/knots.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <string>
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
    Rho rate = Held::no_limit();
  };

  GainTable() : GainTable(no_feedback()) {}
  /// @throws std::invalid_argument  as `check` does
  explicit GainTable(const Settings& settings) : s_{settings} { check(); }

  /// @throws std::invalid_argument  where knots do not rise, L is not one finite row for each or a rate not positive
  void check() const {
    detail::check_knots<Scalar>("GainTable: stiffness_knots", s_.stiffness_knots);
    detail::check_knots<Scalar>("GainTable: damping_knots", s_.damping_knots);
    expect(s_.L.size() == s_.stiffness_knots.size() * s_.damping_knots.size(), "GainTable: L", "a row for each knot",
           s_.L.size());
    for (std::size_t i = 0; i < s_.L.size(); ++i) detail::check_row("GainTable: L[" + std::to_string(i) + "]", s_.L[i]);
    Held::check_rate("GainTable", s_.rate);
  }

  /// Schedules by `rho`, `dt` seconds after the last time (the first time without limit of rate).
  /// @return  at_bound where the box or the rate held rho back; not_finite (dt or rho) or clock_backwards (dt < 0):
  ///          nothing changed
  Status update(const Scalar& dt, const Rho& rho) noexcept {
    const Side lower{s_.stiffness_knots.front(), s_.damping_knots.front()};
    const Side upper{s_.stiffness_knots.back(), s_.damping_knots.back()};
    const Status status = rho_.update(dt, rho, lower, upper, s_.rate);
    if (has(status, Status::not_finite | Status::clock_backwards)) return status;
    for (int axis = 0; axis < Axes; ++axis) interpolate(axis);
    return status;
  }

  [[nodiscard]] const Row& row() const noexcept { return row_; }

 private:
  using Held = detail::HeldTangents<Axes, Scalar>;

  struct Side {
    const Scalar &stiffness, &damping;
  };

  static Settings no_feedback() {
    Settings none;
    none.stiffness_knots = none.damping_knots = {Scalar{0}, Scalar{1}};
    none.L.resize(4);
    return none;
  }

  void interpolate(int axis) noexcept {
    const auto k = detail::place_among<Scalar>(s_.stiffness_knots, rho_.stiffness()[axis]);
    const auto b = detail::place_among<Scalar>(s_.damping_knots, rho_.damping()[axis]);
    const std::size_t width = s_.damping_knots.size(), first = k.cell * width + b.cell;
    const Scalar softer = Scalar{1} - k.part, looser = Scalar{1} - b.part;
    const auto mean = [&](auto Row::*entry) {
      const auto at = [&](std::size_t node) -> const Scalar& { return (s_.L[node].*entry)[axis]; };
      return softer * (looser * at(first) + b.part * at(first + 1)) +
             k.part * (looser * at(first + width) + b.part * at(first + width + 1));
    };
    row_.L1[axis] = mean(&Row::L1);
    row_.L2[axis] = mean(&Row::L2);
  }

  Settings s_;
  Row row_{};
  Held rho_{};
};

}  // namespace limpid
