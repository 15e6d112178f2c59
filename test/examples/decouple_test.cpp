// SPDX-License-Identifier: MIT
#include "common/decouple.hpp"
#include <support/maximum.hpp>
#include "common/decouple_device.hpp"

#include <doctest/doctest.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace limpid::examples;
using limpid::Realism;
using limpid::Status;
using limpid::test::maximum;

namespace {

struct NotedRow {
  QKind kind;
  double limit;  // Hz
  std::array<double, 6> ratios, last_digit;
};

// The notes' table; 0 where it is unstable.
const std::array<NotedRow, 3> noted{
    {{QKind::first_order, 214.27, {.2222, .1302, .0682, .0276, .01383, .00692}, {1e-4, 1e-4, 1e-4, 1e-4, 1e-5, 1e-5}},
     {QKind::butterworth, 302.97, {.4417, .2161, .1010, .0394, .0196, .0098}, {1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4}},
     {QKind::umeno_hori, 184.71, {.3461, .1445, .0461, .00813, .00206, 0}, {1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1}}}};
constexpr std::array cutoffs{5.0, 10.0, 20.0, 50.0, 100.0, 200.0};

// What `run_decouple` says, out of the test's way.
struct Silence {
  std::ostringstream said;
  std::streambuf* before = std::cout.rdbuf(said.rdbuf());
  Silence() = default;
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() { std::cout.rdbuf(before); }
};

int parse(const std::string& line, DecoupleOptions& options) {
  CLI::App app;
  add_decouple_options(app, options);
  try {
    app.parse(line);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code();
  }
  return 0;
}

}  // namespace

TEST_CASE("the five-bar's M and B at the notes' pose have the notes' digits") {
  const auto plant = linear_five_bar();
  Eigen::Matrix2d M, B;
  M << .014848, -.002748, -.002748, .007662;
  B << .045845, -.011546, -.011546, .014866;
  CHECK((plant.M - M).cwiseAbs().maxCoeff() < 0.51e-6);
  CHECK((plant.B - B).cwiseAbs().maxCoeff() < 0.51e-6);
}

// The notes' figures are for M and B as printed, which moves them by some 1e-4 of themselves.
TEST_CASE("the table of coupling ratios is the notes', and 0.361 without observers") {
  const auto plant = linear_five_bar();
  CHECK(std::abs(coupling_without_observer(plant, 5) - 0.361) < 0.51e-3);
  for (const NotedRow& row : noted) {
    for (std::size_t i = 0; i < cutoffs.size(); ++i) {
      CAPTURE(name(row.kind));
      CAPTURE(cutoffs[i]);
      const auto ratio = coupling(plant, row.kind, cutoffs[i], 5);
      REQUIRE(ratio.has_value() == (row.ratios[i] > 0));
      if (ratio) CHECK(std::abs(*ratio - row.ratios[i]) < 0.51 * row.last_digit[i] + 2e-4 * row.ratios[i]);
    }
  }
}

TEST_CASE("the limits of stability are the notes' to 0.1 Hz") {
  for (const NotedRow& row : noted) CHECK(std::abs(cutoff_limit(linear_five_bar(), row.kind).cutoff - row.limit) < 0.1);
}

// Motion of 0.1 mm, in which the pose changes by less than a thousandth; the transient leaves exp(-2.5 s/0.45 s).
TEST_CASE("small motion of the ideal device couples as the linear one, with and without observers") {
  const auto plant = linear_five_bar();
  const auto free = run({.force = 1e-3});
  CHECK(free.ended);
  CHECK(free.status == Status::ok);
  CHECK(free.ratio == doctest::Approx(coupling_without_observer(plant, 5)).epsilon(2e-3));
  for (const QKind kind : q_kinds) {
    for (const double cutoff : {20.0, 100.0}) {
      CAPTURE(name(kind));
      CAPTURE(cutoff);
      const auto observed = run({.observer = Observer{kind, cutoff}, .force = 1e-3});
      CHECK(observed.ended);
      CHECK(observed.ratio == doctest::Approx(*coupling(plant, kind, cutoff, 5)).epsilon(5e-3));
    }
  }
}

TEST_CASE("with the hand fed to the observers the ideal device moves along x as its nominal axis") {
  const auto observed = run({.observer = Observer{QKind::first_order, 100}, .force = 1e-3});
  double least = 0, greatest = 0;
  for (std::size_t i = 2500; i < observed.x.size(); ++i) {
    least = i == 2500 ? observed.x[i] : std::min(least, observed.x[i]);
    greatest = i == 2500 ? observed.x[i] : maximum(greatest, observed.x[i]);
  }
  const double omega = 2 * std::acos(-1.0) * 5;
  const double nominal = 1e-3 / (omega * std::hypot(omega * nominal_mass, nominal_damping));
  CHECK((greatest - least) / 2 == doctest::Approx(nominal).epsilon(0.03));  // Q at 5 of 100 Hz leaves 5 % of M - m_n
}

TEST_CASE("on a device with a 12-bit converter and Coulomb friction the observers take most of the coupling") {
  const auto free = run({.realism = Realism::realistic, .force = 0.05});
  const auto observed = run({.realism = Realism::realistic, .observer = Observer{}, .force = 0.05});
  CHECK(free.ended);
  CHECK(observed.ended);
  CHECK(observed.ratio < free.ratio / 10);
  CHECK(observed.y_range < free.y_range / 10);
  // friction that changes sign at each turn is a disturbance, too, so that more is left than on the ideal device
  CHECK(observed.ratio > *coupling(linear_five_bar(), QKind::first_order, 50, 5));
}

TEST_CASE("a force that drives the device to its limits ends the run, and is told") {
  const auto trace = run({.force = 0.5});
  CHECK_FALSE(trace.ended);
  CHECK(has(trace.status, Status::fault));
}

TEST_CASE("a cut-off beyond the filter's limit is refused with the limit") {
  const Silence silence;
  CHECK_THROWS_AS((void)run_decouple({.filter = "q31", .cutoff = 190}), std::invalid_argument);
  try {
    (void)run_decouple({.filter = "q31", .cutoff = 190});
  } catch (const std::invalid_argument& error) {
    CHECK(std::string(error.what()).find("184.7") != std::string::npos);
  }
}

TEST_CASE("the figures are written as JSON") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_decouple.json";
  DecoupleOptions options;
  REQUIRE(parse("--filter butterworth --cutoff 100 --force 0.02 --json " + path.string(), options) == 0);
  {
    const Silence silence;
    CHECK(run_decouple(options) == 0);
    CHECK(silence.said.str().find("0.361") != std::string::npos);
  }
  const auto json = nlohmann::json::parse(std::ifstream(path));
  std::filesystem::remove(path);
  CHECK(json["without_observer"].get<double>() == doctest::Approx(0.361).epsilon(1e-3));
  CHECK(json["table"].size() == 3);
  CHECK(json["table"][2]["filter"] == "q31");
  CHECK(json["table"][2]["ratios"][5]["ratio"].is_null());  // 200 Hz is unstable
  CHECK(json["runs"].size() == 4);
  CHECK(json["runs"][1]["observers"] == true);
  CHECK(json["runs"][1]["ratio"].get<double>() == doctest::Approx(.0196).epsilon(0.01));
  CHECK(json["settings"]["filter"] == "butterworth");
}

TEST_CASE("options that cannot be are refused") {
  DecoupleOptions options;
  for (const std::string line : {"--filter none", "--cutoff 0", "--cutoff nan", "--frequency 0", "--force -1",
                                 "--force 1e9", "--json /nowhere/at/all", "--plot /dev/null", "--nothing 1"}) {
    CAPTURE(line);
    CHECK(parse(line, options) != 0);
  }
}
