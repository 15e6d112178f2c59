// SPDX-License-Identifier: MIT
#include "section_charts.hpp"

#include "trace_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace limpid::examples {

namespace {

Curve running_l2(const std::string& name, const std::vector<TracePoint>& trace, double TracePoint::*error) {
  std::vector<TracePoint> integrated = trace;
  double sum = 0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    if (i > 0) {
      const double before = trace[i - 1].*error, now = trace[i].*error;
      sum += (trace[i].time - trace[i - 1].time) * (before * before + now * now) / 2;
    }
    integrated[i].*error = std::sqrt(sum);
  }
  return curve(name, integrated, error);
}

}  // namespace

std::string figure_file(const std::string& figure) {
  std::string name = "fig_" + figure;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

Chart error_chart(const std::string& title, const std::vector<NamedRun>& runs, double TracePoint::*error) {
  Chart chart{title, {{"error magnitude", "time (s)", "|e|", {}}, {"L2 norm of the error", "time (s)", "|e|_L2", {}}}};
  for (const NamedRun& run : runs) {
    chart.panels[0].curves.push_back(curve(run.name, run.result.trace, error));
    chart.panels[1].curves.push_back(running_l2(run.name, run.result.trace, error));
  }
  return chart;
}

Chart tracking_chart(const std::string& title, const PalpationResult& result) {
  return {title,
          {{"x from the wall",
            "time (s)",
            "m",
            {curve("end effector", result.trace, &TracePoint::tip),
             curve("predicted", result.trace, &TracePoint::predicted)}},
           {"tracking error x - x_hat", "time (s)", "m", {curve("x", result.trace, [](const TracePoint& point) {
              return point.tip - point.predicted;
            })}}}};
}

Chart parameter_chart(const std::string& title, const PalpationResult& result,
                      const std::vector<ParameterCurves>& parameters) {
  Chart chart{title, {}};
  for (const ParameterCurves& which : parameters) {
    const auto at = static_cast<Eigen::Index>(chart.panels.size());
    const auto estimated = [at](const TracePoint& point) { return point.parameters[at]; };
    chart.panels.push_back(
        {which.title,
         "time (s)",
         which.label,
         {curve("actual", result.trace, which.actual), curve("estimated", result.trace, estimated)}});
  }
  return chart;
}

}  // namespace limpid::examples
