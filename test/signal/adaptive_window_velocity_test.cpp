// SPDX-License-Identifier: MIT
#include <limpid/signal/adaptive_window_velocity.hpp>
#include <limpid/signal/quantiser.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using limpid::AdaptiveWindowVelocity;
using limpid::in_seconds;
using limpid::Status;
using limpid::Time;
using limpid::WindowFit;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

template <typename Scalar = double>
using One = Eigen::Array<Scalar, 1, 1>;

constexpr double band = 0x1p-11;  // 4.9e-4 rad

double counted(double angle) { return band * std::round(angle / band); }

struct Reading {
  Time t;
  double u;
};

// Whether the line through the newest reading and the one `n` before it passes those between within `width`.
bool passes(const std::vector<Reading>& readings, std::size_t n, double width) {
  const Reading& newest = readings.back();
  const Reading& oldest = readings[readings.size() - 1 - n];
  const double slope = (newest.u - oldest.u) / in_seconds(newest.t - oldest.t);
  for (std::size_t i = 1; i < n; ++i) {
    const Reading& between = readings[readings.size() - 1 - i];
    if (std::abs(newest.u - slope * in_seconds(newest.t - between.t) - between.u) > width) return false;
  }
  return true;
}

// Least squares through the newest reading and the `n` before it, by the textbook's means.
double regression(const std::vector<Reading>& readings, std::size_t n) {
  double t_mean = 0, u_mean = 0, tu = 0, tt = 0;
  const auto age = [&](std::size_t i) { return in_seconds(readings[i].t - readings.back().t); };
  for (std::size_t i = readings.size() - 1 - n; i < readings.size(); ++i) {
    t_mean += age(i) / static_cast<double>(n + 1);
    u_mean += readings[i].u / static_cast<double>(n + 1);
  }
  for (std::size_t i = readings.size() - 1 - n; i < readings.size(); ++i) {
    tu += (age(i) - t_mean) * (readings[i].u - u_mean);
    tt += (age(i) - t_mean) * (age(i) - t_mean);
  }
  return tu / tt;
}

}  // namespace

TEST_CASE("the first call gives zero, whatever the position") {
  AdaptiveWindowVelocity<2> velocity({.band = {1, 1}});
  CHECK((velocity.update(5ms, {1e6, -3}).value == 0).all());
}

TEST_CASE_TEMPLATE("a ramp gives its slope from the second call on, by either fit", Scalar, float, double,
                   long double) {
  for (const WindowFit fit : {WindowFit::end, WindowFit::best}) {
    AdaptiveWindowVelocity<1, 8, Scalar> velocity({.band = One<Scalar>(Scalar(0.125)), .fit = fit});
    for (int k = 0; k < 40; ++k) {
      CAPTURE(k);
      const Scalar value = velocity.update(1h + k * 15'625us, One<Scalar>(Scalar(-3 * k) / 64)).value[0];
      REQUIRE(value == (k == 0 ? Scalar(0) : Scalar(-3)));  // 1/64 s: exact in binary
    }
  }
}

TEST_CASE("the window is the one that the definition gives, over irregular ticks") {
  constexpr std::size_t longest = 16;
  AdaptiveWindowVelocity<1, 16> end({.band = One<>(band), .fit = WindowFit::end});
  AdaptiveWindowVelocity<1, 16> best({.band = One<>(band), .fit = WindowFit::best});
  std::mt19937 random(20000811);
  std::uniform_int_distribution<int> step(200'000, 3'000'000);
  std::vector<Reading> readings;
  std::vector<int> lengths(longest + 1);
  Time now = 0ms;
  for (int k = 0; k < 5000; ++k) {
    now += Time(step(random));
    const double t = in_seconds(now);
    readings.push_back({now, counted(k < 2500 ? 0.3 * std::sin(4 * t) + 0.02 * std::sin(70 * t) : 0.02 * std::sin(t))});
    const double by_ends = end.update(now, One<>(readings.back().u)).value[0];
    const double by_all = best.update(now, One<>(readings.back().u)).value[0];
    if (readings.size() == 1) continue;
    std::size_t n = 1;
    while (n < longest && n + 1 < readings.size() && passes(readings, n + 1, band)) ++n;
    // a line that passes a reading by exactly the band may be told from one that does not by a rounding of u and slope
    constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
    const bool undecided = n < longest && n + 1 < readings.size() && passes(readings, n + 1, band + rounding);
    if (undecided || !passes(readings, n, band - rounding)) continue;
    CAPTURE(k);
    CAPTURE(n);
    ++lengths[n];
    const Reading& oldest = readings[readings.size() - 1 - n];
    const double slope = (readings.back().u - oldest.u) / in_seconds(now - oldest.t);
    REQUIRE(by_ends == slope);
    // sums of up to 17 terms; the denominator cancels to a quarter of its terms
    REQUIRE(std::abs(by_all - regression(readings, n)) <= 400 * std::numeric_limits<double>::epsilon() * 2);
  }
  CHECK(lengths[2] + lengths[3] > 100);  // short ones and the longest were all tried
  CHECK(lengths[longest] > 100);
}

TEST_CASE("of steady motion the whole window serves: the error is at most the band over its length") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> rate(-3, 3);
  for (int trial = 0; trial < 50; ++trial) {
    const double v = rate(random);
    CAPTURE(v);
    AdaptiveWindowVelocity<1, 32> velocity({.band = One<>(band), .fit = WindowFit::end});
    double worst = 0;
    for (int k = 0; k < 300; ++k) {
      const double value = velocity.update(k * 1ms, One<>(counted(v * k * 1e-3))).value[0];
      if (k > 32) worst = maximum(worst, std::abs(value - v));
    }
    CHECK(worst <= band / 0.032 * (1 + 1e-9));  // roundings of 1 in 1e13
  }
}

TEST_CASE("a joint that stops is seen to have stopped at once, and one that starts, one tick late at most") {
  AdaptiveWindowVelocity<1> velocity({.band = One<>(band)});
  const auto position = [](int k) { return One<>(k < 20 ? 0 : k < 50 ? 10 * band * (k - 20) : 290 * band); };
  for (int k = 0; k < 80; ++k) {
    CAPTURE(k);
    const double value = velocity.update(k * 15'625us, position(k)).value[0];
    if (k < 20) CHECK(value == 0);
    if (k == 21) CHECK(value == 10 * band * 64);
    if (k == 50) CHECK(value == 0);
  }
}

TEST_CASE("behind an encoder, best fit is quieter than end fit in slow motion, and both than a difference") {
  AdaptiveWindowVelocity<1> end({.band = One<>(band), .fit = WindowFit::end});
  AdaptiveWindowVelocity<1> best({.band = One<>(band), .fit = WindowFit::best});
  double by_ends = 0, by_all = 0, by_difference = 0, last = counted(0.01);
  for (int k = 0; k < 5000; ++k) {
    const double t = 1e-3 * k, u = counted(0.01 + 0.01 * std::sin(5 * t)), v = 0.05 * std::cos(5 * t);
    by_ends += std::pow(end.update(k * 1ms, One<>(u)).value[0] - v, 2);
    by_all += std::pow(best.update(k * 1ms, One<>(u)).value[0] - v, 2);
    by_difference += std::pow((u - last) / 1e-3 - v, 2);
    last = u;
  }
  CHECK(by_all < by_ends);
  CHECK(by_ends < by_difference);
}

TEST_CASE("an input that is not finite, and a jump too large for the scalar, change nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
  AdaptiveWindowVelocity<2, 4> velocity({.band = {0.5, 0.5}}), undisturbed({.band = {0.5, 0.5}});
  for (int k = 0; k < 40; ++k) {
    const Eigen::Array2d u(k, 0.3 * k);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, largest, -largest}) {
      if (k == 0) continue;
      const auto [value, status] = velocity.update(k * 1ms - 500us, {bad, 1});
      CHECK((value == undisturbed.update(0ms, u).value).all());  // refused: the clock stands
      CHECK(status == Status::not_finite);
    }
    CHECK((velocity.update(k * 1ms, u).value == undisturbed.update(k * 1ms, u).value).all());
  }
}

TEST_CASE("a clock that does not advance changes nothing") {
  AdaptiveWindowVelocity<1> velocity({.band = One<>(1)});
  (void)velocity.update(1ms, One<>(0));
  const double before = velocity.update(2ms, One<>(1)).value[0];
  for (const Time now : {Time(2ms), Time(1ms)}) {
    const auto [value, status] = velocity.update(now, One<>(7));
    CHECK(value[0] == before);
    CHECK(status == Status::clock_backwards);
  }
}

TEST_CASE("no call allocates") {
  AdaptiveWindowVelocity<3> velocity({.band = {1, 1, 1}});
  limpid::test::check_no_allocation([&] {
    for (int tick = 0; tick < 100; ++tick) (void)velocity.update(tick * tick * 1ms, Eigen::Array3d::Constant(tick));
  });
}

TEST_CASE("a band that cannot be one is refused, and so is none") {
  CHECK_THROWS_WITH_AS(AdaptiveWindowVelocity<2>({.band = {0.1, 0}}),
                       "AdaptiveWindowVelocity: band: expected finite and > 0, got 0.1 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(AdaptiveWindowVelocity<1>({}), "AdaptiveWindowVelocity: band: expected finite and > 0, got nan",
                       std::invalid_argument);
}
