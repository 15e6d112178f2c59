// SPDX-License-Identifier: MIT
#include "decouple_findings.hpp"
#include "words.hpp"

#include <nlohmann/json.hpp>

#include <utility>

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;

Panel table_panel(const DecoupleOptions& options, const DecoupleFindings& findings) {
  Panel panel{words("|vy/vx| at %g Hz, linear device", options.frequency), "cut-off (Hz)", "", {}, true};
  panel.curves.push_back({"no observers", {5, 300}, {findings.without, findings.without}, true});
  for (const CouplingRow& row : findings.table) {
    Curve curve{std::string(name(row.kind)), {}, {}};
    for (double cutoff = 5; cutoff < row.limit; cutoff *= 1.05) {
      const auto ratio = coupling(findings.plant, row.kind, cutoff, options.frequency);
      if (!ratio) break;
      curve.x.push_back(cutoff);
      curve.y.push_back(*ratio);
    }
    panel.curves.push_back(std::move(curve));
  }
  return panel;
}

}  // namespace

std::string device_of(const DecoupleRun& what) {
  return what.realism == Realism::ideal ? "ideal" : "12-bit D/A, Coulomb";
}

std::string observer_of(const DecoupleRun& what) {
  if (!what.observer) return "none";
  return std::string(name(what.observer->kind)) + words(", %g Hz", what.observer->cutoff);
}

Json as_json(const DecoupleOptions& options, const DecoupleFindings& findings) {
  const auto& [M, B] = std::pair(findings.plant.M, findings.plant.B);
  Json json{{"settings",
             {{"frequency", options.frequency},
              {"filter", options.filter},
              {"cutoff", options.cutoff},
              {"force", options.force},
              {"nominal", {{"mass", nominal_mass}, {"damping", nominal_damping}}}}},
            {"mass_matrix", {{M(0, 0), M(0, 1)}, {M(1, 0), M(1, 1)}}},
            {"damping_matrix", {{B(0, 0), B(0, 1)}, {B(1, 0), B(1, 1)}}},
            {"without_observer", findings.without},
            {"closed_form_limit", first_order_cutoff_limit(findings.plant)},
            {"table", Json::array()},
            {"runs", Json::array()}};
  for (const CouplingRow& row : findings.table) {
    Json entry{{"filter", name(row.kind)}, {"limit", row.limit}, {"ratios", Json::array()}};
    for (std::size_t i = 0; i < coupling_cutoffs.size(); ++i) {
      const Json ratio = row.ratios[i] ? Json(*row.ratios[i]) : Json(nullptr);
      entry["ratios"].push_back({{"cutoff", coupling_cutoffs[i]}, {"ratio", ratio}});
    }
    json["table"].push_back(entry);
  }
  for (const auto& [what, trace] : findings.runs) {
    json["runs"].push_back({{"device", what.realism == Realism::ideal ? "ideal" : "realistic"},
                            {"observers", what.observer.has_value()},
                            {"ended", trace.ended},
                            {"ratio", trace.ended ? Json(trace.ratio) : Json(nullptr)},
                            {"y_range", trace.ended ? Json(trace.y_range) : Json(nullptr)},
                            {"seconds", trace.t.back()},
                            {"status", limpid::describe(trace.status)}});
  }
  return json;
}

Chart chart_of(const DecoupleOptions& options, const DecoupleFindings& findings) {
  Chart chart{words("A force of %g N along x and what moves along y", options.force), {table_panel(options, findings)}};
  for (std::size_t i = 0; i < findings.runs.size(); i += 2) {
    Panel panel{device_of(findings.runs[i].what) + " device", "t (s)", "y (mm)", {}};
    for (const SimulatedRun& one : {findings.runs[i], findings.runs[i + 1]}) {
      const std::string curve = one.what.observer ? observer_of(one.what) : "no observers";
      panel.curves.push_back({curve, one.trace.t, one.trace.y, !one.what.observer});
      for (double& y : panel.curves.back().y) y *= 1e3;
    }
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

}  // namespace limpid::examples
