// SPDX-License-Identifier: MIT
// The thesis's procedures for what is to be known of an Omni: torque limits and conversion, friction, parameters.
#include "common/calibrate_options.hpp"
#include "common/calibrate_report.hpp"
#include "common/calibrate_scale.hpp"
#include "common/omni_calibration_file.hpp"
#include "common/output_file.hpp"
#include "common/usb_calibrate.hpp"

#include <exception>
#include <iostream>
#include <stdexcept>

using namespace limpid;
using namespace limpid::examples;

namespace {

std::vector<CalibrationSection> simulated(const CalibrateOptions& options) {
  std::vector<CalibrationSection> sections;
  if (options.ramps) {
    std::array<RampResult, 3> joints;
    for (int i = 0; i < 3; ++i) joints.at(static_cast<std::size_t>(i)) = evaluate_ramp(simulate_ramp(i));
    sections.push_back(ramp_section(joints));
  }
  if (options.tuning) {
    const TuningTask task = simulate_tuning(options.run);
    sections.push_back(tuning_section(evaluate_tuning(task.record()), task.status(), true));
  }
  return sections;
}

CalibrationSection on_usb([[maybe_unused]] const CalibrateOptions& options) {
#ifdef LIMPID_EXAMPLES_WITH_USB
  return tune_on_usb(options);
#else
  throw std::runtime_error("--device usb: expected to be built with libusb-1.0, got none when it was");
#endif
}

// From what an operator has measured; the other fields of the calibration stay.
CalibrationSection torque_scale(const CalibrateOptions& options) {
  OmniCalibration calibration;
  if (!options.calibration.empty()) calibration = read_omni_calibration(options.calibration);
  calibration.full_scale = full_scale_of(read_measured_torques(options.measured));
  if (!options.write.empty()) write_omni_calibration(options.write, calibration);
  CalibrationSection section{.title = "torque command at full scale, from what was measured"};
  for (int i = 0; i < 3; ++i) {
    section.figures.push_back({"joint " + std::to_string(i + 1), calibration.full_scale[i], {}, "N m"});
  }
  return section;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const CalibrateOptions options = parse_calibrate_options(argc, argv);
    if (options.exit_code) return *options.exit_code;
    std::vector<CalibrationSection> sections;
    if (!options.measured.empty()) {
      sections.push_back(torque_scale(options));
    } else if (options.usb) {
      sections.push_back(on_usb(options));
    } else {
      sections = simulated(options);
    }
    print_sections(std::cout, sections);
    if (!options.json.empty()) write_file(options.json, as_json(sections));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "omni_calibrate: " << error.what() << '\n';
    return 1;
  }
}
