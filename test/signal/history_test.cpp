// SPDX-License-Identifier: MIT
#include <limpid/environment/tool.hpp>
#include <limpid/signal/history.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <map>
#include <random>

using limpid::Duration;
using limpid::History;
using limpid::Motion;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

TEST_CASE_TEMPLATE("an entry comes back as it was, and between two entries lies the straight line", Scalar, float,
                   double, long double) {
  History<Scalar> history;
  (void)history.push(10ms, Scalar(2));
  (void)history.push(14ms, Scalar(4));
  CHECK(history.at(10ms).value == 2);
  CHECK(history.at(11ms).value == Scalar(2.5));  // exact in binary
  CHECK(history.at(13ms).value == Scalar(3.5));
  CHECK(history.at(14ms).value == 4);
  CHECK(history.at(13ms).status == Status::ok);
}

TEST_CASE("before the oldest and after the newest entry the nearest one is returned, and said so") {
  History<double> history;
  (void)history.push(10ms, 2.0);
  (void)history.push(14ms, 4.0);
  CHECK(history.at(9ms).value == 2);
  CHECK(history.at(9ms).status == Status::out_of_history);
  CHECK(history.at(15ms).value == 4);
  CHECK(history.at(15ms).status == Status::out_of_history);
}

TEST_CASE("an empty history answers zero and no_sample") {
  const History<Eigen::Array3d> history;
  CHECK((history.at(0ms).value == 0).all());
  CHECK(history.at(0ms).status == Status::no_sample);
  CHECK(history.size() == 0);
  CHECK((history.newest().value == 0).all());
}

TEST_CASE("a full history loses its oldest entry") {
  History<double, 4> history;
  for (int i = 0; i < 7; ++i) CHECK(history.push(i * 1ms, i) == Status::ok);
  CHECK(history.size() == 4);
  CHECK(history.newest().value == 6);
  CHECK(history.newest().taken == 6ms);
  CHECK(history.at(3ms).status == Status::ok);
  CHECK(history.at(2ms).status == Status::out_of_history);
  CHECK(history.at(2ms).value == 3);
}

TEST_CASE("any instant of an irregular signal is found as in a sorted map of the same entries") {
  std::mt19937 random(17070415);
  const auto uniform = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  History<double, 32> history;
  std::map<Time, double> map;
  Time now{};
  for (int step = 0; step < 2000; ++step) {
    CAPTURE(step);
    now += Duration(uniform(1, 50));
    const double value = uniform(-1000, 1000);
    REQUIRE(history.push(now, value) == Status::ok);
    map[now] = value;
    if (map.size() > 32) map.erase(map.begin());
    const Time t = now - Duration(uniform(-20, 900));
    CAPTURE(t.count());
    const auto [found, status] = history.at(t);
    const auto after = map.lower_bound(t);
    const bool outside = after == map.end() || (after == map.begin() && after->first != t);
    REQUIRE(status == (outside ? Status::out_of_history : Status::ok));
    if (outside) {
      REQUIRE(found == (after == map.end() ? now == Time{} ? 0 : map.rbegin()->second : after->second));
    } else if (after->first == t) {
      REQUIRE(found == after->second);
    } else {
      const auto before = std::prev(after);
      const double part = static_cast<double>((t - before->first).count()) /
                          static_cast<double>((after->first - before->first).count());
      const double line = (1 - part) * before->second + part * after->second;
      // values up to 1000, a handful of roundings on either side
      REQUIRE(std::abs(found - line) <= 8 * 1000 * std::numeric_limits<double>::epsilon());
    }
  }
}

TEST_CASE("a float knows an instant after a year as well as at the start") {
  History<float> history;
  const Time year = 24h * 365;
  (void)history.push(year, 2.0F);
  (void)history.push(year + 1ms, 4.0F);
  CHECK(history.at(year + 250us).value == 2.5F);
}

TEST_CASE("between the ends of the clock's range lies the straight line too") {
  History<double> history;
  (void)history.push(Time::min(), 0.0);
  (void)history.push(Time::max(), 1.0);
  CHECK(history.at(Time{0}).value == 0.5);  // to half of 2^-64
  CHECK(history.at(Time::min() / 2).value == 0.25);
  CHECK(history.at(Time::max() - 1ns).value == 1);
  CHECK(history.at(Time::min() + 1ns).value < 1e-18);
}

TEST_CASE("motions are interpolated in all their parts") {
  History<Motion<2>> history;
  (void)history.push(0ms, {.x = {0, 1}, .v = {2, 3}, .a = {4, 5}});
  (void)history.push(4ms, {.x = {4, 1}, .v = {2, 7}, .a = {0, 5}});
  const auto [motion, status] = history.at(1ms);
  CHECK((motion.x == Eigen::Array2d{1, 1}).all());
  CHECK((motion.v == Eigen::Array2d{2, 4}).all());
  CHECK((motion.a == Eigen::Array2d{3, 5}).all());
  CHECK(status == Status::ok);
}

TEST_CASE("an entry that is not newer or not finite is not added") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  History<double> history;
  (void)history.push(10ms, 2.0);
  CHECK(history.push(10ms, 3.0) == Status::clock_backwards);
  CHECK(history.push(9ms, 3.0) == Status::clock_backwards);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    CHECK(history.push(11ms, bad) == Status::not_finite);
  }
  CHECK(history.size() == 1);
  CHECK(history.newest().value == 2);
}

TEST_CASE("any part of a motion that is not finite keeps it out") {
  History<Motion<3>> history;
  for (Eigen::Array3d Motion<3>::*part : {&Motion<3>::x, &Motion<3>::v, &Motion<3>::a}) {
    Motion<3> motion;
    (motion.*part)[1] = std::numeric_limits<double>::infinity();
    CHECK(history.push(1ms, motion) == Status::not_finite);
  }
  CHECK(history.size() == 0);
}

TEST_CASE("no call allocates") {
  History<Motion<3>, 64> history;
  limpid::test::check_no_allocation([&] {
    for (int tick = 0; tick < 200; ++tick) {
      (void)history.push(tick * 1ms, {});
      (void)history.at(tick * 1ms - 10500us);
    }
  });
}

TEST_CASE("entries are in order, the oldest first, and can be forgotten") {
  History<double, 4> history;
  for (int k = 0; k < 6; ++k) (void)history.push(10ms * k, 1.0 * k);
  REQUIRE(history.size() == 4);
  CHECK(history.time(0) == 20ms);
  CHECK(history.value(3) == 5);
  CHECK(history.first_not_before(0ms) == 0);
  CHECK(history.first_not_before(30ms) == 1);
  CHECK(history.first_not_before(31ms) == 2);
  CHECK(history.first_not_before(51ms) == 4);
  history.clear();
  CHECK(history.size() == 0);
  CHECK(history.at(50ms).status == Status::no_sample);
}
