// SPDX-License-Identifier: MIT
#include <limpid/core/latest_value.hpp>
#include <limpid/core/recent_values.hpp>
#include <limpid/loop/realtime/environment_link.hpp>
#include <limpid/loop/realtime/periodic_loop.hpp>
#include <limpid/loop/realtime/slow_environment.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <stop_token>

/// What a tick of a real-time loop costs beside what it computes: by one thread, so without what two processors' caches
/// exchange.
namespace {

using namespace limpid;
using namespace std::chrono_literals;
using Exchange = EnvironmentExchange<3>;

void latest_value_write_take(benchmark::State& state) {
  LatestValue<Exchange::Taken> latest;
  Exchange::Taken taken;
  for (auto _ : state) {
    benchmark::DoNotOptimize(taken);
    latest.write(taken);
    benchmark::DoNotOptimize(latest.take());
    benchmark::DoNotOptimize(latest.value());
  }
}
BENCHMARK(latest_value_write_take);

// What a tick pays where nothing has come.
void latest_value_take_nothing(benchmark::State& state) {
  LatestValue<Exchange::Taken> latest;
  for (auto _ : state) benchmark::DoNotOptimize(latest.take());
}
BENCHMARK(latest_value_take_nothing);

void recent_values_write_force(benchmark::State& state) {
  RecentValues<Exchange::Force, 1024> forces;
  Exchange::Force force;
  for (auto _ : state) {
    benchmark::DoNotOptimize(force);
    forces.write(force);
  }
}
BENCHMARK(recent_values_write_force);

void recent_values_read_force(benchmark::State& state) {
  RecentValues<Exchange::Force, 1024> forces;
  for (int k = 0; k < 1024; ++k) forces.write({});
  Exchange::Force force;
  std::uint64_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(forces.read(next, force));
    benchmark::DoNotOptimize(force);
    next = (next + 1) % 1024;
  }
}
BENCHMARK(recent_values_read_force);

// The loop's side of a tick: its force sent, what has come read; a sample in each, or in none.
void link_send_read_3_axes(benchmark::State& state) {
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 1h});
  EnvironmentEnd end(exchange);
  const bool comes = state.range(0) != 0;
  Exchange::Vector force = Exchange::Vector::Ones();
  Time now{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(force);
    benchmark::DoNotOptimize(link.send(now, force));
    if (comes) end.publish(now, {});
    benchmark::DoNotOptimize(link.read(now));
    now += 1ms;
  }
}
BENCHMARK(link_send_read_3_axes)->ArgName("sample")->Arg(0)->Arg(1);

// Turned by whoever sleeps by it.
struct HandClock {
  Time time{};

  [[nodiscard]] Time now() const noexcept { return time; }
  [[nodiscard]] bool sleep_until(Time until) noexcept {
    time = until;
    return true;
  }
};

// The bookkeeping of PeriodicLoop without a clock, and with the machine's, but without a sleep.
struct SleeplessClock {
  [[nodiscard]] static Time now() noexcept { return steady_now(); }
  [[nodiscard]] static bool sleep_until(Time) noexcept { return true; }
};

template <typename Clock>
void periodic_loop_tick(benchmark::State& state) {
  PeriodicLoop loop({.period = 1s, .overrun = Overrun::catch_up}, Clock{});
  loop.run(std::stop_token{}, [&](const TickTime& at) noexcept {
    benchmark::DoNotOptimize(at);
    return state.KeepRunning();
  });
}
BENCHMARK(periodic_loop_tick<HandClock>);
BENCHMARK(periodic_loop_tick<SleeplessClock>);

}  // namespace
