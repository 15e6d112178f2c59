// SPDX-License-Identifier: MIT
#include <limpid/environment/tool.hpp>
#include <limpid/signal/history.hpp>

#include <benchmark/benchmark.h>

namespace {

using namespace std::chrono_literals;

void history_push_motion_3_axes(benchmark::State& state) {
  limpid::History<limpid::Motion<3>> history;
  limpid::Motion<3> motion;
  limpid::Time now{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(motion);
    benchmark::DoNotOptimize(history.push(now, motion));
    now += 1ms;
  }
}
BENCHMARK(history_push_motion_3_axes);

void history_at_motion_3_axes(benchmark::State& state) {
  limpid::History<limpid::Motion<3>> history;
  for (int tick = 0; tick < 1000; ++tick) (void)history.push(tick * 1ms, {});
  limpid::Time then = 900500us;  // between two ticks, 0.1 s ago
  for (auto _ : state) {
    benchmark::DoNotOptimize(then);
    benchmark::DoNotOptimize(history.at(then));
  }
}
BENCHMARK(history_at_motion_3_axes);

}  // namespace
