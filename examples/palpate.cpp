// SPDX-License-Identifier: MIT
// The main job: a hand presses a simulated Omni against a slow tissue, with and without prediction.
#include "common/palpate_options.hpp"
#include "common/palpate_report.hpp"
#include "common/progress.hpp"
#include "common/scene.hpp"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  using namespace limpid::examples;
  try {
    const PalpateOptions options = parse_palpate_options(argc, argv);
    if (options.exit_code) return *options.exit_code;

    std::vector<PalpationRun> runs;
    for (const PredictorKind predictor : options.predictors) {
      Progress progress(name(predictor));
      runs.push_back({predictor, palpate(options.scene, predictor, progress.callback())});
    }
    print_table(std::cout, options.scene, runs);
    write_outputs(std::cout, options, runs);
    return report_faults(std::cerr, runs) ? 2 : 0;
  } catch (const std::exception& error) {
    std::cerr << "palpate: " << error.what() << '\n';
    return 1;
  }
}
