// SPDX-License-Identifier: MIT
#include "weights_options.hpp"

#include "option_checks.hpp"
#include "option_values.hpp"
#include "output_file.hpp"

#include <CLI/CLI.hpp>

namespace limpid::examples {

namespace {

void add_options(CLI::App& app, WeightsOptions& options) {
  app.add_option("weights", options.weights,
                 "CSV of dx, dy, dz, load, cx, cy, cz: direction of the force in the sensor's frame, N, counts")
      ->check(CLI::ExistingFile);
  CLI::Option* simulate =
      app.add_flag("--simulate", options.simulate, "hang the weights of the thesis on a simulated sensor instead");
  app.add_option("--noise", options.noise, "of a simulated frame, N")
      ->check(within(0, 10))
      ->needs(simulate)
      ->capture_default_str();
  app.add_option("--frames", options.frames, "averaged for each simulated weight")
      ->check(within(1, 1e5))
      ->needs(simulate)
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the simulated noise")->check(whole(1e9))->needs(simulate);
  app.add_option("--csv", options.csv, "write the simulated weights here")->check(output())->needs(simulate);
  app.add_option("--lever-arm", options.lever_arm, "from the sensor's flange to where the weights hang, m")
      ->check(within(0, 10))
      ->capture_default_str();
  app.add_option("--lever-gain", options.lever_gain, "a_m of F = F_meas/(1 + a_m r), 1/m")
      ->check(within(0, 1e4))
      ->capture_default_str();
  app.add_option("--condition", options.largest_condition, "largest condition number that is accepted")
      ->check(within(1.5, 1e6))
      ->capture_default_str();
  app.add_option("--json", options.json, "write the calibration here")->check(output());
}

}  // namespace

WeightsOptions parse_weights_options(int argc, const char* const* argv) {
  CLI::App app{"The calibration of a three-axis force sensor from weights in known directions.",
               "calibrate_force_sensor"};
  WeightsOptions options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
    if (options.simulate != options.weights.empty()) {
      refuse("weights", "accepts a CSV of weights, or --simulate in its place");
    }
    if (!options.json.empty() && !options.csv.empty() && is_same_file(options.json, options.csv)) {
      refuse("--json, --csv", "accept different files, got " + options.json + " twice");
    }
    for (const std::string& path : {options.json, options.csv}) {
      if (!path.empty() && !options.weights.empty() && is_same_file(path, options.weights)) {
        refuse("--json", "accepts a file other than the weights, got " + path);
      }
    }
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error);
  }
  return options;
}

}  // namespace limpid::examples
