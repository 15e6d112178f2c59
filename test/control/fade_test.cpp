// SPDX-License-Identifier: MIT
#include <limpid/control/fade.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <stdexcept>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

// Healthy from its first call, at 0, on; at 1 from 50 ms on.
Fade<> risen() {
  Fade<> fade({.fade_out = 10ms, .fade_in = 50ms, .hold = 0ms});
  (void)fade.update(0ms, true);
  (void)fade.update(50ms, true);
  return fade;
}

}  // namespace

TEST_CASE("a fade begins at zero and comes smoothly to one in the stated time") {
  Fade<> fade({.fade_out = 10ms, .fade_in = 40ms, .hold = 0ms});
  CHECK(fade.update(1s, true) == 0);
  // 3 u^2 - 2 u^3, exact in binary
  CHECK(fade.update(1010ms, true) == 0.15625);
  CHECK(fade.update(1020ms, true) == 0.5);
  CHECK(fade.update(1030ms, true) == 0.84375);
  CHECK(fade.update(1040ms, true) == 1);
  CHECK(fade.update(2s, true) == 1);
}

TEST_CASE("it is zero within the stated time of the last healthy call, and stays there") {
  Fade<> fade = risen();
  for (int k = 1; k < 10; ++k) {
    // a difference of numbers up to 1, each rounded once
    CHECK(fade.update(50ms + k * 1ms, false) == doctest::Approx(1 - k / 10.0).epsilon(1e-15));
  }
  CHECK(fade.update(60ms, false) == 0);
  CHECK(fade.update(70ms, false) == 0);
}

TEST_CASE("after a pause of the loop it has gone as far as in ticks") {
  Fade<> fade = risen();
  CHECK(fade.update(55ms, false) == 0.5);
  CHECK(fade.update(90ms, false) == 0);
}

TEST_CASE("until the source has been healthy for long enough it goes on falling") {
  Fade<> fade({.fade_out = 10ms, .fade_in = 40ms, .hold = 5ms});
  (void)fade.update(0ms, true);
  (void)fade.update(5ms, true);
  CHECK(fade.update(45ms, true) == 1);
  CHECK(fade.update(46ms, false) == doctest::Approx(0.9).epsilon(1e-15));
  CHECK(fade.update(47ms, true) == doctest::Approx(0.8).epsilon(1e-15));
  CHECK(fade.update(50ms, true) == 0.5);
  CHECK(fade.update(51ms, false) == doctest::Approx(0.4).epsilon(1e-15));  // the hold begins anew
  CHECK(fade.update(55ms, true) == 0);
  CHECK(fade.update(59ms, true) == 0);
  CHECK(fade.update(60ms, true) == 0);
  CHECK(fade.update(80ms, true) == 0.5);
}

TEST_CASE("it comes back from where it has come to, and from there takes the whole time") {
  Fade<> fade = risen();
  CHECK(fade.update(55ms, false) == 0.5);
  CHECK(fade.update(56ms, true) == doctest::Approx(0.4).epsilon(1e-15));  // turns here
  CHECK(fade.update(81ms, true) == doctest::Approx(0.7).epsilon(1e-15));
  CHECK(fade.update(106ms, true) == 1);
}

TEST_CASE("it goes out from within its way back, too") {
  Fade<> fade({.fade_out = 10ms, .fade_in = 40ms, .hold = 0ms});
  (void)fade.update(0ms, true);
  CHECK(fade.update(20ms, true) == 0.5);
  CHECK(fade.update(21ms, false) == doctest::Approx(0.4).epsilon(1e-15));
  CHECK(fade.update(25ms, false) == 0);
}

TEST_CASE("whatever the source does it stays from 0 to 1, and its slope within the stated bounds") {
  std::mt19937 random(20260101);
  std::uniform_int_distribution<int> step(1, 4'000'000), luck(0, 99);
  Fade<> fade({.fade_out = 10ms, .fade_in = 40ms, .hold = 3ms});
  Time now{};
  double last = fade.update(now, true), largest = 0, smallest = 1, too_far = 0;
  bool healthy = true;
  for (int k = 0; k < 100'000; ++k) {
    const Duration dt{step(random)};
    now += dt;
    if (luck(random) < 5) healthy = !healthy;
    const double factor = fade.update(now, healthy), rise = factor - last;
    const double most = 1.5 * in_seconds(dt) / 0.040, least = -in_seconds(dt) / 0.010;
    too_far = std::max({too_far, rise - most, least - rise});
    largest = std::max(largest, factor);
    smallest = std::min(smallest, factor);
    last = factor;
  }
  // each factor is rounded a few times, at numbers up to 1
  CHECK(too_far <= 8 * std::numeric_limits<double>::epsilon());
  CHECK(smallest == 0);
  CHECK(largest == 1);
}

TEST_CASE("where time does not advance the factor does not") {
  Fade<> fade = risen();
  CHECK(fade.update(50ms, false) == 1);
  CHECK(fade.update(10ms, false) == 1);
  CHECK(fade.update(55ms, false) == 0.5);
  CHECK(fade.factor() == 0.5);
}

TEST_CASE("a source that was never healthy has no force") {
  Fade<> fade({.fade_out = 10ms, .fade_in = 40ms, .hold = 3ms});
  for (int k = 0; k < 100; ++k) CHECK(fade.update(k * 1ms, false) == 0);
}

TEST_CASE("the ends of the range of time do not overflow") {
  Fade<float> fade({.fade_out = 10ms, .fade_in = Duration::max(), .hold = 0ms});
  CHECK(fade.update(Time::min(), true) == 0.0F);
  CHECK(fade.update(Time::max(), true) == 1.0F);
  CHECK(fade.update(Time::min(), false) == 1.0F);
}

TEST_CASE("a fade that takes no time, or holds a negative one, is refused") {
  CHECK_THROWS_WITH_AS(Fade<>({.fade_out = 0ms, .fade_in = 1ms}), "Fade: fade_out: expected > 0 s, got 0 s",
                       std::invalid_argument);
  CHECK_THROWS_AS(Fade<>({.fade_out = 1ms, .fade_in = -1ms}), std::invalid_argument);
  CHECK_THROWS_AS(Fade<>({.fade_out = 1ms, .fade_in = 1ms, .hold = -1ns}), std::invalid_argument);
}

TEST_CASE("a fade does not allocate") {
  Fade<> fade = risen();
  limpid::test::check_no_allocation([&] { (void)fade.update(60ms, false); });
}
