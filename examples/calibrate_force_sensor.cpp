// SPDX-License-Identifier: MIT
// The calibration of a three-axis force sensor, section 5.3.3 with cross-talk: a matrix from weights in known
// directions, how well it is known and what it leaves; or the same of a simulated sensor, beside the truth.
#include "common/output_file.hpp"
#include "common/weights_file.hpp"
#include "common/weights_options.hpp"
#include "common/weights_report.hpp"
#include "common/weights_simulation.hpp"

#include <exception>
#include <iostream>
#include <stdexcept>

int main(int argc, char** argv) {
  using namespace limpid::examples;
  try {
    const WeightsOptions options = parse_weights_options(argc, argv);
    if (options.exit_code) return *options.exit_code;
    CalibrationFindings found;
    if (options.simulate) found.truth = simulate_weights(options);
    const auto loads = options.simulate ? found.truth->loads : load_weights(options.weights);
    if (!options.csv.empty()) {
      write_file(options.csv, as_csv(loads));
      std::cout << "weights: " << options.csv << '\n';
    }
    found.loads = loads.size();
    found.fit = limpid::fit_force_calibration(loads, {.lever_gain = Eigen::Vector3d::Constant(options.lever_gain),
                                                      .lever_arm = options.lever_arm,
                                                      .largest_condition = options.largest_condition});
    if (!found.fit.is_fitted()) {
      throw std::runtime_error((options.simulate ? "simulated weights" : options.weights) + ": " + found.fit.reason);
    }
    std::cout << words_of(found);
    if (!options.json.empty()) {
      write_file(options.json, as_json(options, found).dump(2) + '\n');
      std::cout << "calibration: " << options.json << '\n';
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "calibrate_force_sensor: " << error.what() << '\n';
    return 1;
  }
}
