// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <support/run_program.hpp>

#include <filesystem>
#include <fstream>
#include <string>

using limpid::test::run_program;
using Json = nlohmann::json;

namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("limpid_calibrate_" + name)).string();
}

Json read(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file, nullptr, false);
}

}  // namespace

TEST_CASE("omni_calibrate prints and writes what it finds beside the truth") {
  const std::string path = temporary("results.json");
  const auto run = run_program("omni_calibrate", "--json " + path);
  CAPTURE(run.output);
  CHECK(run.code == 0);
  CHECK(run.mentions("joint 3, conversion"));
  CHECK(run.mentions("theta9, fitted"));
  const Json json = read(path);
  REQUIRE(json.is_object());
  REQUIRE(json["sections"].size() == 2);
  int judged = 0;
  for (const Json& figure : json["sections"][0]["figures"]) {
    if (!figure.contains("relative_error")) continue;
    CHECK(std::abs(figure["relative_error"].get<double>()) < 0.02);  // as omni_calibrate_test.cpp says
    ++judged;
  }
  CHECK(judged >= 11);
  std::filesystem::remove(path);
}

TEST_CASE("omni_calibrate turns measured torques into a calibration") {
  const std::string measured = temporary("measured.csv"), written = temporary("calibration.json");
  std::ofstream(measured) << "1,0,0\n1,0.5,-0.15\n2,0,0.1\n2,0.5,0.3\n3,0,0\n3,1,0.286\n";
  const auto run = run_program("omni_calibrate", "--measured " + measured + " --write " + written);
  CAPTURE(run.output);
  CHECK(run.code == 0);
  const Json json = read(written);
  REQUIRE(json.is_object());
  CHECK(json["full_scale"][0].get<double>() == doctest::Approx(0.3));
  CHECK(json["full_scale"][1].get<double>() == doctest::Approx(0.4));
  CHECK(json["full_scale"][2].get<double>() == doctest::Approx(0.2));
  std::filesystem::remove(measured);
  std::filesystem::remove(written);
}

TEST_CASE("omni_calibrate refuses wrong options and names them") {
  const auto refused = [](const std::string& arguments, const std::string& word) {
    const auto run = run_program("omni_calibrate", arguments);
    CAPTURE(run.output);
    CHECK(run.code != 0);
    CHECK(run.mentions(word));
  };
  refused("--procedure guess", "--procedure");
  refused("--duration 1", "--duration");
  refused("--safety-factor 0.5", "--safety-factor");
  refused("--start 0", "--start");
  refused("--write /tmp/x.json", "--measured");
  refused("--measured /nonexistent.csv", "/nonexistent.csv");
}
