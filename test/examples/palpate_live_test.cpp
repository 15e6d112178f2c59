// SPDX-License-Identifier: MIT
// palpate by the machine's clock: on the simulated arm, and, where there is an emulated one, on USB.
#include "support/ask_program.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

using limpid::test::ask_program;
using limpid::test::check_refused;

namespace {

void refused(const std::string& arguments, const std::string& option) { check_refused("palpate", arguments, option); }

}  // namespace

TEST_CASE("a live run ends in time, and says how it kept its deadlines") {
  const auto [run, json] = ask_program("palpate", "--realtime --predictor model --duration 2 --sample-period 0.05");
  const auto& live = json["predictors"]["model"]["live"];
  CHECK(live["ticks"].get<int>() + live["missed"].get<int>() >= 2000);
  CHECK(live["samples"].get<int>() > 5);
  CHECK(!json["predictors"]["model"].contains("windows"));
  CHECK(run.mentions("missed"));
  CHECK(run.mentions("lateness"));
}

TEST_CASE("a live run's prediction is that of the simulated run, as far as its samples come when they should") {
  const std::string press = "--predictor replay --known --robot realistic --duration 4 --sample-period 0.05";
  const auto simulated = ask_program("palpate", press).json, live = ask_program("palpate", press + " --realtime").json;
  const auto error = [](const auto& json) {
    return json["predictors"]["replay"]["prediction_error"]["l2"].template get<double>();
  };
  CHECK(error(simulated) < 1e-9);
  // exact between ticks of a force that is linear there: a tick that was missed leaves the chord of a force of 3 N that
  // turns in some 0.1 s, 1e-3 of it at most, on a tool of 0.1 kg in 800 N/m
  CHECK(error(live) < 1e-4);
}

TEST_CASE("options of a live run that contradict each other are refused by name") {
  refused("--device usb --predictor model", "--device");
  refused("--device usb --predictor model --playback --robot ideal --calibration /dev/null", "--robot");
  refused("--device usb --predictor model --calibration /dev/null", "--playback");
  refused("--calibration /dev/null", "--calibration");
  refused("--usb-path 1-1", "--usb-path");
  refused("--realtime", "--predictor");
  refused("--realtime --predictor model --operator hand 0.5,20,500", "--operator");
  refused("--realtime --predictor model --jitter 0.1", "--jitter");
  refused("--device carrier-pigeon", "--device");
}

TEST_CASE("a calibration without a torque scale, or that is none, is refused by its field") {
  const auto path = std::filesystem::temp_directory_path() / ("limpid_calibration_" + std::to_string(::getpid()));
  std::ofstream(path) << R"({"home": [0, 0, 0]})";
  refused("--device usb --predictor model --playback --calibration " + path.string(), "full_scale");
  std::ofstream(path) << "[";
  refused("--device usb --predictor model --playback --calibration " + path.string(), path.string());
  std::filesystem::remove(path);
}
