// SPDX-License-Identifier: MIT
// The main job: a hand presses a simulated Omni against a slow tissue, with and without prediction.
#include "common/palpate_options.hpp"
#include "common/palpate_report.hpp"
#include "common/progress.hpp"
#include "common/scene.hpp"

#include <exception>
#include <iostream>
#include <optional>

int main(int argc, char** argv) {
  using namespace limpid::examples;
  try {
    const PalpateOptions options = parse_palpate_options(argc, argv);
    if (options.exit_code) return *options.exit_code;

    const auto run = [&](PredictorKind predictor) {
      Progress progress(name(predictor));
      return palpate(options.scene, predictor, progress.callback());
    };
    std::vector<PalpationRun> runs;
    for (const PredictorKind predictor : options.predictors) runs.push_back({predictor, run(predictor)});
    print_table(std::cout, options.scene, runs);
    const PalpationResult* hold = hold_of(runs);
    std::optional<PalpationResult> unasked;  // the windows are judged by it
    if (hold == nullptr && !options.json.empty() && !options.scene.live)
      hold = &unasked.emplace(run(PredictorKind::hold));
    write_outputs(std::cout, options, runs, hold);
    return report_faults(std::cerr, runs) ? 2 : 0;
  } catch (const std::exception& error) {
    std::cerr << "palpate: " << error.what() << '\n';
    return 1;
  }
}
