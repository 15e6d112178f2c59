// SPDX-License-Identifier: MIT
#include "decouple.hpp"

#include "decouple_findings.hpp"
#include "output_file.hpp"
#include "words.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace limpid::examples {

namespace {

DecoupleFindings find(const DecoupleOptions& options) {
  DecoupleFindings findings;
  findings.plant = linear_five_bar();
  findings.without = coupling_without_observer(findings.plant, options.frequency);
  for (const QKind kind : q_kinds) {
    CouplingRow row{kind, cutoff_limit(findings.plant, kind).cutoff, {}};
    for (std::size_t i = 0; i < coupling_cutoffs.size(); ++i) {
      row.ratios[i] = coupling(findings.plant, kind, coupling_cutoffs[i], options.frequency);
    }
    findings.table.push_back(row);
  }
  const Observer observer{q_kind(options.filter), options.cutoff};
  const double limit = findings.table[static_cast<std::size_t>(observer.kind)].limit;
  if (!(options.cutoff < limit)) {
    throw std::invalid_argument(words("--cutoff: accepts less than %.2f Hz, where --filter %s becomes unstable, got %g",
                                      limit, options.filter.c_str(), options.cutoff));
  }
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    DecoupleRun what{.realism = realism, .frequency = options.frequency, .force = options.force};
    findings.runs.push_back({what, run(what)});
    what.observer = observer;
    findings.runs.push_back({what, run(what)});
  }
  return findings;
}

std::string table_of(const DecoupleOptions& options, const DecoupleFindings& findings) {
  const auto& [M, B] = std::pair(findings.plant.M, findings.plant.B);
  std::string text = "five-bar, tip at (0.08, 0.22) m, 1 kHz\n";
  text += words("  M = [%.6f %.6f; . %.6f] kg, B = [%.6f %.6f; . %.6f] N s/m\n", M(0, 0), M(0, 1), M(1, 1), B(0, 0),
                B(0, 1), B(1, 1));
  text +=
      words("  observers by Tustin's rule, nominal %g kg, %g N s/m on each axis\n\n", nominal_mass, nominal_damping);
  text += words("|vy/vx| at %g Hz for a force along x, linear device; %.4f without observers\n", options.frequency,
                findings.without);
  text += words("  %-14s", "cut-off (Hz)");
  for (const double cutoff : coupling_cutoffs) text += words("%10g", cutoff);
  text += words("%21s\n", "unstable from (Hz)");
  for (const CouplingRow& row : findings.table) {
    text += words("  %-14s", std::string(name(row.kind)).c_str());
    for (const auto& ratio : row.ratios) text += ratio ? words("%10.5f", *ratio) : words("%10s", "unstable");
    text += words("%21.2f\n", row.limit);
  }
  return text + words(
                    "  closed form for the first order: lambda_min(M)/(pi m T) = %.2f Hz\n"
                    "  for velocities without lag; the realistic device's filtered rates leave less\n\n",
                    first_order_cutoff_limit(findings.plant));
}

std::string runs_of(const DecoupleOptions& options, const DecoupleFindings& findings) {
  std::string text = words("simulated device, the operator's %g N along x fed to the observers\n", options.force);
  text += words("  %-22s%-24s%12s%22s\n", "device", "observers", "|vy/vx|", "y, last second (mm)");
  for (const auto& [what, trace] : findings.runs) {
    text += words("  %-22s%-24s", device_of(what).c_str(), observer_of(what).c_str());
    if (trace.ended) {
      text += words("%12.5f%22.4f", trace.ratio, 1e3 * trace.y_range);
    } else {
      text += words("  stopped at its limits after %.3f s", trace.t.back());
    }
    text += trace.status == Status::ok ? "\n" : "   (" + limpid::describe(trace.status) + ")\n";
  }
  return text;
}

}  // namespace

int run_decouple(const DecoupleOptions& options) {
  const DecoupleFindings findings = find(options);
  std::cout << table_of(options, findings) << runs_of(options, findings);
  if (!options.json.empty()) {
    write_file(options.json, as_json(options, findings).dump(2) + '\n');
    std::cout << "figures: " << options.json << '\n';
  }
  if (!options.plot.empty()) {
    std::filesystem::create_directories(options.plot);
    const std::filesystem::path path = std::filesystem::path(options.plot) / "decouple.svg";
    std::cout << "plot: " << draw(chart_of(options, findings), path.string()) << '\n';
  }
  const auto ended = [](const SimulatedRun& one) { return one.trace.ended; };
  return std::all_of(findings.runs.begin(), findings.runs.end(), ended) ? 0 : 2;
}

}  // namespace limpid::examples
