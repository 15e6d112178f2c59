// SPDX-License-Identifier: MIT
#include <limpid/environment/tool.hpp>
#include <limpid/signal/delayed_sampled.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <vector>

using limpid::DelayedSampled;
using limpid::Duration;
using limpid::Held;
using limpid::Sample;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// What `now` must see of a signal whose value is its own tick's number, from all ticks so far and the definition alone:
// sample k is taken at the first tick at or after k period and seen by the first tick at or after that plus the delay.
std::optional<int> newest_seen(const std::vector<Time>& ticks, Duration period, Duration delay) {
  std::optional<int> newest;
  for (Time due = ticks.front() / period * period; due <= ticks.back(); due += period) {
    int taken = 0;
    while (ticks[static_cast<std::size_t>(taken)] < due) ++taken;
    if (ticks[static_cast<std::size_t>(taken)] + delay <= ticks.back()) newest = taken;
  }
  return newest;
}

}  // namespace

TEST_CASE("a sample is held from its delay after a multiple of the period until the next one arrives") {
  DelayedSampled<double> signal({.period = 16ms, .delay = 16ms});
  for (int tick = 0; tick < 100; ++tick) {
    CAPTURE(tick);
    const Held<double> held = signal.update(Time(tick * 1ms), tick);
    if (tick < 16) {
      REQUIRE(held.status == Status::no_sample);
      REQUIRE_FALSE(held.fresh);
      continue;
    }
    REQUIRE(held.value == tick / 16 * 16 - 16);
    REQUIRE(held.taken == (tick / 16 * 16 - 16) * 1ms);
    REQUIRE(held.arrived == tick / 16 * 16 * 1ms);
    REQUIRE(held.fresh == (tick % 16 == 0));
    REQUIRE(held.status == Status::ok);
  }
}

TEST_CASE("without a delay a sample is seen by the tick that takes it") {
  DelayedSampled<double> signal({.period = 10ms, .delay = 0ms});
  const Held<double> held = signal.update(3ms, 7.0);  // the first tick takes what is due
  CHECK(held.value == 7);
  CHECK(held.taken == 3ms);
  CHECK(held.fresh);
  CHECK(signal.update(9ms, 8.0).value == 7);
  CHECK(signal.update(10ms, 9.0).value == 9);
}

TEST_CASE("period and delay need be multiples of nothing, ticks may be irregular, the delay may exceed the period") {
  std::mt19937 random(19270521);
  const auto uniform = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int run = 0; run < 60; ++run) {
    const Duration period{uniform(1, 400)}, delay{uniform(0, 900)};
    if (delay / period >= 64) continue;
    CAPTURE(run);
    CAPTURE(period.count());
    CAPTURE(delay.count());
    DelayedSampled<double> signal({.period = period, .delay = delay}, -1);
    std::vector<Time> ticks;
    std::optional<int> before;
    for (int tick = 0; tick < 80; ++tick) {
      CAPTURE(tick);
      ticks.push_back(ticks.empty() ? Time(uniform(0, 1000)) : ticks.back() + Duration(uniform(1, 120)));
      const Held<double> held = signal.update(ticks.back(), tick);
      const std::optional<int> seen = newest_seen(ticks, period, delay);
      REQUIRE(held.value == seen.value_or(-1));
      REQUIRE(held.fresh == (seen != before));
      REQUIRE(held.status == (seen ? Status::ok : Status::no_sample));
      if (seen) REQUIRE(held.taken == ticks[static_cast<std::size_t>(*seen)]);
      before = seen;
    }
  }
}

TEST_CASE("the most samples on their way that a setting allows are all kept") {
  DelayedSampled<double, 8> signal({.period = 10ns, .delay = 79ns});  // 7.9 periods: up to 9 in (now - delay, now]
  for (int tick = 0; tick < 500; ++tick) {
    CAPTURE(tick);
    const Held<double> held = signal.update(Time(tick), tick);
    REQUIRE_FALSE(has(held.status, Status::overflow));
    if (tick >= 79) REQUIRE(held.value == (tick - 79) / 10 * 10);
  }
}

TEST_CASE("a sample has room where one that arrives in the same tick leaves") {
  DelayedSampled<double, 1> signal({.period = 10ms, .delay = 9ms});
  CHECK(signal.update(9ms, 9.0).status == Status::no_sample);    // arrives at 18 ms
  CHECK(signal.update(10ms, 10.0).status == Status::no_sample);  // at 19 ms
  const Held<double> held = signal.update(20ms, 20.0);
  CHECK(held.status == Status::ok);
  CHECK(held.value == 10);
  CHECK(signal.update(29ms, 29.0).value == 20);
}

TEST_CASE("samples with their own clock are seen when they arrive, whatever their spacing") {
  DelayedSampled<double> signal({.period = 1ms, .delay = 0ms});
  CHECK(signal.offer({.value = 1, .taken = 2ms, .arrived = 5ms}) == Status::ok);
  CHECK(signal.offer({.value = 2, .taken = 3ms, .arrived = 31ms}) == Status::ok);
  CHECK(signal.update(4ms).status == Status::no_sample);
  const Held<double> first = signal.update(6ms);
  CHECK(first.value == 1);
  CHECK(first.taken == 2ms);
  CHECK(first.arrived == 5ms);
  CHECK(first.fresh);
  CHECK_FALSE(signal.update(30ms).fresh);
  CHECK(signal.update(31ms).value == 2);
}

TEST_CASE("of several that arrive in one tick the one taken last is held") {
  DelayedSampled<double> signal({.period = 1ms, .delay = 0ms});
  (void)signal.offer({.value = 3, .taken = 3ms, .arrived = 9ms});
  (void)signal.offer({.value = 1, .taken = 1ms, .arrived = 7ms});
  (void)signal.offer({.value = 2, .taken = 2ms, .arrived = 9ms});
  const Held<double> held = signal.update(10ms);
  CHECK(held.value == 3);
  CHECK(held.fresh);
  CHECK(held.status == Status::ok);  // superseded is not out of order
}

TEST_CASE("a sample overtaken on its way is dropped on arrival, and said so") {
  DelayedSampled<double> signal({.period = 10ms, .delay = 0ms});
  (void)signal.offer({.value = 1, .taken = 1ms, .arrived = 20ms});
  (void)signal.offer({.value = 2, .taken = 2ms, .arrived = 10ms});
  CHECK(signal.update(10ms).value == 2);
  const Held<double> late = signal.update(20ms);
  CHECK(late.value == 2);
  CHECK_FALSE(late.fresh);
  CHECK(late.status == Status::out_of_order);
  CHECK(signal.update(21ms).status == Status::ok);
}

TEST_CASE("repeated, old and impossible samples are refused and change nothing") {
  DelayedSampled<double> signal({.period = 1ms, .delay = 0ms});
  (void)signal.offer({.value = 1, .taken = 5ms, .arrived = 6ms});
  CHECK(signal.offer({.value = 9, .taken = 5ms, .arrived = 6ms}) == Status::out_of_order);  // on its way already
  (void)signal.update(6ms);
  CHECK(signal.offer({.value = 9, .taken = 5ms, .arrived = 7ms}) == Status::out_of_order);  // held already
  CHECK(signal.offer({.value = 9, .taken = 4ms, .arrived = 7ms}) == Status::out_of_order);
  CHECK(signal.offer({.value = 9, .taken = 8ms, .arrived = 7ms}) == Status::clock_backwards);
  for (const double bad :
       {not_a_number, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    CHECK(signal.offer({.value = bad, .taken = 8ms, .arrived = 8ms}) == Status::not_finite);
  }
  CHECK(signal.update(10ms).value == 1);
  CHECK(signal.update(11ms).status == Status::ok);
}

TEST_CASE("when too many samples are on their way the earliest arrival is dropped") {
  DelayedSampled<double, 2> signal({.period = 1ms, .delay = 0ms});
  for (int i = 1; i <= 3; ++i)
    CHECK(signal.offer({.value = double(i), .taken = i * 1ms, .arrived = i * 10ms}) == Status::ok);
  CHECK(signal.offer({.value = 4, .taken = 4ms, .arrived = 40ms}) == Status::overflow);
  CHECK(signal.update(10ms).status == Status::no_sample);
  CHECK(signal.update(20ms).value == 2);
  CHECK(signal.update(40ms).value == 4);
}

TEST_CASE("samples stamped in the far future do not keep out those that come sooner") {
  DelayedSampled<double, 4> signal({.period = 1ms, .delay = 3ms});
  (void)signal.update(0ms);
  const auto of_the_future = [&](int i) {
    const Time far = Time::max() - Duration(i);
    return signal.offer({.value = 99, .taken = far, .arrived = far});
  };
  for (int i = 0; i < 10; ++i) CHECK(of_the_future(i) == (i < 5 ? Status::ok : Status::overflow));
  for (int i = 1; i < 100; ++i) {
    CAPTURE(i);
    (void)signal.offer({.value = double(i), .taken = i * 1ms, .arrived = i * 1ms + 3ms});
    const auto& held = signal.update(i * 1ms);
    if (i > 3) {
      REQUIRE(held.fresh);
      REQUIRE(held.value == i - 3);
    }
    if (i > 50) (void)of_the_future(i);
  }
}

TEST_CASE("a value that is not finite makes a lost sample, and only where one is due") {
  DelayedSampled<double> signal({.period = 10ms, .delay = 0ms}, 0.5);
  CHECK(signal.update(0ms, not_a_number).status == (Status::not_finite | Status::no_sample));
  CHECK(signal.update(1ms, 1.0).value == 0.5);  // the next sample is due at 10 ms
  CHECK(signal.update(10ms, 2.0).value == 2);
  CHECK(signal.update(15ms, not_a_number).status == Status::ok);
  const Held<double> lost = signal.update(20ms, std::numeric_limits<double>::infinity());
  CHECK(lost.value == 2);
  CHECK_FALSE(lost.fresh);
  CHECK(lost.status == Status::not_finite);
  CHECK(signal.update(30ms, 3.0).value == 3);
}

TEST_CASE("any part of a tool's state that is not finite makes a lost sample") {
  using State = limpid::ToolState<3>;
  for (Eigen::Array3d State::*part : {&State::x, &State::v, &State::a, &State::force}) {
    DelayedSampled<State> signal({.period = 10ms, .delay = 0ms});
    State state;
    (state.*part)[2] = not_a_number;
    CHECK(has(signal.update(0ms, state).status, Status::not_finite));
    CHECK(signal.offer({.value = state, .taken = 1ms, .arrived = 1ms}) == Status::not_finite);
  }
}

TEST_CASE("a clock that does not advance changes nothing") {
  DelayedSampled<double> signal({.period = 10ms, .delay = 0ms});
  (void)signal.update(10ms, 1.0);
  for (const Time now : {Time(10ms), Time(0ms), Time(-5ms)}) {
    const Held<double> held = signal.update(now, 2.0);
    CHECK(held.value == 1);
    CHECK_FALSE(held.fresh);
    CHECK(held.status == Status::clock_backwards);
    CHECK(signal.update(now).status == Status::clock_backwards);
  }
  CHECK(signal.update(20ms, 3.0).fresh);
}

TEST_CASE("samples keep their places after a year on a nanosecond clock") {
  DelayedSampled<double> signal({.period = 333'333ns, .delay = 1ms});
  const Time year = 24h * 365;
  (void)signal.update(year, 1.0);
  const Time due = (year / 333'333ns + 1) * 333'333ns;
  (void)signal.update(due - 1ns, 2.0);
  (void)signal.update(due, 3.0);
  CHECK(signal.update(due + 1ms - 1ns, 0.0).value == 1);
  CHECK(signal.update(due + 1ms, 0.0).value == 3);
}

TEST_CASE("the multiples of the period go on before the start of the clock") {
  DelayedSampled<double> signal({.period = 10ms, .delay = 0ms});
  CHECK(signal.update(-25ms, 1.0).value == 1);
  CHECK(signal.update(-21ms, 2.0).value == 1);
  CHECK(signal.update(-20ms, 3.0).value == 3);
  CHECK(signal.update(-1ms, 4.0).value == 4);
  CHECK(signal.update(0ms, 5.0).value == 5);
}

TEST_CASE("at the ends of the clock's range samples keep their places") {
  DelayedSampled<double> first({.period = 10ms, .delay = 20ms});
  CHECK(first.update(Time::min(), 1.0).status == Status::no_sample);
  CHECK(first.update(Time::min() + 20ms - 1ns, 2.0).status == Status::no_sample);
  CHECK(first.update(Time::min() + 20ms, 3.0).value == 1);
  CHECK(first.update(Time::min() + 20ms, 3.0).status == Status::clock_backwards);

  DelayedSampled<double> last({.period = 10ms, .delay = 20ms});
  (void)last.update(Time::max() - 50ms, 1.0);
  CHECK(last.update(Time::max() - 30ms, 2.0).value == 1);
  CHECK(last.update(Time::max() - 1ns, 3.0).value == 2);  // what is taken here arrives at the end at the earliest
  CHECK(last.update(Time::max(), 4.0).fresh);

  DelayedSampled<double> all({.period = 10ms, .delay = 0ms});
  CHECK(all.update(Time::min(), 1.0).value == 1);
  CHECK(all.update(Time::max(), 2.0).value == 2);

  DelayedSampled<double> offered({.period = 10ms, .delay = 0ms});
  (void)offered.update(Time::min());
  CHECK(offered.offer({.value = 1, .taken = Time::min() + 1ns, .arrived = Time::min() + 1ns}) == Status::ok);
  CHECK(offered.update(Time::min() + 1ms).status == Status::ok);
  CHECK(has(offered.update(Time::max()).status, Status::stale));
}

TEST_CASE("a period as long as the clock's range takes one sample") {
  DelayedSampled<double> signal({.period = Duration::max(), .delay = 0ms});
  CHECK(signal.update(1ms, 1.0).value == 1);
  CHECK(signal.update(2ms, 2.0).value == 1);
  CHECK(signal.update(Time::max() - 1ns, 3.0).value == 1);
}

TEST_CASE("when samples stop coming, what is held is stale from the longest age on") {
  DelayedSampled<double> signal({.period = 10ms, .delay = 20ms});  // the delay and ten periods: 120 ms
  for (int tick = 0; tick <= 120; ++tick) REQUIRE(signal.update(tick * 1ms).status == Status::no_sample);
  CHECK(signal.update(121ms).status == (Status::no_sample | Status::stale));  // since the first tick
  CHECK(signal.offer({.value = 1, .taken = 110ms, .arrived = 130ms}) == Status::ok);
  CHECK(signal.update(130ms).status == Status::ok);
  CHECK(signal.update(230ms).status == Status::ok);
  const Held<double> old = signal.update(230ms + 1ns);
  CHECK(old.status == Status::stale);
  CHECK(old.value == 1);
  CHECK(signal.offer({.value = 2, .taken = 115ms, .arrived = 240ms}) == Status::ok);
  const Held<double> late = signal.update(240ms);  // newer, and yet too old
  CHECK(late.value == 2);
  CHECK(late.status == Status::stale);
  CHECK(signal.offer({.value = 3, .taken = 235ms, .arrived = 250ms}) == Status::ok);
  CHECK(signal.update(250ms).status == Status::ok);
}

TEST_CASE("lost samples of the sampler's own make what is held stale, until one is not lost") {
  DelayedSampled<double> signal({.period = 10ms, .delay = 5ms, .longest_age = 40ms});
  for (int tick = 0; tick < 200; ++tick) {
    CAPTURE(tick);
    const bool lost = tick >= 55 && tick < 125;
    const Held<double> held = signal.update(tick * 1ms, lost ? not_a_number : tick);
    // the last good sample is of 50 ms, the next one of 130 ms arrives at 135 ms
    REQUIRE(has(held.status, Status::stale) == (tick > 50 + 40 && tick < 135));
  }
}

TEST_CASE("regular sampling is never stale, whatever the period, the delay and the ticks") {
  std::mt19937 random(19010101);
  const auto uniform = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int run = 0; run < 200; ++run) {
    const Duration period{uniform(1, 400)}, delay{std::min<Duration::rep>(uniform(0, 5000), 63 * period.count())};
    CAPTURE(period.count());
    CAPTURE(delay.count());
    DelayedSampled<double> signal({.period = period, .delay = delay});
    Time now{};
    for (int tick = 0; tick < 300; ++tick) {
      now += Duration(uniform(1, run % 2 == 0 ? 40 : 4000));  // up to thousands of periods
      REQUIRE_FALSE(has(signal.update(now, tick).status, Status::stale));
    }
  }
}

TEST_CASE("no call allocates") {
  DelayedSampled<limpid::ToolState<3>> signal({.period = 2ms, .delay = 5ms});
  limpid::test::check_no_allocation([&] {
    for (int tick = 0; tick < 50; ++tick) {
      (void)signal.offer({.value = {}, .taken = tick * 1ms, .arrived = (tick + 3) * 1ms});
      (void)signal.update(tick * 1ms, {});
    }
  });
}

TEST_CASE("settings that cannot serve are refused") {
  using Signal = DelayedSampled<double, 4>;
  CHECK_THROWS_WITH_AS(Signal({.period = 0ms, .delay = 1ms}), "DelayedSampled: period: expected > 0, got 0 s",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Signal({.period = 1s, .delay = -1s}), "DelayedSampled: delay: expected >= 0, got -1 s",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Signal({.period = 1s, .delay = 4s}), "DelayedSampled: delay: expected below 4 periods, got 4 s",
                       std::invalid_argument);
  CHECK_NOTHROW(Signal({.period = 1s, .delay = 3999ms}));
  CHECK_THROWS_WITH_AS(Signal({.period = 1s, .delay = 2s, .longest_age = 2999ms}),
                       "DelayedSampled: longest_age: expected at least the delay and a period, got 2.999 s",
                       std::invalid_argument);
  CHECK_NOTHROW(Signal({.period = 1s, .delay = 2s, .longest_age = 3s}));
  CHECK_NOTHROW(Signal({.period = Duration::max(), .delay = 0s}));  // ten of them would overflow
  CHECK_NOTHROW(Signal({.period = 1s, .delay = 2s, .longest_age = Duration::max()}));
  CHECK_THROWS_WITH_AS(Signal({.period = 1s, .delay = 1s}, not_a_number),
                       "DelayedSampled: initial: expected finite, got a value that is not", std::invalid_argument);
}
