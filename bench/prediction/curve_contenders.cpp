// SPDX-License-Identifier: MIT
#include "prediction/contenders.hpp"
#include "prediction/drive.hpp"

#include <limpid/prediction/tissue_predictor.hpp>

#include <memory>

namespace limpid::bench {

namespace {

TissuePredictorSettings<> settings_for(const Course& course) {
  return {.mass = tool().mass, .tool_damping = tool().damping, .period = time_of(course.period)};
}

Trace curve(const Course& course) {
  const auto predictor = std::make_unique<CurvePredictor<>>(curve_settings(settings_for(course), true, false));
  return drive(*predictor, course);
}

Trace chosen(const Course& course) {
  const auto predictor = make_tissue_predictor(settings_for(course));
  return drive(*predictor, course);
}

}  // namespace

std::vector<Contender> curve_contenders() { return {{"curve", curve}, {"chosen", chosen}}; }

}  // namespace limpid::bench
