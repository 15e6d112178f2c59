// SPDX-License-Identifier: MIT
// The tuning run through the real libusb, on an emulated Omni whose arm is the realistic simulated one.
#include <omni/emulated_machine.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

using limpid::test::EmulatedRun;
using limpid::test::run_program;
using limpid::test::TemporaryFile;
using limpid::test::with_omni;

namespace {

constexpr const char* docks_at_start =
    "--q0 0,0.7853981634,-1.25 --home 0,0.7853981634,1.1061944902 --full-scale 0.3,0.29,0.2 --docked "
    "--fault undock@0.5";

// The watchdogs are far beyond the defaults: what ends a run is the test, not a machine that has other work too.
EmulatedRun calibrate(const std::string& events, const std::string& arguments) {
  const TemporaryFile calibration("calibration.json");
  std::ofstream(calibration.path()) << R"({"full_scale": [0.3, 0.29, 0.2], "home": [0, 0.7853981634, 1.1061944902]})";
  return with_omni(std::string(docks_at_start) + events, "omni_calibrate",
                   "--device usb --watchdog 1000 --calibration " + calibration.path() + " " + arguments);
}

void check_off(const nlohmann::json& omni) {
  REQUIRE(omni.is_object());
  CHECK(omni["motors_on"] == false);
  CHECK(omni["watchdog_trips_with_torque"] == 0);  // it was told, and did not have to find out
}

}  // namespace

TEST_CASE("the tuning run goes through on an Omni on USB, within its torques, and finds its friction") {
  const TemporaryFile results("results.json");
  const auto run = calibrate("", "--duration 14 --json " + results.path());
  CAPTURE(run.program.output);
  CHECK(run.program.code == 0);
  CHECK(run.program.mentions("never run on hardware"));
  check_off(run.omni);
  const double step = 2.0 / 4095;  // of the converter, of full scale
  CHECK(run.omni["largest_torque"][0].get<double>() <= 0.3 / 1.3 + 0.3 * step);
  CHECK(run.omni["largest_torque"][1].get<double>() <= 0.29 / 1.3 + 0.29 * step);
  CHECK(run.omni["largest_torque"][2].get<double>() <= 0.2 / 1.3 + 1.43 * 0.2 * step);
  const auto json = nlohmann::json::parse(results.text(), nullptr, false);
  REQUIRE(json.is_object());
  int found = 0;
  for (const auto& figure : json["sections"][0]["figures"]) {
    if (figure["name"] != "joint 2, friction in motion") continue;
    // a few per mille where nothing holds the emulator up; each time that something does, its clock stands still
    CHECK(figure["found"].get<double>() == doctest::Approx(0.065).epsilon(0.2));
    ++found;
  }
  CHECK(found == 1);
}

TEST_CASE("SIGTERM ends the tuning run with the motors off") {
  const auto run = calibrate(" --terminate-after 5", "");
  CAPTURE(run.program.output);
  CHECK(run.program.code == 1);
  CHECK(run.program.mentions("expected the run to come to its end"));
  check_off(run.omni);
  CHECK(run.omni["motors_were_on"] == true);
}

TEST_CASE("an Omni that is docked, or goes away, ends the tuning run") {
  const auto docked = calibrate(" --fault dock@5", "");
  CHECK(docked.program.code == 1);
  check_off(docked.omni);
  const auto unplugged = calibrate(" --fault unplug@5 --fault plug@5.5", "");
  CAPTURE(unplugged.program.output);
  CHECK(unplugged.program.code == 1);
  CHECK(unplugged.program.mentions("unplugged"));
  CHECK(unplugged.omni["motors_on"] == false);
}

TEST_CASE("without a measured torque scale, or for what needs a sensor, omni_calibrate refuses an Omni on USB") {
  const auto scale = run_program("omni_calibrate", "--device usb");
  CHECK(scale.code != 0);
  CHECK(scale.mentions("--calibration"));
  const auto sensor = run_program("omni_calibrate", "--device usb --procedure ramps --calibration x.json");
  CHECK(sensor.code != 0);
  CHECK(sensor.mentions("force sensor"));
}
