// SPDX-License-Identifier: MIT
// Transparency of a haptic device that renders a wall (Eom, Suh and Yi): the optimal gain, how far the device may
// differ from its model, and what sampling leaves of that.
#include "common/output_file.hpp"
#include "common/transparency_findings.hpp"
#include "common/transparency_options.hpp"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  using namespace limpid::examples;
  try {
    const TransparencyOptions options = parse_transparency_options(argc, argv);
    if (options.exit_code) return *options.exit_code;
    if (options.decouple) return run_decouple(*options.decouple);
    TransparencyFindings findings;
    judge_model(options.task, findings);
    judge_sampled(options.task, findings);
    take_steps(options.task, findings);
    std::cout << words_of(options.task, findings);
    if (!options.json.empty()) {
      write_file(options.json, as_json(options.task, findings).dump(2) + '\n');
      std::cout << "figures: " << options.json << '\n';
    }
    if (!options.plot.empty()) {
      for (const std::string& path : draw_figures(options.task, findings, options.plot)) {
        std::cout << "plot: " << path << '\n';
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "transparency: " << error.what() << '\n';
    return 1;
  }
}
