// SPDX-License-Identifier: MIT
#include <limpid/loop/realtime/periodic_loop.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

// Turned by whoever sleeps by it, and by ticks that take time; wakes late by what is still in `late`, one a sleep.
struct Hand {
  Time time = 1000s;
  std::vector<Duration> late{};
  int wakes_early = 0;  // by signals
};
struct HandClock {
  Hand* hand;

  [[nodiscard]] Time now() const noexcept { return hand->time; }
  [[nodiscard]] bool sleep_until(Time time) const noexcept {
    if (hand->wakes_early > 0) return --hand->wakes_early < 0;
    hand->time = std::max(hand->time, time);
    if (hand->late.empty()) return true;
    hand->time += hand->late.front();
    hand->late.erase(hand->late.begin());
    return true;
  }
};
static_assert(SleepingClock<HandClock>);
static_assert(SleepingClock<SteadyClock>);

struct Run {
  std::vector<TickTime> ticks{};
  RealtimeReport report{};

  [[nodiscard]] Time begin(std::size_t k) const { return ticks.at(k).now - 1000s; }
};

// Each tick takes what `work` has for it, none beyond its end; the run is for 10 ms at 1 ms, unless settings say else.
Run run(PeriodicSettings settings, const std::vector<Duration>& work, Hand hand = {}) {
  if (settings.period == 0ns) settings.period = 1ms;
  if (settings.duration == Duration::max()) settings.duration = 10ms;
  PeriodicLoop loop(settings, HandClock{&hand});
  Run result;
  result.report = loop.run(std::stop_token{}, [&](const TickTime& at) noexcept {
    hand.time += at.index < work.size() ? work[at.index] : 0ns;
    result.ticks.push_back(at);
  });
  return result;
}

long locked_kilobytes() {
  std::ifstream status("/proc/self/status");
  long kilobytes = -1;
  for (std::string name; status >> name;) {
    if (name == "VmLck:") status >> kilobytes;
  }
  return kilobytes;
}

}  // namespace

TEST_CASE("ticks come at the instants of the grid, whatever they take within a period") {
  const Run seen = run({}, {300us, 1ms, 0us, 999us});
  REQUIRE(seen.ticks.size() == 10);
  for (std::size_t k = 0; k < 10; ++k) {
    CHECK(seen.begin(k) == k * 1ms);
    CHECK(seen.ticks[k].index == k);
    CHECK(seen.ticks[k].dt == 1ms);
    CHECK(seen.ticks[k].missed == 0);
  }
  CHECK(seen.report.ticks == 10);
  CHECK(seen.report.missed == 0);
  CHECK(seen.report.overruns == 0);
  CHECK(seen.report.lateness.max() == 0ns);
  CHECK(seen.report.work.max() == 1ms);
  CHECK(seen.report.end == LoopEnd::duration);
}

TEST_CASE("a grid may go with an instant of another clock, before the run or after its begin") {
  for (const Time origin : {Time(1000s), Time(0s), Time(3000s)}) {
    CAPTURE(origin.count());
    CHECK(run({.origin = origin}, {}).begin(0) == 0s);
    const Run seen = run({.origin = origin + 300us}, {});
    CHECK(seen.begin(0) == 300us);
    CHECK(seen.begin(9) == 9300us);
    CHECK(seen.ticks.size() == 10);
    CHECK(seen.report.missed == 0);
  }
}

TEST_CASE("dt is measured, and late wake-ups do not add up") {
  const Run seen = run({}, {}, {.late = {0us, 200us, 50us}});
  CHECK(seen.begin(1) == 1200us);
  CHECK(seen.begin(2) == 2050us);
  CHECK(seen.begin(3) == 3ms);
  CHECK(seen.ticks[1].dt == 1200us);
  CHECK(seen.ticks[2].dt == 850us);
  CHECK(seen.ticks[3].dt == 950us);
  CHECK(seen.report.lateness.max() == 200us);
  CHECK(seen.report.lateness.count() == 10);
}

TEST_CASE("the first tick's dt is the period, however late it comes") {
  CHECK(run({}, {}, {.late = {300us}}).ticks[0].dt == 1ms);
}

TEST_CASE("skip: what an overrun has passed is missed, and the next tick is on the grid") {
  const Run seen = run({.overrun = Overrun::skip}, {0us, 2300us});
  REQUIRE(seen.ticks.size() == 8);
  CHECK(seen.begin(1) == 1ms);
  CHECK(seen.begin(2) == 4ms);
  CHECK(seen.ticks[2].missed == 2);
  CHECK(seen.ticks[2].dt == 3ms);
  CHECK(seen.ticks[3].missed == 0);
  CHECK(seen.report.missed == 2);
  CHECK(seen.report.overruns == 1);
}

TEST_CASE("skip: the instant at which an overrun ends is not missed") {
  const Run seen = run({.overrun = Overrun::skip}, {2ms});
  CHECK(seen.begin(1) == 2ms);
  CHECK(seen.ticks[1].missed == 1);
}

TEST_CASE("skip: a tick that wakes periods late runs at once, in place of the newest that is due") {
  const Run seen = run({.overrun = Overrun::skip}, {}, {.late = {0us, 2300us}});
  CHECK(seen.begin(1) == 3300us);
  CHECK(seen.ticks[1].missed == 2);
  CHECK(seen.report.lateness.max() == 300us);
  CHECK(seen.begin(2) == 4ms);
  CHECK(seen.report.missed == 2);
  CHECK(seen.report.overruns == 0);
}

TEST_CASE("catch up: ticks that are due run at once until the grid is met again") {
  const Run seen = run({.overrun = Overrun::catch_up}, {0us, 2300us, 100us});
  REQUIRE(seen.ticks.size() == 10);
  CHECK(seen.begin(2) == 3300us);
  CHECK(seen.begin(3) == 3400us);
  CHECK(seen.begin(4) == 4ms);
  CHECK(seen.ticks[3].dt == 100us);
  CHECK(seen.report.missed == 0);
  CHECK(seen.report.lateness.max() == 1300us);
}

TEST_CASE("catch up: beyond the bound ticks are missed") {
  const Run seen = run({.overrun = Overrun::catch_up, .most_behind = 2}, {6500us});
  REQUIRE(seen.ticks.size() == 7);  // due at 1, 2 and 3 ms: too late, then at 4, 5, 6 ms: at once
  CHECK(seen.begin(1) == 6500us);
  CHECK(seen.ticks[1].missed == 3);
  CHECK(seen.begin(3) == 6500us);
  CHECK(seen.begin(4) == 7ms);
  CHECK(seen.report.missed == 3);
  CHECK(seen.report.lateness.max() == 2500us);
}

TEST_CASE("stop: an overrun is the last tick") {
  const Run seen = run({.overrun = Overrun::stop}, {1ms, 1001us});
  CHECK(seen.ticks.size() == 2);
  CHECK(seen.report.end == LoopEnd::overrun);
  CHECK(seen.report.overruns == 1);
}

TEST_CASE("stop: a tick that would come a period late does not come") {
  const Run seen = run({.overrun = Overrun::stop}, {}, {.late = {0us, 999us, 1ms}});
  CHECK(seen.ticks.size() == 2);
  CHECK(seen.report.end == LoopEnd::overrun);
}

TEST_CASE("a tick ends the loop by false, or by a status with fault; statuses are joined") {
  Hand hand;
  PeriodicLoop loop({.period = 1ms}, HandClock{&hand});
  const std::stop_token never;
  CHECK(loop.run(never, [](const TickTime& at) noexcept { return at.index < 4; }).ticks == 5);
  CHECK(loop.report().end == LoopEnd::by_tick);
  loop.run(never, [](const TickTime& at) noexcept {
    return at.index == 0 ? Status::limited : when(at.index == 2, Status::fault);
  });
  CHECK(loop.report().ticks == 3);
  CHECK(loop.report().status == (Status::limited | Status::fault));
  CHECK(describe(loop.report()).find("3 ticks, 0 missed, 0 overran; the tick ended it; status: limited, fault\n") == 0);
}

TEST_CASE("a stop that is requested ends the loop after the tick; before the run there is none") {
  Hand hand;
  PeriodicLoop loop({.period = 1ms}, HandClock{&hand});
  std::stop_source stop;
  CHECK(loop.run(stop.get_token(),
                 [&](const TickTime& at) noexcept {
                   if (at.index == 6) stop.request_stop();
                 })
            .ticks == 7);
  CHECK(loop.report().end == LoopEnd::stop_requested);
  CHECK(loop.run(stop.get_token(), [](const TickTime&) noexcept {}).ticks == 0);
}

TEST_CASE("a signal that wakes the thread does not make it tick early") {
  CHECK(run({}, {}, {.wakes_early = 3}).ticks.size() == 10);
}

TEST_CASE("between the first tick and the last nothing is allocated") {
  Hand hand;
  PeriodicLoop loop({.period = 1ms}, HandClock{&hand});
  std::size_t at_first = 0, at_last = 0;
  loop.run(std::stop_token{}, [&](const TickTime& at) noexcept {
    (at.index == 0 ? at_first : at_last) = limpid::test::allocations.load();
    return at.index < 100;
  });
  CHECK(at_last - at_first == 0);
}

TEST_CASE("settings that cannot serve are refused") {
  using Loop = PeriodicLoop<>;
  const auto with = [](RealtimeThread::Settings thread) { Loop({.period = 1ms, .thread = thread}); };
  CHECK_THROWS_WITH_AS(Loop({}), "PeriodicLoop: period: expected > 0 s, got 0 s", std::invalid_argument);
  CHECK_THROWS_AS(Loop({.period = 1ms, .most_behind = -1}), std::invalid_argument);
  CHECK_THROWS_AS(Loop({.period = 1ms, .duration = 0ms}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(with({.priority = 100}), "RealtimeThread: priority: expected 0, or 1 to 99, got 100",
                       std::invalid_argument);
  CHECK_THROWS_AS(with({.cpu = -1}), std::invalid_argument);
  CHECK_THROWS_AS(with({.cpu = CPU_SETSIZE}), std::invalid_argument);
}

TEST_CASE("memory that a run has locked is unlocked by the last of those that run") {
  const long before = locked_kilobytes();
  {
    const RealtimeThread one({.lock_memory = true});
    const long within = locked_kilobytes();
    { const RealtimeThread other({.lock_memory = true}); }
    CHECK(locked_kilobytes() == within);
  }
  CHECK(locked_kilobytes() == before);
}

TEST_CASE("what a run asked for is granted or refused in a sentence, and put back in either case") {
  sched_param before{}, after{};
  int policy_before = 0, policy_after = 0;
  cpu_set_t cpus_before, cpus_after;
  pthread_getschedparam(pthread_self(), &policy_before, &before);
  pthread_getaffinity_np(pthread_self(), sizeof cpus_before, &cpus_before);
  const int slack_before = prctl(PR_GET_TIMERSLACK);

  Hand hand;
  PeriodicLoop loop({.period = 1ms, .thread = {.priority = 1, .cpu = 0, .lock_memory = true}}, HandClock{&hand});
  int policy_within = -1;
  const RealtimeGrants granted = loop.run(std::stop_token{},
                                          [&](const TickTime&) noexcept {
                                            sched_param within{};
                                            pthread_getschedparam(pthread_self(), &policy_within, &within);
                                            return false;
                                          })
                                     .granted;
  CHECK((policy_within == SCHED_FIFO) == granted.fifo);
  const auto refused = [](bool yes) { return yes ? 0U : 1U; };
  CHECK(granted.refused.size() == refused(granted.fifo) + refused(granted.pinned) + refused(granted.memory_locked));

  pthread_getschedparam(pthread_self(), &policy_after, &after);
  pthread_getaffinity_np(pthread_self(), sizeof cpus_after, &cpus_after);
  CHECK(policy_after == policy_before);
  CHECK(after.sched_priority == before.sched_priority);
  CHECK(CPU_EQUAL(&cpus_after, &cpus_before));
  CHECK(prctl(PR_GET_TIMERSLACK) == slack_before);
}

TEST_CASE("a processor that the machine does not have is refused, with what would permit it") {
  const RealtimeThread thread({.cpu = CPU_SETSIZE - 1});
  CHECK(!thread.grants().pinned);
  REQUIRE(thread.grants().refused.size() == 1);
  CHECK(thread.grants().refused[0].find("processor 1023: ") == 0);
}

TEST_CASE("on the true clock, on a thread of its own, no tick comes early and a stop ends it") {
  PeriodicLoop loop({.period = 1ms});
  std::atomic<int> count = 0;
  bool early = false;
  const Time before = steady_now();
  std::jthread thread = loop.start([&](const TickTime& at) noexcept {
    early = early || at.now < before + at.index * 1ms || at.dt <= 0ns;
    ++count;
  });
  while (count < 20) std::this_thread::yield();
  thread.request_stop();
  thread.join();
  CHECK(!early);
  CHECK(loop.report().end == LoopEnd::stop_requested);
  CHECK(loop.report().ticks == static_cast<std::uint64_t>(count));
  CHECK(loop.report().lateness.count() == loop.report().ticks);
}
