// SPDX-License-Identifier: MIT
#include "prediction/contenders.hpp"
#include "prediction/drive.hpp"

#include <limpid/prediction/curve_predictor.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/predictor_mixture.hpp>

#include <memory>

namespace limpid::bench {

namespace {

// Knots as close as what is seen of the law between two samples allows.
CurvePredictor<>::Settings curve_settings(std::size_t period) {
  CurvePredictor<>::Settings settings;
  settings.learner.mass = tool_mass;
  settings.learner.tool_damping = tool_damping;
  settings.learner.knot_spacing = period <= 50 ? 5e-5 : 1e-4;
  return settings;
}

Trace curve(const Course& course) {
  const auto predictor = std::make_unique<CurvePredictor<>>(curve_settings(course.period));
  return drive(*predictor, course);
}

// Hold's weight is a seventeenth before there is anything to choose by.
Trace chosen(const Course& course) {
  using Chosen = PredictorMixture<HoldPredictor<1>, CurvePredictor<>>;
  Chosen::Settings settings;
  settings.weights.prior = {4, 1};
  const auto predictor =
      std::make_unique<Chosen>(settings, HoldPredictor<1>(), CurvePredictor<>(curve_settings(course.period)));
  return drive(*predictor, course);
}

}  // namespace

std::vector<Contender> curve_contenders() { return {{"curve", curve}, {"chosen", chosen}}; }

}  // namespace limpid::bench
