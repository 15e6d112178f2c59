// SPDX-License-Identifier: MIT
#include "calibrate_options.hpp"

#include "option_checks.hpp"
#include "option_values.hpp"

#include <algorithm>

namespace limpid::examples {

CalibrateOptions parse_calibrate_options(int argc, const char* const* argv) {
  CLI::App app(
      "Runs the thesis's procedures for an Omni: torque ramps (limits, conversion, friction) and the tuning run "
      "(parameters), and prints what they find beside what is true of the simulated one. On a device on USB the tuning "
      "run alone; that was never run on hardware.");
  CalibrateOptions options;
  std::vector<std::string> procedures;
  std::string device = "simulated";
  double duration = 30, safety_factor = 1.3, start = 1.25;
  app.add_option("--device", device, "simulated, or usb")
      ->check(CLI::IsMember({"simulated", "usb"}))
      ->capture_default_str();
  app.add_option("--procedure", procedures, "Which: ramps, tuning; all that the device has without")
      ->delimiter(',')
      ->check(CLI::IsMember({"ramps", "tuning"}));
  app.add_option("--duration", duration, "Of the tuning run, s")->check(within(10, 600))->capture_default_str();
  app.add_option("--safety-factor", safety_factor, "Of its torques below Table 5.1")
      ->check(within(1, 100))
      ->capture_default_str();
  app.add_option("--start", start, "Its first parameters as a multiple of Table 5.2")
      ->check(within(0, 10, true))
      ->capture_default_str();
  auto* measured = app.add_option("--measured", options.measured,
                                  "Instead: the torque scale from measured lines joint,part,torque (part of the "
                                  "converter's range, N m at the joint)");
  app.add_option("--path", options.path, "Where an Omni on USB is plugged in, 1-2.4");
  app.add_option("--id", options.id, "USB vendor and product of its bridge board")->type_name("VVVV:PPPP");
  app.add_option("--watchdog", options.watchdog, "ms without commands or states after which its motors go off")
      ->check(within(4, 1000))
      ->capture_default_str();
  app.add_option("--calibration", options.calibration,
                 "Of the Omni on USB; with --measured that of which the other fields are taken; JSON");
  app.add_option("--write", options.write, "File for the calibration with that scale, JSON")
      ->needs(measured)
      ->check(output());
  app.add_option("--json", options.json, "File for the results")->check(output());
  app.final_callback([&] {
    const bool ramps = std::find(procedures.begin(), procedures.end(), "ramps") != procedures.end();
    if (device == "usb" && ramps)
      refuse("--procedure", "tuning on a device on USB: ramps need a force sensor", "ramps");
    if (device == "usb" && options.measured.empty() && options.calibration.empty()) {
      refuse("--calibration", "a file with the measured torque scale, which has no default", "none");
    }
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error);
    return options;
  }
  options.usb = device == "usb";
  const auto wanted = [&](const char* name) {
    return procedures.empty() || std::find(procedures.begin(), procedures.end(), name) != procedures.end();
  };
  options.ramps = wanted("ramps") && !(options.usb && procedures.empty());
  options.tuning = wanted("tuning");
  options.run.theta0 = start * Omni<>::table_5_2();
  options.run.length = from_seconds(duration);
  options.run.limiter.safety_factor = safety_factor;
  return options;
}

}  // namespace limpid::examples
