// SPDX-License-Identifier: MIT
#include <limpid/evaluation/error_norms.hpp>
#include <limpid/evaluation/latency_histogram.hpp>

#include <benchmark/benchmark.h>

#include <Eigen/Core>

namespace {

void error_norms_3_axes(benchmark::State& state) {
  limpid::ErrorNorms<3> norms;
  Eigen::Array3d e_x{1e-3, -2e-3, 5e-4}, e_v{1e-2, 0, -3e-2};
  limpid::Time now{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(e_x);
    benchmark::DoNotOptimize(e_v);
    benchmark::DoNotOptimize(norms.add(now += limpid::Time{1'000'000}, e_x, e_v));
  }
}
BENCHMARK(error_norms_3_axes);

void latency_histogram(benchmark::State& state) {
  limpid::LatencyHistogram histogram;
  limpid::Duration duration{700};
  for (auto _ : state) {
    benchmark::DoNotOptimize(duration);
    histogram.add(duration);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(latency_histogram);

}  // namespace
