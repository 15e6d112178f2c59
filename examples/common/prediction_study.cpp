// SPDX-License-Identifier: MIT
#include "prediction_study.hpp"

#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/estimation/environment_estimator.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <algorithm>
#include <cmath>

namespace limpid::examples {

namespace {

using Tissue1 = KelvinVoigt<1>;
using Predictor = ModelPredictor<Tissue1, Tool<1>, Estimated, ConstantGain<1>, 1024>;
using Theta = EnvironmentTheta<Tissue1>;

Theta first_theta(const PredictionStudy& study) {
  if (!study.start) return {study.stiffness, study.damping};
  return {study.start->stiffness, study.start->damping};
}

std::optional<EnvironmentEstimator<Tissue1>> make_estimator(const PredictionStudy& study) {
  if (!study.start) return {};
  return EnvironmentEstimator<Tissue1>({.environment = {},
                                        .law = {.lower = {200, 20},
                                                .upper = {2000, 40},
                                                .initial = first_theta(study),
                                                .initial_gain = {1e9, 8e6},
                                                .forgetting = 2}});
}

Predictor make_predictor(const PredictionStudy& study) {
  using Vector = Tool<1>::Vector;
  return Predictor({.environment = {},
                    .tool = study.tool,
                    .theta = first_theta(study),
                    .gain = {study.gain_position, study.gain_velocity},
                    .start = {.x = Vector(study.x0_predicted)}});
}

}  // namespace

double StudyPoint::prediction_error() const { return std::hypot(x_predicted - x, v_predicted - v); }
double StudyPoint::hold_error() const { return std::hypot(x_held - x, v_held - v); }

std::vector<StudyPoint> run(const PredictionStudy& study) {
  using Vector = Tool<1>::Vector;
  VirtualTool<Tissue1> truth({.theta = {study.stiffness, study.damping}, .tool = study.tool, .x0 = Vector(study.x0)});
  ToolState<1> first;
  first.x = Vector(study.x0);
  DelayedSampled<ToolState<1>, 512> sampled({.period = study.period, .delay = study.delay}, first);
  auto estimator = make_estimator(study);
  Predictor predictor = make_predictor(study);
  if (study.error_in_history) (void)predictor.observe({first, -study.delay, Time{0}});

  std::vector<StudyPoint> points;
  for (Time now{0}; now <= study.duration; now += study.tick) {
    const Vector F_h(study.force(in_seconds(now)));
    const ToolState<1> tool = truth.advance(now, F_h).value;
    const auto seen = sampled.update(now, tool);
    if (estimator) {
      (void)estimator->update(now, seen);
      (void)predictor.use(estimator->estimate());
    }
    if (seen.fresh) (void)predictor.observe({seen.value, seen.taken, seen.arrived});
    const Motion<1> predicted = predictor.advance(now, F_h).motion;
    const Theta theta = estimator ? estimator->estimate().theta_hat : first_theta(study);
    points.push_back({in_seconds(now), tool.x[0], tool.v[0], predicted.x[0], predicted.v[0], seen.value.x[0],
                      seen.value.v[0], theta(0, 0), theta(0, 1)});
  }
  return points;
}

double largest(const std::vector<StudyPoint>& points, double (StudyPoint::*error)() const, double from_time) {
  double result = 0;
  for (const StudyPoint& point : points) {
    if (point.time >= from_time) result = std::max(result, (point.*error)());
  }
  return result;
}

double settling_time(const std::vector<StudyPoint>& points, double StudyPoint::*value, double target, double fraction) {
  const auto outside = [&](const StudyPoint& point) { return std::abs(point.*value - target) > fraction * target; };
  const auto last = std::find_if(points.rbegin(), points.rend(), outside);
  if (last == points.rend()) return points.front().time;
  return last == points.rbegin() ? points.back().time : std::prev(last)->time;
}

}  // namespace limpid::examples
