// SPDX-License-Identifier: MIT
#include <limpid/device/recording.hpp>

#include <support/maximum.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

using limpid::from_seconds;
using limpid::Recording;
using limpid::Time;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

Recording read(const std::string& text, double scale = 1) {
  std::istringstream stream(text);
  return Recording::parse(stream, "press.csv", {.scale = scale});
}

std::string error_of(const std::string& text) {
  try {
    (void)read(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("the samples themselves are met, irregular as their times are") {
  const Recording recording = read("0,1\n0.5,-2\n0.75,4\n2,0.5\n");
  CHECK(recording.at(0ms) == 1.0);
  CHECK(recording.at(500ms) == -2.0);
  CHECK(recording.at(750ms) == 4.0);
  CHECK(recording.at(2s) == 0.5);
  CHECK(recording.duration() == 2s);
  CHECK(recording.size() == 4);
}

TEST_CASE("time starts at the first sample, and the ends are held") {
  const Recording recording = read("10.5,1\n11,2\n12,8\n");
  CHECK(recording.at(0ms) == 1.0);
  CHECK(recording.at(-1s) == 1.0);
  CHECK(recording.at(500ms) == 2.0);
  CHECK(recording.at(1500ms) == 8.0);
  CHECK(recording.at(10h) == 8.0);
  CHECK(recording.duration() == 1500ms);
}

TEST_CASE("header, comments, blank lines, blanks, CR LF, a byte order mark and further columns are taken in stride") {
  const Recording recording = read(
      "\xEF\xBB\xBF# pressed by hand\r\n"
      "t_s,force_z_N,counts\r\n"
      "\r\n"
      "0.0, +1.5e0 ,1023,more\r\n"
      "  # in between\r\n"
      "\t1.0\t,2.5\r\n"
      "2.0,3.5,not a number");
  CHECK(recording.size() == 3);
  CHECK(recording.at(500ms) == doctest::Approx(2.0).epsilon(1e-15));  // a straight line is met, up to rounding
}

TEST_CASE("the scale multiplies each force") { CHECK(read("0,1\n1,4\n", -0.25).at(1s) == -1.0); }

TEST_CASE("between samples runs the cubic whose slopes are the published ones") {
  // equal spacing, secants 1 and 3: inner slope their harmonic mean, 2*1*3/(1 + 3) = 1.5; at the ends the parabola's,
  // (3*1 - 3)/2 = 0 and (3*3 - 1)/2 = 4
  const Recording recording = read("0,0\n1,1\n2,4\n");
  // Hermite at the middle: (y0 + y1)/2 + h (d0 - d1)/8
  CHECK(recording.at(500ms) == doctest::Approx(0.5 + (0 - 1.5) / 8).epsilon(1e-15));
  CHECK(recording.at(1500ms) == doctest::Approx(2.5 + (1.5 - 4) / 8).epsilon(1e-15));
  // spacing 1 and 3, secants 1 and 3: weights 2*3 + 1 = 7 and 3 + 2*1 = 5, slope 12/(7/1 + 5/3) = 18/13;
  // start ((2 + 3) 1 - 1*3)/4 = 1/2
  const Recording uneven = read("0,0\n1,1\n4,10\n");
  CHECK(uneven.at(500ms) == doctest::Approx(0.5 + (0.5 - 18.0 / 13) / 8).epsilon(1e-15));
}

TEST_CASE("it never leaves the interval of its two samples, and an extremum is flat") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> gap(0.001, 0.1), force(-3, 3);
  std::ostringstream text;
  text.precision(17);
  std::vector<double> times, forces;
  for (double t = 0; times.size() < 200; t += gap(random)) {
    times.push_back(t);
    forces.push_back(force(random));
    text << t << ',' << forces.back() << '\n';
  }
  const Recording recording = read(text.str());
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double low = std::min(forces[k], forces[k + 1]), high = std::max(forces[k], forces[k + 1]);
    for (int i = 0; i <= 20; ++i) {
      const double f = recording.at(from_seconds(times[k] + (times[k + 1] - times[k]) * i / 20));
      // a nanosecond of rounded time at slopes below 6 N/ms * 3
      REQUIRE(f >= low - 2e-5);
      REQUIRE(f <= high + 2e-5);
    }
  }
}

TEST_CASE("a smooth press is met to the second order of its spacing, or better") {
  const auto worst = [](int samples) {
    std::ostringstream text;
    text.precision(17);
    for (int i = 0; i <= samples; ++i) {
      const double t = 2.0 * i / samples;
      text << t << ',' << 1.5 * (1 - std::cos(3 * t)) << '\n';
    }
    const Recording recording = read(text.str());
    double error = 0;
    for (int i = 0; i <= 2000; ++i) {
      error = maximum(error, std::abs(recording.at(i * 1ms) - 1.5 * (1 - std::cos(0.003 * i))));
    }
    return error;
  };
  CHECK(worst(100) < 1.5 * 9 * 0.02 * 0.02);  // of the size of h^2 f''
  CHECK(worst(200) < 0.3 * worst(100));       // second order at the extremum, where PCHIP flattens: a quarter
}

TEST_CASE("a missing or non-numeric cell is an error with line and column") {
  CHECK(error_of("t,f\n0,1\n# c\n1\n") == "press.csv: line 4, column 2: expected a finite number, got nothing");
  CHECK(error_of("t,f\n0,1\n1,\n") == "press.csv: line 3, column 2: expected a finite number, got nothing");
  CHECK(error_of("0,1\n,2\n") == "press.csv: line 2, column 1: expected a finite number, got nothing");
  CHECK(error_of("0,1\n1,2x\n") == "press.csv: line 2, column 2: expected a finite number, got \"2x\"");
  CHECK(error_of("0,1\r\n1,abc\r\n") == "press.csv: line 2, column 2: expected a finite number, got \"abc\"");
  CHECK(error_of("0,1\n1 2,1\n") == "press.csv: line 2, column 1: expected a finite number, got \"1 2\"");
  CHECK(error_of("0,1\n1,nan\n") == "press.csv: line 2, column 2: expected a finite number, got \"nan\"");
  CHECK(error_of("0,1\n1,1e999\n") == "press.csv: line 2, column 2: expected a finite number, got \"1e999\"");
  CHECK(error_of("0;1\n1;2\n") == "press.csv: line 1, column 1: expected a finite number, got \"0;1\"");
  CHECK(error_of("t,f\nt,f\n0,1\n") == "press.csv: line 2, column 1: expected a finite number, got \"t\"");
  for (const std::string cell : {"NaN", "inf", "-Infinity", "INFINITY", "+nan", "0.0x", "1.0y", ".5s", "-", "1e999"}) {
    CAPTURE(cell);  // meant as a number, so that the row is no header
    const std::string got = "expected a finite number, got \"" + cell + '"';
    CHECK(error_of(cell + ',' + cell + "\n0,1\n1,2\n") == "press.csv: line 1, column 1: " + got);
    CHECK(error_of("0," + cell + "\n1,1\n2,2\n") == "press.csv: line 1, column 2: " + got);
  }
  for (const std::string cell : {"+-1", "++1", "+"}) {
    CAPTURE(cell);
    CHECK(error_of("0," + cell + "\n1,2\n") ==
          "press.csv: line 1, column 2: expected a finite number, got \"" + cell + '"');
  }
  CHECK(error_of("time,force\n0,1\n") == "press.csv: expected two samples or more");
  CHECK(error_of("t,1\n0,1\n") == "press.csv: line 1, column 1: expected a finite number, got \"t\"");
}

TEST_CASE("times that do not increase are an error with line and column") {
  CHECK(error_of("0,1\n1,2\n1,3\n") == "press.csv: line 3, column 1: expected a time after the one before, got \"1\"");
  CHECK(error_of("0,1\n1,2\n0.5,3\n") ==
        "press.csv: line 3, column 1: expected a time after the one before, got \"0.5\"");
}

TEST_CASE("too few samples, and too long a file, are errors") {
  CHECK(error_of("") == "press.csv: expected two samples or more");
  CHECK(error_of("t,f\n1,2\n") == "press.csv: expected two samples or more");
  CHECK(error_of("0,1\n1e300,2\n") == "press.csv: expected less than a year of samples");
}

TEST_CASE("forces so large that what runs between them has no number are an error") {
  const std::string refused = "press.csv: expected forces whose slopes are finite";
  CHECK(error_of("0,0\n1,1e308\n") == refused);
  CHECK(error_of("0,0\n1,1e308\n2,0\n") == refused);
  CHECK(error_of("0,-1e308\n1,1e308\n") == refused);
  CHECK(error_of("0,1e308\n1,1e308\n") == "no error");
  CHECK(read("0,0\n2,1e300\n").at(1s) == 5e299);
}

TEST_CASE("a file that cannot be read is an error with its name") {
  CHECK_THROWS_WITH_AS((void)Recording::load("no/such.csv"), "no/such.csv: cannot be opened", std::runtime_error);
}

TEST_CASE("a scale that is not finite is refused") {
  CHECK_THROWS_WITH_AS(read("0,1\n1,2\n", std::numeric_limits<double>::infinity()),
                       "Recording: scale: expected finite, got inf", std::invalid_argument);
}

TEST_CASE("reading a force does not allocate") {
  const Recording recording = read("0,1\n0.5,-2\n0.75,4\n2,0.5\n");
  double sum = 0;
  limpid::test::check_no_allocation([&] {
    for (int k = -1; k < 30; ++k) sum += recording.at(k * 100ms);
  });
  CHECK(std::isfinite(sum));
}

TEST_CASE("recorded hand presses are read whole") {
  const char* folder = std::getenv("LIMPID_RECORDINGS");
  if (folder == nullptr) {
    MESSAGE("skipped: LIMPID_RECORDINGS names no folder of recordings");
    return;
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".csv" || entry.path().filename().string().substr(0, 5) != "press") continue;
    CAPTURE(entry.path().string());
    const Recording recording = Recording::load(entry.path().string(), {.scale = 0.05});
    CHECK(recording.size() > 100);
    CHECK(recording.duration() > 1s);
    bool finite = true;
    for (Time now{0}; now <= recording.duration(); now += 1ms) finite = finite && std::isfinite(recording.at(now));
    CHECK(finite);
    ++files;
  }
  CHECK(files > 0);
}
