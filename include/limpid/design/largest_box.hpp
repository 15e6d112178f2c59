// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/design/design_point.hpp>

#include <algorithm>
#include <concepts>
#include <limits>

namespace limpid {

template <Real Scalar = double>
struct LargestBoxSettings {
  Scalar most{1};                                ///< largest scale tried, > 0
  Scalar tolerance = Scalar{1} / Scalar{1'000};  ///< between the two scales, > 0; at least that of rounding is meant

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(most) && most > Scalar{0}, "LargestBox: most", "finite and > 0", most);
    expect(is_finite(tolerance) && tolerance > Scalar{0}, "LargestBox: tolerance", "finite and > 0", tolerance);
  }
};

template <Real Scalar = double>
struct LargestBox {
  Verdict verdict = Verdict::undecided;  ///< feasible: of `box`; otherwise of the smallest one tried
  Scalar scale{0};                       ///< of the half widths; the largest found feasible
  TissueBox<Scalar> box{};               ///< at that scale
  Scalar not_beyond = std::numeric_limits<Scalar>::infinity();  ///< smallest scale proved infeasible
  int boxes = 0;                                                ///< that were tried
};

/// The box with the centre of `whole` and its half widths times `scale`.
template <Real Scalar>
[[nodiscard]] TissueBox<Scalar> scaled_box(const TissueBox<Scalar>& whole, const Scalar& scale) {
  const Tissue<Scalar> centre = whole.centre();
  const Scalar k = (whole.upper.stiffness - whole.lower.stiffness) / Scalar{2} * scale;
  const Scalar b = (whole.upper.damping - whole.lower.damping) / Scalar{2} * scale;
  return {{centre.stiffness - k, centre.damping - b}, {centre.stiffness + k, centre.damping + b}};
}

/// The largest box about the centre of `whole` that a theorem certifies, by bisection on the scale of its half widths.
///
/// What holds on a box holds on each box inside it with the same variables, so that the scales that are feasible have
/// no gaps; scales that are undecided are left as not feasible. Off line: some ten calls of `decide`.
/// @param decide  Verdict(const TissueBox<Scalar>&), proved; as of `design_theorem5` at some rates
/// @throws std::invalid_argument  where the box or a setting cannot be used
template <Real Scalar, typename Decide>
requires std::convertible_to < std::invoke_result_t < Decide, const TissueBox<Scalar>
& >, Verdict > [[nodiscard]] LargestBox<Scalar> largest_box(const TissueBox<Scalar>& whole, Decide&& decide,
                                                            const LargestBoxSettings<Scalar>& settings = {}) {
  whole.check();
  settings.check();
  LargestBox<Scalar> largest;
  const auto try_scale = [&](const Scalar& scale) {
    const TissueBox<Scalar> box = scaled_box(whole, scale);
    const Verdict verdict = decide(box);
    ++largest.boxes;
    if (verdict == Verdict::feasible) {
      largest.scale = scale;
      largest.box = box;
    }
    if (verdict == Verdict::infeasible) largest.not_beyond = std::min<Scalar>(largest.not_beyond, scale);
    if (largest.verdict != Verdict::feasible) largest.verdict = verdict;
    return verdict == Verdict::feasible;
  };
  if (try_scale(settings.most)) return largest;
  Scalar above = settings.most;
  while (above - largest.scale > settings.tolerance) {
    const Scalar middle = largest.scale + (above - largest.scale) / Scalar{2};
    if (!(largest.scale < middle && middle < above)) break;
    if (!try_scale(middle)) above = middle;
  }
  return largest;
}

}  // namespace limpid
