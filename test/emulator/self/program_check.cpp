// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

struct Outcome {
  int code = -1;
  nlohmann::json summary{};
};

// omni_emulator with these options, and its host for so many frames.
Outcome emulate(const std::string& options, int frames) {
  const std::string command = std::string(std::getenv("OMNI_EMULATOR")) + " " + options + " -- " +
                              std::getenv("OMNI_EMULATOR_HOST") + " " + std::to_string(frames);
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) text += static_cast<char>(letter);
  const int status = pclose(pipe);
  return {WEXITSTATUS(status), nlohmann::json::parse(text, nullptr, false)};
}

}  // namespace

TEST_CASE("omni_emulator gives back its program's exit code, and what the Omni saw") {
  const auto [code, summary] = emulate("--full-scale 0.3,0.2,0.1", 50);
  CHECK(code == 7);
  REQUIRE(summary.is_object());
  CHECK(summary["exit_code"] == 7);
  CHECK(summary["commands"] == 51);
  CHECK(summary["commands_invalid"] == 0);
  CHECK(summary["motors_were_on"] == true);
  CHECK(summary["motors_on"] == false);
  CHECK(summary["largest_torque"][1] == doctest::Approx(0.2 * (2 * 3000 / 4095.0 - 1)));
}

TEST_CASE("motors of a killed program's Omni are off after its watchdog, and no earlier than the torque was there") {
  const auto [code, summary] = emulate("--kill-after 0.5", 1'000'000);
  CHECK(code == 0);
  REQUIRE(summary.is_object());
  CHECK(summary["exit_code"] == 128 + 9);
  CHECK(summary["torque_at_kill"][1] > 0.1);
  CHECK(summary["torque"] == nlohmann::json{0.0, 0.0, 0.0});
  CHECK(summary["watchdog_trips_with_torque"] == 1);
  CHECK(summary["torque_after_end_ms"] > 0.0);
}

TEST_CASE("a fault comes at its time") {
  const auto [code, summary] = emulate("--fault unplug@0.3 --fault plug@0.5", 1'000'000);
  CHECK(code == 5);
  REQUIRE(summary.is_object());
  CHECK(summary["motors_on"] == false);
}

TEST_CASE("a fault that is not known is refused") { CHECK(emulate("--fault smoke@1", 1).code != 0); }
