// SPDX-License-Identifier: MIT
// Every predictor in every tissue, under every force, disturbance and period, beside the floor that no learner can
// pass; fails where a figure asked of the chosen predictor is missed.
#include "prediction/choice.hpp"
#include "prediction/cost.hpp"
#include "prediction/report.hpp"
#include "prediction/self_check.hpp"

#include <CLI/CLI.hpp>
#include <common/output_file.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>
#include <utility>

namespace {

using namespace limpid::bench;

struct Options {
  Choice choice;
  std::string csv, device_csv, json, plots;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  bool self_check = false;
};

void add_options(CLI::App& app, Options& options) {
  Choice& choice = options.choice;
  const auto add_names = [&](const char* name, std::vector<std::string>& names, const char* what) {
    app.add_option(name, names, what)->delimiter(',');
  };
  add_names("--tissues", choice.tissues, "names");
  add_names("--forces", choice.forces, "names");
  add_names("--disturbances", choice.disturbances, "names");
  add_names("--predictors", choice.predictors, "names, or all");
  app.add_option("--periods", choice.periods, "of the samples, which are as late, s")->delimiter(',');
  app.add_option("--recordings", choice.recordings, "folder of recorded presses, CSV files of time (s) and force");
  app.add_flag("--held-out", choice.held_out, "also what is kept out of all tuning, reported apart");
  app.add_option("--seconds", choice.seconds, "of a run, a multiple of 4");
  app.add_flag("--device,!--no-device", choice.device, "whether an Omni follows the judged predictor, too (default)");
  app.add_option("--threads", options.threads, "at once")->check(CLI::Range(1, 256));
  app.add_option("--csv", options.csv, "file for the runs")->check(limpid::examples::refusal_of_output);
  app.add_option("--device-csv", options.device_csv, "file for the Omni's presses")
      ->check(limpid::examples::refusal_of_output);
  app.add_option("--json", options.json, "file for the runs, their windows, means and verdict")
      ->check(limpid::examples::refusal_of_output);
  app.add_option("--plots", options.plots, "folder for plots");
  app.add_flag("--self-check", options.self_check, "only hold the program against known answers");
}

int run(const Options& options) {
  if (options.self_check) return self_check() ? 0 : 1;
  const Selection selection = selected(options.choice);
  if (options.choice.recordings.empty()) std::printf("without --recordings: the recorded presses are left out\n");
  if (!options.choice.held_out) std::printf("without --held-out: what is kept out of all tuning is left out\n");

  const auto started = std::chrono::steady_clock::now();
  Results results{.selection = selection, .rows = run_matrix(selection, options.threads), .cells = {}, .findings = {}};
  const DeviceStudy study = options.choice.device ? study_device(selection, options.threads) : DeviceStudy{};
  const bool chosen = std::ranges::find(selection.predictors, "chosen", &Contender::name) != selection.predictors.end();
  const std::vector<Cost> costs = chosen ? cost_of_chosen(selection) : std::vector<Cost>{};
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  results.cells = cells_of(selection, results.rows);
  results.findings = verdict(selection, results.rows, results.cells);
  for (Finding& finding : device_verdict(selection, study)) results.findings.push_back(std::move(finding));
  for (Finding& finding : cost_verdict(selection, costs)) results.findings.push_back(std::move(finding));
  print_tables(results);
  print_unjudged_windows(results);
  if (options.choice.device) print_device(selection, study);
  if (chosen) print_cost(selection, costs);
  print_verdict(results);

  if (!options.csv.empty()) limpid::examples::write_file(options.csv, as_csv(results));
  if (!options.json.empty()) limpid::examples::write_file(options.json, as_json(results, study));
  if (!options.device_csv.empty()) limpid::examples::write_file(options.device_csv, as_device_csv(selection, study));
  if (!options.plots.empty()) {
    for (const std::string& file : draw_matrix(results, options.plots)) std::printf("%s\n", file.c_str());
  }
  std::printf("%zu runs of a predictor or the floor, %zu presses of an Omni, %.1f s\n", results.rows.size(),
              4 * study.rows.size(), took.count());
  return std::ranges::all_of(results.findings, &Finding::met) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Predictors beside the floor in every tissue, force, disturbance and period");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "prediction: %s\n", error.what());
    return 1;
  }
}
