// SPDX-License-Identifier: MIT
#include <limpid/device/recording.hpp>
#include <limpid/device/simulated_omni.hpp>

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <sstream>

namespace {

using namespace limpid;
using namespace std::chrono_literals;

// One tick of 1 ms of the arm swinging under gravity and a sinusoidal force.
void simulated_omni(benchmark::State& state) {
  SimulatedOmni<> arm({.realism = state.range(0) == 0 ? Realism::ideal : Realism::realistic});
  Time now{0};
  for (auto _ : state) {
    now += 1ms;
    const double t = in_seconds(now);
    benchmark::DoNotOptimize(arm.advance(now, {std::sin(5 * t), std::sin(7 * t), 1.4 + std::sin(3 * t)}));
    benchmark::DoNotOptimize(arm.read(now));
  }
}
BENCHMARK(simulated_omni)->ArgName("realistic")->Arg(0)->Arg(1);

void recording_at(benchmark::State& state) {
  std::stringstream text;
  for (int i = 0; i < 1000; ++i) text << 0.02 * i << ',' << std::sin(0.1 * i) << '\n';
  const Recording recording = Recording::parse(text, "bench");
  Time now{0};
  for (auto _ : state) {
    now = now > 19s ? Time{0} : now + 1ms;
    benchmark::DoNotOptimize(now);
    benchmark::DoNotOptimize(recording.at(now));
  }
}
BENCHMARK(recording_at);

}  // namespace
