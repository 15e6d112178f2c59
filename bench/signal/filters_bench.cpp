// SPDX-License-Identifier: MIT
#include <limpid/signal/adaptive_window_velocity.hpp>
#include <limpid/signal/filtered_derivative.hpp>
#include <limpid/signal/low_pass.hpp>
#include <limpid/signal/quantiser.hpp>

#include <benchmark/benchmark.h>

namespace {

using namespace std::chrono_literals;

template <typename Filter>
void run(benchmark::State& state, Filter filter) {
  Eigen::Array3d u{0.5, -0.25, 0.125};
  limpid::Time now{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(u);
    benchmark::DoNotOptimize(filter.update(now, u));
    now += 1ms;
  }
}

void filtered_derivative_3_axes(benchmark::State& state) { run(state, limpid::FilteredDerivative<3>()); }
BENCHMARK(filtered_derivative_3_axes);

void low_pass_3_axes(benchmark::State& state) { run(state, limpid::LowPass<3>({.cutoff = 4})); }
BENCHMARK(low_pass_3_axes);

// At rest, so that each window is as long as it may be.
void adaptive_window_velocity_3_axes(benchmark::State& state) {
  run(state, limpid::AdaptiveWindowVelocity<3>({.band = {4e-4, 4e-4, 4e-4}}));
}
BENCHMARK(adaptive_window_velocity_3_axes);

void quantiser_3_axes(benchmark::State& state) {
  limpid::Quantiser<3> quantiser({.step = {4e-4, 4e-4, 4e-4}});
  Eigen::Array3d u{0.5, -0.25, 0.125};
  for (auto _ : state) {
    benchmark::DoNotOptimize(u);
    benchmark::DoNotOptimize(quantiser.update(u));
  }
}
BENCHMARK(quantiser_3_axes);

}  // namespace
