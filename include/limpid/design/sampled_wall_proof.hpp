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

/// Proves that gains are stable for every plant of the box, slice by slice from one gain toward another: a slice that
/// is not proved is halved, one that is proved is followed by one twice as wide.
template <Real Scalar>
class GainSlices {
 public:
  GainSlices(const SampledWall<Scalar>& loop, const PlantBox<Scalar>& box, const Scalar& K_c, const Scalar& radius,
             int most_cells)
      : loop_{loop}, box_{cell_of(box)}, K_c_{K_c}, radius_{radius}, most_cells_{most_cells} {}

  /// How far it came: `to`, or where slices became narrower than `tolerance` of the way, or the cells were used up.
  [[nodiscard]] Scalar proved(const Scalar& from, const Scalar& to, const Scalar& tolerance) {
    using std::abs;
    const int before = cells_;
    Scalar reached = from, step = to - from;
    const Scalar narrowest = abs(step) * tolerance;
    while (reached != to && abs(step) > narrowest && cells_ - before < most_cells_) {
      const bool last = !(abs(step) < abs(to - reached));
      const Scalar next = last ? to : reached + step;
      if (holds(std::min<Scalar>(reached, next), std::max<Scalar>(reached, next))) {
        reached = next;
        step *= Scalar{2};
      } else {
        step = (next - reached) / Scalar{2};
      }
    }
    return reached;
  }

  [[nodiscard]] bool holds(const Scalar& lower, const Scalar& upper) {
    constexpr int cells_of_a_slice = 500;
    const WallEnclosure<Scalar> polynomial(loop_, K_c_, Ball<Scalar>::between(lower, upper));
    const auto proof = prove_roots_inside(box_, polynomial, radius_, cells_of_a_slice);
    cells_ += proof.cells;
    return proof.verdict == Verdict::feasible;
  }

  [[nodiscard]] int cells() const { return cells_; }

 private:
  SampledWall<Scalar> loop_;
  Cell<Scalar> box_;
  Scalar K_c_, radius_;
  int most_cells_, cells_ = 0;
};

}  // namespace detail

/// The widest interval of B_c >= 0 for which the sampled loop with K_c has a spectral radius below `radius` for every
/// plant of the box: found on a grid of plants, then proved for all gains and plants, outward from its middle (by
/// ratio) until at each end `tolerance` of the way is left, or `most_cells` are used up. Off line: 40 to 300 ms.
/// @throws std::invalid_argument  where a field cannot be used
template <Real Scalar>
[[nodiscard]] RobustGains<Scalar> robust_stable_gains(const SampledWall<Scalar>& loop, const PlantBox<Scalar>& box,
                                                      const Scalar& K_c, const Scalar& radius = Scalar{1},
                                                      const Scalar& tolerance = Scalar{1} / Scalar{1024},
                                                      int most_cells = 200'000) {
  using std::sqrt;
  loop.check();
  box.check();
  expect(is_finite(K_c) && K_c > Scalar{0}, "robust_stable_gains: K_c", "finite and > 0", K_c);
  expect(is_finite(radius) && radius > Scalar{0}, "robust_stable_gains: radius", "finite and > 0", radius);
  expect(is_finite(tolerance) && tolerance > Scalar{0} && tolerance < Scalar{1}, "robust_stable_gains: tolerance",
         "> 0 and < 1", tolerance);
  expect(most_cells > 0, "robust_stable_gains: most_cells", "> 0", most_cells);
  RobustGains<Scalar> answer = detail::common_gains(loop, box, K_c, radius);
  const auto& [lower, upper] = answer.found;
  if (answer.found.empty() || !is_finite(upper)) return answer;
  const Scalar middle = lower > Scalar{0} ? Scalar(sqrt(lower) * sqrt(upper)) : Scalar(upper / Scalar{2});
  detail::GainSlices<Scalar> slices(loop, box, K_c, radius, most_cells);
  if (slices.holds(middle, middle)) {
    const Scalar down = slices.proved(middle, lower, tolerance), up = slices.proved(middle, upper, tolerance);
    if (down < up) answer.proved = {down, up};
  }
  answer.cells = slices.cells();
  return answer;
}

}  // namespace limpid
