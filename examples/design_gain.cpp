// SPDX-License-Identifier: MIT
// Gains of the predictor: designed, verified and mapped, with certificates; and what the inequalities do not say.
#include "common/design_options.hpp"
#include "common/design_report.hpp"
#include "common/output_file.hpp"
#include "common/progress.hpp"

#include <exception>
#include <iostream>

namespace {

using namespace limpid::examples;

// Of the gain that was judged or found, on the grid; of nothing else is there anything to draw.
HeatMap plot_of(const DesignOptions& options, const DesignReport& report) {
  HeatMap plot;
  DesignTask task = options.task;
  task.gain = report.gain;
  Progress progress("plot");
  (void)map_gain(task, progress.callback(), &plot);
  return plot;
}

DesignReport run(const DesignTask& task, HeatMap& plot) {
  switch (task.command) {
    case DesignCommand::solve:
      return solve(task);
    case DesignCommand::verify:
      return verify(task);
    case DesignCommand::robust:
      return robust(task);
    case DesignCommand::map:
      break;
  }
  Progress progress("map");
  return map_gain(task, progress.callback(), &plot);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const DesignOptions options = parse_design_options(argc, argv);
    if (options.exit_code) return *options.exit_code;
    HeatMap plot;
    const DesignReport report = run(options.task, plot);
    std::cout << report.words;
    if (!options.json.empty()) {
      write_file(options.json, report.json.dump(2) + '\n');
      std::cout << "figures: " << options.json << '\n';
    }
    if (!options.plot.empty()) {
      if (options.task.command != DesignCommand::map && report.gain) plot = plot_of(options, report);
      if (plot.panels.empty()) {
        std::cout << "plot: none, there is no gain to draw\n";
      } else {
        std::cout << "plot: " << draw(plot, options.plot) << '\n';
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "design_gain: " << error.what() << '\n';
    return 1;
  }
}
