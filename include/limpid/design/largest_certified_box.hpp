// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/largest_box.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/design/theorem3_design.hpp>
#include <limpid/design/theorem5.hpp>

namespace limpid {

/// The largest box on which Theorem 3 holds for the gain L with common P, Q, R.
/// Off line: some ten verifications.
/// @throws std::invalid_argument  where the design, the box, the gain or a setting cannot be used
template <Real Scalar>
[[nodiscard]] LargestBox<Scalar> largest_box_theorem3(const PredictorDesign<Scalar>& design,
                                                      const TissueBox<Scalar>& whole, const Gain<Scalar>& L,
                                                      const LargestBoxSettings<Scalar>& settings = {}) {
  const auto decide = [&](const TissueBox<Scalar>& box) { return verify_theorem3(design, box, L).verdict; };
  return largest_box(whole, decide, settings);
}

/// The largest box on which Theorem 3 holds for some gain with common P, Q, R and X.
template <Real Scalar>
[[nodiscard]] LargestBox<Scalar> largest_box_theorem3(const PredictorDesign<Scalar>& design,
                                                      const TissueBox<Scalar>& whole,
                                                      const LargestBoxSettings<Scalar>& settings = {}) {
  const auto decide = [&](const TissueBox<Scalar>& box) { return design_theorem3(design, box).verdict; };
  return largest_box(whole, decide, settings);
}

/// The largest box on which Theorem 5 holds for some gain that is affine in rho, at the rates given whatever its size.
template <Real Scalar>
[[nodiscard]] LargestBox<Scalar> largest_box_theorem5(const PredictorDesign<Scalar>& design,
                                                      const TissueBox<Scalar>& whole, const TissueRates<Scalar>& rates,
                                                      const LargestBoxSettings<Scalar>& settings = {}) {
  const auto decide = [&](const TissueBox<Scalar>& box) { return design_theorem5(design, box, rates).verdict; };
  return largest_box(whole, decide, settings);
}

}  // namespace limpid
