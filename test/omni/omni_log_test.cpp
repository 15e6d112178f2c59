// SPDX-License-Identifier: MIT
#include <omni/emulated_machine.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

using limpid::test::TemporaryFile;
using limpid::test::with_omni;

namespace {

using Row = std::vector<std::string>;
constexpr std::size_t q2 = 2, count1 = 11, calibrated = 15, sequence = 16, device_us = 17, status = 18, columns = 19;

std::vector<Row> rows_of(const std::string& text) {
  std::vector<Row> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

struct Losses {
  long rows = 0, lost = 0, unread = 0;
};

Losses losses_of(const std::string& said) {
  Losses losses;
  REQUIRE(std::sscanf(said.c_str(), "%ld rows; lost: %ld on the way, %ld not read", &losses.rows, &losses.lost,
                      &losses.unread) == 3);
  return losses;
}

}  // namespace

TEST_CASE("omni_log writes each state once, in order, with the motors off") {
  const TemporaryFile file("omni_log.csv");
  const auto run = with_omni("--docked", "omni_log", "--duration 1 --output " + file.path());
  CAPTURE(run.program.output);
  CHECK(run.program.code == 0);
  const auto rows = rows_of(file.text());
  REQUIRE(rows.size() > 10);
  long gaps = 0;
  CHECK(rows[0][q2] == "q2");
  CHECK(rows[0][status] == "status");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    REQUIRE(rows[i].size() == columns);
    if (i == 1) continue;
    const long step = std::stol(rows[i][sequence]) - std::stol(rows[i - 1][sequence]);
    REQUIRE(step > 0);
    REQUIRE(std::stol(rows[i][device_us]) > std::stol(rows[i - 1][device_us]));
    gaps += step - 1;
  }
  const Losses losses = losses_of(run.program.output);
  CHECK(losses.rows == static_cast<long>(rows.size()) - 1);
  CHECK(gaps >= losses.unread);  // what was lost on the way after the last row is no gap
  CHECK(gaps <= losses.lost + losses.unread);
  CHECK(rows.back()[calibrated] == "1");
  CHECK(std::stod(rows.back()[q2]) == doctest::Approx(0.23));  // where the calibration's home has it
  REQUIRE(run.omni.is_object());
  CHECK(run.omni["motors_were_on"] == false);
}

TEST_CASE("the log's joints are those of its calibration") {
  const TemporaryFile file("omni_log.csv"), calibration("omni_log.json");
  std::ofstream(calibration.path()) << R"({"full_scale": [1, 1, 1], "home": [0, 0.5, 0.37]})";
  const auto run = with_omni("--docked", "omni_log",
                             "--duration 0.3 --output " + file.path() + " --calibration " + calibration.path());
  CAPTURE(run.program.output);
  CHECK(run.program.code == 0);
  CHECK(std::stod(rows_of(file.text()).back()[q2]) == doctest::Approx(0.5));
}

TEST_CASE("counts are written before it was docked, without angles") {
  const TemporaryFile file("omni_log.csv");
  CHECK(with_omni("--q0 0.5,0.785,-1.25 --home 0,0,0", "omni_log", "--duration 0.3 --output " + file.path())
            .program.code == 0);
  const Row last = rows_of(file.text()).back();
  CHECK(last[calibrated] == "0");
  // -0.5 rad of the device, (5.1), of 15000 counts a turn; its sign is +
  CHECK(std::stol(last[count1]) == std::lround(-0.5 * 15'000 / (2 * 3.14159265358979)));
  CHECK(last[status] == "no_sample");
}

TEST_CASE("SIGTERM ends a log with its rows written") {
  const TemporaryFile file("omni_log.csv");
  const auto run = with_omni("--docked --terminate-after 1", "omni_log", "--output " + file.path());
  CAPTURE(run.program.output);
  CHECK(run.program.code == 0);
  CHECK(run.program.mentions("rows; lost"));
  CHECK(rows_of(file.text()).back().size() == columns);
}

TEST_CASE("a log goes on where the Omni was unplugged and came back, and tells what was lost") {
  const TemporaryFile file("omni_log.csv");
  const auto run = with_omni("--docked --fault unplug@0.5 --fault plug@0.8 --terminate-after 2.5", "omni_log",
                             "--output " + file.path());
  CAPTURE(run.program.output);
  CHECK(run.program.code == 0);
  CHECK(run.program.mentions("disconnects 1"));
  CHECK(rows_of(file.text()).back()[status] == "ok");
}

TEST_CASE("a file that cannot be written ends the log with a message") {
  const auto program = with_omni("--docked", "omni_log", "--duration 5 --output /dev/full").program;
  CHECK(program.code != 0);
  CHECK(program.mentions("/dev/full"));
}
