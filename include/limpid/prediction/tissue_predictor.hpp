// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/time.hpp>
#include <limpid/estimation/tissue_law.hpp>
#include <limpid/prediction/curve_predictor.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/predictor_mixture.hpp>

#include <chrono>
#include <memory>

namespace limpid {

/// The predictor to take where nothing is known of a tissue: hold, and three that learn its whole force law, with
/// branches that relax, with dry friction, and with both; weighted by what each had issued. None of the three is best
/// in all tissues: where there is no friction its bristle is mistaken for a branch, and the other way round.
///
/// 0.88 MB, bounded: `make_tissue_predictor` puts it on the heap.
/// @realtime  as CurvePredictor, three times
template <Real Scalar = double>
using TissuePredictor =
    PredictorMixture<HoldPredictor<1, Scalar>, CurvePredictor<TissueLaw<5, 16, 96, Scalar>>,
                     CurvePredictor<TissueLaw<5, 16, 96, Scalar>>, CurvePredictor<TissueLaw<5, 16, 96, Scalar>>>;

/// What has to be known.
template <Real Scalar = double>
struct TissuePredictorSettings {
  Scalar mass{};                                    ///< of the tool, kg, > 0
  Scalar tool_damping{0};                           ///< N s/m, >= 0
  Duration period = std::chrono::milliseconds(32);  ///< of the samples, about; > 0
};

/// How a learner is set up for samples of about that period: knots as close as what is seen of the law between two
/// samples allows.
/// @throws std::invalid_argument  where a field is refused
template <Real Scalar>
[[nodiscard]] typename CurvePredictor<TissueLaw<5, 16, 96, Scalar>>::Settings curve_settings(
    const TissuePredictorSettings<Scalar>& s, bool relaxation, bool dry_friction) {
  expect(s.period > Duration::zero(), "TissuePredictor: period", "> 0 s", s.period);
  typename CurvePredictor<TissueLaw<5, 16, 96, Scalar>>::Settings settings;
  settings.learner.mass = s.mass;
  settings.learner.tool_damping = s.tool_damping;
  settings.learner.knot_spacing = Scalar(s.period <= std::chrono::milliseconds(50) ? 5 : 10) / Scalar(100'000);
  settings.learner.relaxation = relaxation;
  settings.learner.dry_friction = dry_friction;
  settings.learner.contact = true;
  // beside friction a branch has to show more before it is believed
  if (relaxation && dry_friction) settings.learner.branch_deviation = Scalar(30);
  return settings;
}

/// Before there is anything to choose by, the law without friction has the most weight: 16 times hold's, 4 times each
/// of the others'.
/// @throws std::invalid_argument  where a field is refused
template <Real Scalar>
[[nodiscard]] std::unique_ptr<TissuePredictor<Scalar>> make_tissue_predictor(
    const TissuePredictorSettings<Scalar>& settings) {
  using Curve = CurvePredictor<TissueLaw<5, 16, 96, Scalar>>;
  typename TissuePredictor<Scalar>::Settings mixture;
  mixture.weights.prior = {Scalar(4), Scalar(1), Scalar(2), Scalar(2)};
  return std::make_unique<TissuePredictor<Scalar>>(
      mixture, HoldPredictor<1, Scalar>(), Curve(curve_settings(settings, true, false)),
      Curve(curve_settings(settings, true, true)), Curve(curve_settings(settings, false, true)));
}

}  // namespace limpid
