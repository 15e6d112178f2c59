// SPDX-License-Identifier: MIT
// palpate on an Omni on USB, by the machine's clock.
#include "omni/emulated_machine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

using namespace limpid::test;

namespace {

// At the start pose, docked there and drawn out after half a second; the operator's force is played to the tissue.
const std::string machine =
    "--fault undock@0.5 --q0 0,0.78539816339744831,-1.25 --home 0,0.78539816339744831,1.1061944901923448 "
    "--full-scale 0.3,0.29,0.2 --coupling playback --docked";

void write_calibration(const TemporaryFile& file) {
  std::ofstream(file.path())
      << R"({"full_scale": [0.3, 0.29, 0.2], "home": [0, 0.78539816339744831, 1.1061944901923448]})";
}

}  // namespace

TEST_CASE("palpate presses through an Omni on USB, and says how the device kept up") {
  const TemporaryFile calibration("palpate_calibration.json"), figures("palpate_figures.json");
  write_calibration(calibration);
  const auto [run, omni] = with_omni(
      machine, "palpate",
      "--device usb --calibration " + calibration.path() +
          " --predictor replay --known --playback --duration 2 --sample-period 0.05 --json " + figures.path());
  CHECK(omni["motors_were_on"].get<bool>());
  CHECK(!omni["motors_on"].get<bool>());
  const std::string said = run.output;
  CAPTURE(said);
  const auto json = nlohmann::json::parse(figures.text());
  const auto& of = json["predictors"]["replay"];
  CHECK(json["settings"]["device"] == "usb");
  CHECK(of["live"]["usb"]["damaged"] == 0);
  CHECK(run.mentions("states a second"));
  // a machine that holds the loop up for longer than the watchdogs ends the run, with a reason
  if (of["fault"].get<bool>()) {
    CHECK(run.code == 2);
    CHECK(run.mentions("latched a fault"));
    MESSAGE("a busy machine: " << of["live"]["usb"]["fault"]);
  } else {
    CHECK(run.code == 0);
    CHECK(of["live"]["ticks"].get<int>() + of["live"]["missed"].get<int>() >= 2000);
    CHECK(of["live"]["usb"]["commands"].get<int>() > 0);
  }
}

TEST_CASE("without a device palpate says what it looked for") {
  const TemporaryFile calibration("palpate_calibration.json");
  write_calibration(calibration);
  const auto run = with_omni(machine + " --vendor 4097", "palpate",
                             "--device usb --predictor hold --playback --calibration " + calibration.path())
                       .program;
  CHECK(run.code == 1);
  CHECK(run.mentions("expected a device 1209:0001 to be plugged in, got none"));
}
