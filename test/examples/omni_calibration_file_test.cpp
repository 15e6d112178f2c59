// SPDX-License-Identifier: MIT
#include "common/omni_calibration_file.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>

using limpid::OmniCalibration;
using limpid::examples::read_omni_calibration;
using limpid::examples::write_omni_calibration;

namespace {

// A file that is gone with its test.
class CalibrationFile {
 public:
  explicit CalibrationFile(const std::string& text = {}) { std::ofstream(path_) << text; }
  ~CalibrationFile() { std::filesystem::remove(path_); }
  CalibrationFile(const CalibrationFile&) = delete;
  CalibrationFile& operator=(const CalibrationFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_ = (std::filesystem::temp_directory_path() / "limpid_omni_calibration_test.json").string();
};

void refused(const std::string& text, std::initializer_list<const char*> words) {
  const CalibrationFile file(text);
  CAPTURE(text);
  std::string said;
  try {
    (void)read_omni_calibration(file.path());
  } catch (const std::invalid_argument& error) {
    said = error.what();
  }
  CAPTURE(said);
  CHECK(said.find(file.path()) != std::string::npos);
  CHECK(said.find("got") != std::string::npos);
  for (const char* word : words) CHECK(said.find(word) != std::string::npos);
}

}  // namespace

TEST_CASE("a calibration comes back from its file to the last bit") {
  const CalibrationFile file;
  const OmniCalibration written{.full_scale = {0.1 + 0.2, 1.0 / 3, 0.2},
                                .home = {1e-17, -0.23, 0.37},
                                .counts_sign = {-1, 1, -1},
                                .counts_per_turn = 15'001.3,
                                .gimbal_slope = {1, 2, 3},
                                .gimbal_offset = {-4, 5, 6}};
  write_omni_calibration(file.path(), written);
  const OmniCalibration read = read_omni_calibration(file.path());
  CHECK(read.full_scale == written.full_scale);
  CHECK(read.home == written.home);
  CHECK(read.counts_sign == written.counts_sign);
  CHECK(read.counts_per_turn == written.counts_per_turn);
  CHECK(read.gimbal_slope == written.gimbal_slope);
  CHECK(read.gimbal_offset == written.gimbal_offset);
}

TEST_CASE("what a calibration file leaves out has the library's default") {
  const CalibrationFile file(R"({"full_scale": [1, 2, 3]})");
  const OmniCalibration read = read_omni_calibration(file.path());
  CHECK(read.full_scale == Eigen::Vector3d(1, 2, 3));
  CHECK(read.home == OmniCalibration{}.home);
  CHECK(read.counts_per_turn == OmniCalibration{}.counts_per_turn);
}

TEST_CASE("the torque scale has no default: without it a calibration file is refused") {
  refused(R"({"home": [0, -0.23, 0.37]})", {"full_scale", "expected"});
  refused("{}", {"full_scale", "expected"});
}

TEST_CASE("fields that are unknown or twice there are refused by name") {
  refused(R"({"full_scale": [1, 1, 1], "homing": [0, 0, 0]})", {"homing", "home", "counts_per_turn"});
  refused(R"({"full_scale": [1, 1, 1], "full_scale": [2, 1, 1]})", {"full_scale", "once", "twice"});
}

TEST_CASE("fields of another type or length are refused with what was expected and found") {
  refused(R"({"full_scale": 0.3})", {"full_scale", "expected 3 numbers", "0.3"});
  refused(R"({"full_scale": [1, 1]})", {"full_scale", "expected 3 numbers", "[1,1]"});
  refused(R"({"full_scale": [1, 1, 1, 1]})", {"full_scale", "expected 3 numbers"});
  refused(R"({"full_scale": [1, "1", 1]})", {"full_scale", "expected 3 numbers", "\"1\""});
  refused(R"({"full_scale": [1, null, 1]})", {"full_scale", "expected 3 numbers", "null"});
  refused(R"({"full_scale": [1, 1, 1], "counts_per_turn": [1]})", {"counts_per_turn", "expected a number", "[1]"});
  refused(R"({"full_scale": [1, 1, 1], "counts_per_turn": true})", {"counts_per_turn", "expected a number", "true"});
}

TEST_CASE("values that cannot serve are refused by the library's words") {
  refused(R"({"full_scale": [1, 0, 1]})", {"full_scale", "> 0 N m", "1 0 1"});
  refused(R"({"full_scale": [1, 1, 1], "counts_sign": [1, 2, 1]})", {"counts_sign", "1 or -1"});
  refused(R"({"full_scale": [1, 1, 1], "counts_per_turn": 0})", {"counts_per_turn", "> 0"});
  refused(R"({"full_scale": [1, 1e999, 1]})", {"JSON"});
}

TEST_CASE("what is no JSON object, or no file, is refused") {
  refused("", {"expected"});
  refused("[1, 2, 3]", {"expected an object"});
  refused("{\"full_scale\": [1, 1, 1]", {"expected JSON"});
  CHECK_THROWS_AS((void)read_omni_calibration("/nonexistent/calibration.json"), std::invalid_argument);
  CHECK_THROWS_AS((void)read_omni_calibration("/tmp"), std::invalid_argument);
}

TEST_CASE("a calibration without a torque scale is not written") {
  const CalibrationFile file;
  CHECK_THROWS_AS(write_omni_calibration(file.path(), OmniCalibration{}), std::invalid_argument);
  CHECK_THROWS_AS(write_omni_calibration("/nonexistent/calibration.json", {.full_scale = {1, 1, 1}}),
                  std::runtime_error);
}
