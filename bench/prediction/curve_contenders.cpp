// SPDX-License-Identifier: MIT
#include "prediction/contenders.hpp"
#include "prediction/drive.hpp"

#include <limpid/prediction/tissue_predictor.hpp>

#include <chrono>
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

std::vector<double> microseconds_of_chosen(const Course& course) {
  using Clock = std::chrono::steady_clock;
  const auto predictor = make_tissue_predictor(settings_for(course));
  std::vector<Clock::time_point> begun;
  begun.reserve(course.truth.ticks.size() + 1);
  (void)drive(*predictor, course, [&](Time, const Held<ToolState<1>>&) { begun.push_back(Clock::now()); });
  begun.push_back(Clock::now());
  std::vector<double> taken;
  taken.reserve(begun.size());
  for (std::size_t k = 0; k + 1 < begun.size(); ++k) {
    taken.push_back(std::chrono::duration<double, std::micro>(begun[k + 1] - begun[k]).count());
  }
  return taken;
}

std::vector<Contender> curve_contenders() { return {{"curve", curve}, {"chosen", chosen}}; }

}  // namespace limpid::bench
