// SPDX-License-Identifier: MIT
#include <limpid/environment/tool.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <benchmark/benchmark.h>

namespace {

using namespace std::chrono_literals;

// Ticks of 1 ms; a period of 16 ms and of 1 ms, so that one tick in sixteen or each one takes and delivers a sample.
void delayed_sampled_tool_state_3_axes(benchmark::State& state) {
  limpid::DelayedSampled<limpid::ToolState<3>> sampled({.period = state.range(0) * 1ms, .delay = 16ms});
  limpid::ToolState<3> tool;
  limpid::Time now{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(tool);
    benchmark::DoNotOptimize(sampled.update(now, tool));
    now += 1ms;
  }
}
BENCHMARK(delayed_sampled_tool_state_3_axes)->ArgName("period_ms")->Arg(16)->Arg(1);

}  // namespace
