// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_stability.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace limpid {

/// The largest spectral radius over a box of tissues.
template <Real Scalar = double>
struct WorstRadius {
  Scalar found{0};             ///< in `tissue`, rounded
  Tissue<Scalar> tissue{};     ///< the worst that was found
  Scalar proved{0};            ///< no tissue of the box has a larger one; infinite where nothing was proved
  SampledProof<Scalar> proof;  ///< of that bound; what became of the last trial where nothing was proved
};

namespace detail {

/// The box as [0, 1] x [0, 1].
template <Real Scalar>
[[nodiscard]] Tissue<Scalar> tissue_at(const TissueBox<Scalar>& box, const Scalar& x, const Scalar& y) {
  const auto between = [](const Scalar& lower, const Scalar& upper, const Scalar& part) {
    return part == Scalar{1} ? upper : lower + (upper - lower) * part;
  };
  return {between(box.lower.stiffness, box.upper.stiffness, x), between(box.lower.damping, box.upper.damping, y)};
}

/// Search for the worst tissue of a box for one gain. What it misses a proof finds.
template <Real Scalar>
class WorstTissueSearch {
 public:
  WorstTissueSearch(const SampledStability<Scalar>& stability, const TissueBox<Scalar>& box, const Gain<Scalar>& L)
      : stability_{stability}, box_{box}, L_{L} {}

  /// A grid with its edges, then climbs from the best point of each third of the stiffness.
  [[nodiscard]] WorstRadius<Scalar> run() const {
    const int along = stability_.degree() > 3 ? 64 : 24;
    std::array<Point, 3> best{};
    for (int i = 0; i <= along; ++i) {
      Point& held = best[static_cast<std::size_t>(std::min(3 * i / along, 2))];
      for (int j = 0; j <= 8; ++j) look(Scalar(i) / Scalar(along), Scalar(j) / Scalar{8}, held);
    }
    Point worst;
    for (const Point& from : best) {
      const Point top = climb(from);
      if (top.radius > worst.radius) worst = top;
    }
    return {worst.radius, tissue_at(box_, worst.x, worst.y), std::numeric_limits<Scalar>::infinity(), {}};
  }

  /// A climb from a tissue of the box.
  [[nodiscard]] WorstRadius<Scalar> from(const Tissue<Scalar>& tissue) const {
    const auto part = [](const Scalar& lower, const Scalar& upper, const Scalar& value) {
      return upper > lower ? (value - lower) / (upper - lower) : Scalar{0};
    };
    Point start;
    look(part(box_.lower.stiffness, box_.upper.stiffness, tissue.stiffness),
         part(box_.lower.damping, box_.upper.damping, tissue.damping), start);
    const Point top = climb(start);
    return {top.radius, tissue_at(box_, top.x, top.y), std::numeric_limits<Scalar>::infinity(), {}};
  }

 private:
  struct Point {
    Scalar x{0}, y{0}, radius{-1};
  };

  // Moves `held` to (x, y) where the radius is larger there. Roots of more than a cubic are found only then.
  void look(const Scalar& x, const Scalar& y, Point& held) const {
    const Tissue<Scalar> tissue = tissue_at(box_, x, y);
    if (held.radius > Scalar{0} && stability_.degree() > 3 && stability_.stable(tissue, L_, held.radius)) return;
    const Scalar radius = stability_.radius(tissue, L_);
    if (radius > held.radius) held = {x, y, radius};
  }

  // Steps along and across, halved where none leads up.
  [[nodiscard]] Point climb(Point at) const {
    constexpr int most_halvings = 24;
    const auto inside = [](const Scalar& part) { return std::clamp<Scalar>(part, Scalar{0}, Scalar{1}); };
    Scalar step_x = Scalar{1} / Scalar{24}, step_y = Scalar{1} / Scalar{8};
    for (int halvings = 0; halvings < most_halvings;) {
      const Point from = at;
      for (const Scalar sign : {Scalar{-1}, Scalar{1}}) {
        look(inside(from.x + sign * step_x), from.y, at);
        look(from.x, inside(from.y + sign * step_y), at);
      }
      if (at.radius > from.radius * (Scalar{1} + Scalar{8} * std::numeric_limits<Scalar>::epsilon())) continue;
      step_x /= Scalar{2};
      step_y /= Scalar{2};
      ++halvings;
    }
    return at;
  }

  const SampledStability<Scalar>& stability_;
  const TissueBox<Scalar>& box_;
  const Gain<Scalar>& L_;
};

}  // namespace detail

/// The largest spectral radius over the box: searched for, then proved with a small allowance, which grows tenfold from
/// 1e-6 where the proof does not come to an end.
///
/// Off line: some milliseconds.
/// @throws std::invalid_argument  where an argument is not finite, the box is empty or the system refused
template <Real Scalar>
[[nodiscard]] WorstRadius<Scalar> worst_sampled_radius(const SampledSystem<Scalar>& system,
                                                       const TissueBox<Scalar>& box, const Gain<Scalar>& L) {
  constexpr int most_counterexamples = 16, most_cells = 20'000;
  const SampledStability<Scalar> stability(system);
  box.check();
  expect(is_finite(L), "worst_sampled_radius: gain", "finite", L);
  const detail::WorstTissueSearch<Scalar> search(stability, box, L);
  WorstRadius<Scalar> worst = search.run();
  if (!is_finite(worst.found)) return worst;
  Scalar allowance = Scalar{1} / Scalar{1'000'000};
  for (int counterexamples = 0; allowance < Scalar{1} && counterexamples < most_counterexamples;) {
    const Scalar bound = std::max<Scalar>(worst.found * (Scalar{1} + allowance), std::numeric_limits<Scalar>::min());
    worst.proof = prove_sampled_stability(system, box, L, bound, most_cells);
    if (worst.proof.proved()) {
      worst.proved = bound;
      break;
    }
    Scalar radius{0};
    if (worst.proof.verdict == Verdict::infeasible) {
      const WorstRadius<Scalar> top = search.from(worst.proof.tissue);
      radius = top.found;
      worst.tissue = radius > bound ? top.tissue : worst.proof.tissue;
      worst.found = std::max<Scalar>(bound, radius);
    }
    if (radius > bound) {
      ++counterexamples;  // the search had missed it
    } else {
      allowance *= Scalar{10};  // or multiple roots were told too inaccurately
    }
  }
  return worst;
}

}  // namespace limpid
