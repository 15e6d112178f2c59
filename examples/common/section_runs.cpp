// SPDX-License-Identifier: MIT
#include "section_runs.hpp"

#include "progress.hpp"

#include <limpid/environment/smooth_bilinear.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace limpid::examples {

namespace {

PalpationResult run_with(Scene scene, const std::string& name, PredictorKind kind, const PredictorGain& gain) {
  if (!gain.empty()) scene.gain = gain;
  Progress progress("case " + name);
  return palpate(scene, kind, progress.callback());
}

RunErrors errors_of(const std::string& predictor, const PalpationResult& result) {
  return {predictor, result.prediction.total(), result.total.total(), result.status};
}

void add_error_chart(SectionReport& report, const std::string& figure, const std::string& title,
                     const std::vector<NamedRun>& runs, double TracePoint::*error) {
  if (!figure.empty())
    report.charts.push_back({figure_file(figure), error_chart("Fig. " + figure + title, runs, error)});
}

}  // namespace

PredictorGain constant_gain(const PrintedDesign& design) { return {design.constant[0], design.constant[1]}; }

PredictorGain scheduled_gain(const PrintedDesign& design) {
  const auto& [L0, L1, L2] = design.scheduled;
  return {L0[0], L0[1], L1[0], L1[1], L2[0], L2[1]};
}

CaseResult add_case(SectionReport& report, const RunCase& which) {
  CaseResult result{run_with(which.scene, which.name, PredictorKind::hold, {}),
                    run_with(which.scene, which.name, PredictorKind::model, which.constant),
                    {}};
  RunComparison row{.name = which.name,
                    .period = in_seconds(which.scene.period),
                    .runs = {errors_of("hold", result.hold), errors_of("constant gain", result.constant)},
                    .printed = which.printed};
  std::vector<NamedRun> drawn{{"without prediction", result.hold}, {"constant gain", result.constant}};
  if (!which.scheduled.empty()) {
    result.scheduled = run_with(which.scene, which.name, PredictorKind::model, which.scheduled);
    row.runs.push_back(errors_of("scheduled gain", *result.scheduled));
    drawn.push_back({"scheduled gain", *result.scheduled});
  }
  report.runs.push_back(std::move(row));
  add_error_chart(report, which.prediction_figure, ": predictor error, case " + which.name, drawn,
                  &TracePoint::prediction_error);
  add_error_chart(report, which.total_figure, ": total error, case " + which.name, drawn, &TracePoint::total_error);
  return result;
}

PressForce scaled_to_peak(const PressForce& press, double peak) {
  double largest = 0;
  for (Time t{0}; t <= press.duration; t += std::chrono::milliseconds{1}) {
    largest = std::max(largest, std::abs(press.at(t)));
  }
  if (!(largest > 0)) throw std::invalid_argument("--force: expected a press with some force, " + press.description);
  const double scale = peak / largest;
  return {[at = press.at, scale](Time t) { return scale * at(t); }, press.duration, press.description};
}

Tissue bilinear_tissue(bool a) {
  Tissue tissue{.kind = TissueKind::smooth_bilinear, .sharpness = 20, .damping = 30};
  tissue.stiffness = a ? 370 : 450;
  tissue.stiffness2 = a ? 1980 : 1000;
  tissue.depth = a ? 0.0028 : 0.005;
  return tissue;
}

std::vector<ParameterCurves> tangent_curves(const Tissue& tissue) {
  const SmoothBilinear<1> law({.depth = tissue.depth, .sharpness = tissue.sharpness});
  const auto at = [law, tissue](double x) {
    using Vector = SmoothBilinear<1>::Vector;
    return law.response({tissue.stiffness, tissue.stiffness2, 0}, Vector(x), Vector(0));
  };
  const auto offset = [at](const TracePoint& point) {
    const auto response = at(point.ideal);
    return response.force[0] - response.tangent.stiffness[0] * point.ideal;
  };
  return {{"stiffness", "k (N/m)", [at](const TracePoint& point) { return at(point.ideal).tangent.stiffness[0]; }},
          {"offset", "c (N)", offset}};
}

std::vector<ParameterCurves> secant_curves(const Tissue& tissue) {
  const auto stiffness = [tissue](const TracePoint& point) {
    return tissue.stiffness * std::pow(std::abs(point.ideal), tissue.exponent - 1);
  };
  return {{"stiffness", "k (N/m)", stiffness},
          {"damping", "b (N s/m)", [tissue](const TracePoint&) { return tissue.damping; }}};
}

}  // namespace limpid::examples
