// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/ball.hpp>
#include <limpid/design/cell_proof.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/haptic_wall.hpp>
#include <limpid/design/mean_value_form.hpp>
#include <limpid/design/sampled_wall.hpp>
#include <limpid/design/sampled_wall_interval.hpp>
#include <limpid/design/second_order_enclosure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace limpid {

/// What came of a proof over a box of plants.
template <Real Scalar = double>
struct SampledWallProof {
  Verdict verdict = Verdict::undecided;  ///< feasible: the radius is below the bound for every plant of the box;
                                         ///< infeasible: it is above the bound for `plant`
  int cells{0};                          ///< looked at
  HapticPlant<Scalar> plant{};           ///< in the cell where it ended, unless feasible
  std::string_view reason{};

  [[nodiscard]] bool proved() const { return verdict == Verdict::feasible; }
};

namespace detail {

/// Characteristic polynomials of the sampled loop for all plants of a cell (mass, damping), from exact data.
template <Real Scalar>
class WallEnclosure {
 public:
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;

  /// @param B_c  one gain, or every gain of a ball
  WallEnclosure(const SampledWall<Scalar>& loop, const Scalar& K_c, const Number& B_c)
      : loop_{loop}, period_{loop.period}, fraction_{loop.fraction()}, K_c_{K_c}, B_c_{B_c} {
    using std::atan;
    const Scalar turn = Scalar{8} * atan(Scalar{1});
    const Number two_pi{turn, Scalar{4} * turn * std::numeric_limits<Scalar>::epsilon()};
    const Number angle = loop.filtered() ? two_pi * Number{loop.cutoff} * period_ : Number{Scalar{1}};
    const Number decay = loop.filtered() ? exp(-angle) : Number{Scalar{0}};
    filter_ = velocity_filter<Form>(loop.velocity, Form{decay}, Form{angle}, Form{Number{Scalar{1}}});
  }

  [[nodiscard]] WallCoefficients<Form> operator()(const Cell<Scalar>& cell) const {
    const Form zero{Number{Scalar{0}}}, one{Number{Scalar{1}}};
    const Form per_mass = one / Form::first(cell.lower[0], cell.upper[0]);
    const Form beta = Form::second(cell.lower[1], cell.upper[1]) * per_mass;
    const auto flow = enclose_second_order_flow(zero, beta, period_);
    const bool divided = fraction_ > Scalar{0};
    const auto rest = divided ? enclose_second_order_flow(zero, beta, period_ - Number{fraction_}) : flow;
    const bool difference = loop_.velocity == VelocitySource::backward_difference;
    return wall_polynomial<Form>(flow, divided ? &rest : nullptr, loop_.periods(),
                                 loop_.filtered() || difference ? &filter_ : nullptr, difference,
                                 Form{Number{Scalar{1}} / period_}, K_c_ * per_mass, B_c_ * per_mass, zero, one);
  }

 private:
  SampledWall<Scalar> loop_;
  Number period_;
  Scalar fraction_;
  Number K_c_, B_c_;
  VelocityFilter<Form> filter_{};
};

template <Real Scalar>
[[nodiscard]] Cell<Scalar> cell_of(const PlantBox<Scalar>& box) {
  return {{box.lower.mass, box.lower.damping}, {box.upper.mass, box.upper.damping}};
}

}  // namespace detail

/// Proves that the spectral radius of the sampled loop is below `radius` for every plant of the box, each constant, or
/// that it is above it for one. The given numbers are taken as exact, whatever is rounded is accounted for.
///
/// Off line: some 2 us a cell.
/// @param most_cells  looked at before it gives up
/// @throws std::invalid_argument  where a field cannot be used
template <Real Scalar>
[[nodiscard]] SampledWallProof<Scalar> prove_sampled_wall(const SampledWall<Scalar>& loop, const PlantBox<Scalar>& box,
                                                          const WallFeedback<Scalar>& feedback,
                                                          const Scalar& radius = Scalar{1}, int most_cells = 100'000) {
  loop.check();
  box.check();
  feedback.check();
  expect(is_finite(radius) && radius > Scalar{0}, "prove_sampled_wall: radius", "finite and > 0", radius);
  expect(most_cells > 0, "prove_sampled_wall: most_cells", "> 0", most_cells);
  const detail::WallEnclosure<Scalar> polynomial(loop, feedback.K_c, Ball<Scalar>{feedback.B_c});
  const auto proof = detail::prove_roots_inside(detail::cell_of(box), polynomial, radius, most_cells);
  return {proof.verdict, proof.cells, {proof.point[0], proof.point[1]}, proof.reason};
}

/// Gains that are stable for every plant of a box.
template <Real Scalar = double>
struct RobustGains {
  GainInterval<Scalar> found{};   ///< common to the plants that were tried, rounded
  GainInterval<Scalar> proved{};  ///< inside `found`: every gain for every plant; empty where there is none
  int cells{0};                   ///< that the proof looked at
  HapticPlant<Scalar> lower_plant{}, upper_plant{};  ///< those that set the ends of `found`
};

namespace detail {

/// The widest interval that the plants of a grid over the box have in common.
template <Real Scalar>
[[nodiscard]] RobustGains<Scalar> common_gains(const SampledWall<Scalar>& loop, const PlantBox<Scalar>& box,
                                               const Scalar& K_c, const Scalar& radius) {
  constexpr int along = 8;
  struct Entry {
    GainInterval<Scalar> gains;
    HapticPlant<Scalar> lower, upper;
  };
  std::vector<Entry> common{{{Scalar{0}, std::numeric_limits<Scalar>::infinity()}, box.lower, box.lower}};
  const auto part = [](const Scalar& from, const Scalar& to, int i) {
    return i == along ? to : from + (to - from) * (Scalar(i) / Scalar(along));
  };
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j <= along; ++j) {
      const HapticPlant<Scalar> plant{part(box.lower.mass, box.upper.mass, i),
                                      part(box.lower.damping, box.upper.damping, j)};
      std::vector<Entry> narrower;
      for (const auto& stable : stable_gains(loop, plant, K_c, radius)) {
        for (const Entry& old : common) {
          Entry both = old;
          if (stable.lower > both.gains.lower) both.gains.lower = stable.lower, both.lower = plant;
          if (stable.upper < both.gains.upper) both.gains.upper = stable.upper, both.upper = plant;
          if (!both.gains.empty()) narrower.push_back(both);
        }
      }
      common = std::move(narrower);
    }
  }
  if (common.empty()) return {};
  const auto widest = std::max_element(common.begin(), common.end(), [](const Entry& a, const Entry& b) {
    return a.gains.upper - a.gains.lower < b.gains.upper - b.gains.lower;
  });
  return {widest->gains, {}, 0, widest->lower, widest->upper};
}

/// Whether every gain of the interval is stable for every plant of the box: slices of gains, halved where too wide.
template <Real Scalar>
[[nodiscard]] bool prove_gains(const SampledWall<Scalar>& loop, const PlantBox<Scalar>& box, const Scalar& K_c,
                               const GainInterval<Scalar>& gains, const Scalar& radius, int most_cells, int& cells) {
  constexpr int cells_of_a_slice = 500;
  const Scalar narrowest = (gains.upper - gains.lower) * Scalar{16} * std::numeric_limits<Scalar>::epsilon();
  std::vector<GainInterval<Scalar>> open{gains};
  while (!open.empty()) {
    const GainInterval<Scalar> slice = open.back();
    open.pop_back();
    const WallEnclosure<Scalar> polynomial(loop, K_c, Ball<Scalar>::between(slice.lower, slice.upper));
    const auto proof = prove_roots_inside(cell_of(box), polynomial, radius, cells_of_a_slice);
    cells += proof.cells;
    if (proof.verdict == Verdict::feasible) continue;
    if (proof.verdict == Verdict::infeasible || cells > most_cells || slice.upper - slice.lower < narrowest) {
      return false;
    }
    const Scalar middle = slice.lower + (slice.upper - slice.lower) / Scalar{2};
    open.push_back({middle, slice.upper});
    open.push_back({slice.lower, middle});
  }
  return true;
}

}  // namespace detail

/// The widest interval of B_c >= 0 for which the sampled loop with K_c has a spectral radius below `radius` for every
/// plant of the box: found on a grid of plants, then proved for all gains and plants but for a last part of `tolerance`
/// at each end, which is doubled as often as it takes.
///
/// Off line: milliseconds.
/// @param most_cells  looked at before one try is given up
/// @throws std::invalid_argument  where a field cannot be used
template <Real Scalar>
[[nodiscard]] RobustGains<Scalar> robust_stable_gains(const SampledWall<Scalar>& loop, const PlantBox<Scalar>& box,
                                                      const Scalar& K_c, const Scalar& radius = Scalar{1},
                                                      const Scalar& tolerance = Scalar{1} / Scalar{1024},
                                                      int most_cells = 200'000) {
  loop.check();
  box.check();
  expect(is_finite(K_c), "robust_stable_gains: K_c", "finite", K_c);
  expect(is_finite(radius) && radius > Scalar{0}, "robust_stable_gains: radius", "finite and > 0", radius);
  expect(is_finite(tolerance) && tolerance > Scalar{0} && tolerance < Scalar{1}, "robust_stable_gains: tolerance",
         "> 0 and < 1", tolerance);
  expect(most_cells > 0, "robust_stable_gains: most_cells", "> 0", most_cells);
  RobustGains<Scalar> answer = detail::common_gains(loop, box, K_c, radius);
  if (answer.found.empty() || !is_finite(answer.found.upper)) return answer;
  const Scalar width = answer.found.upper - answer.found.lower;
  for (Scalar part = tolerance; part < Scalar{1} / Scalar{2}; part *= Scalar{2}) {
    const GainInterval<Scalar> inner{answer.found.lower + part * width, answer.found.upper - part * width};
    int cells = 0;
    const bool holds = detail::prove_gains(loop, box, K_c, inner, radius, most_cells, cells);
    answer.cells += cells;
    if (!holds) continue;
    answer.proved = inner;
    break;
  }
  return answer;
}

}  // namespace limpid
