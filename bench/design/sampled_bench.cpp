// SPDX-License-Identifier: MIT
// Stability of the sampled and of the delayed error: maps, robust gains, proofs. Errors stand beside the times.
#include <design/palpation.hpp>
#include <limpid/design/delay_collocation.hpp>
#include <limpid/design/delay_stability.hpp>
#include <limpid/design/sampled_gain.hpp>
#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/sampled_varying.hpp>
#include <support/maximum.hpp>

#include <Eigen/Eigenvalues>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace limpid;
using limpid::test::box;
using limpid::test::maximum;
using limpid::test::tool;

constexpr int side = 256;

struct Design {
  double T;
  Gain<> L;
};
// The robust gains of four periods.
const std::array<Design, 4> designs{
    {{0.016, {-535.71, -3.1564}}, {0.032, {-239.62, -1.7265}}, {0.1, {-39.09, 0.19636}}, {0.2, {-8.4476, 0.1311}}}};

// ke 0 to 4000, be 0 to 100: under, critically and over-damped, stable and not.
Tissue<> cell(int i, int j) { return {4000.0 * i / (side - 1), 100.0 * j / (side - 1)}; }

template <typename Radius>
void map(benchmark::State& state, double delay, Radius&& radius) {
  const double T = 0.032;
  const Gain<> L(-753.2, -17.01);
  const SampledStability<> stability({tool, T, delay * T});
  int stable = 0;
  for (auto _ : state) {
    stable = 0;
    double sum = 0;
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        const double r = radius(stability, cell(i, j), L);
        sum += r;
        stable += r < 1;
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  const SampledStability<long double> exact(
      {{0.1, 0.1, 1}, static_cast<long double>(T), static_cast<long double>(T * delay)});
  double error = 0;
  for (int i = 0; i < side; i += 5) {
    for (int j = 0; j < side; j += 5) {
      const Tissue<> at = cell(i, j);
      const auto r = exact.radius({at.stiffness, at.damping}, L.cast<long double>());
      error = maximum(error, std::abs(static_cast<double>(r - static_cast<long double>(radius(stability, at, L)))));
    }
  }
  state.counters["cells"] = side * side;
  state.counters["stable"] = stable;
  state.counters["ns/cell"] = benchmark::Counter(
      double(side) * side * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["error"] = error;
}

void sampled_map(benchmark::State& state, double delay) {
  map(state, delay,
      [](const auto& stability, const auto& tissue, const auto& L) { return stability.radius(tissue, L); });
}
BENCHMARK_CAPTURE(sampled_map, delay_of_a_period, 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sampled_map, delay_of_a_part, 0.4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sampled_map, delay_of_more, 2.3)->Unit(benchmark::kMillisecond);

// What one writes first: the eigenvalues of the matrix.
void sampled_map_by_eigenvalues(benchmark::State& state) {
  map(state, 1.0, [](const auto& stability, const auto& tissue, const auto& L) {
    const Eigen::Matrix3d M = stability.monodromy(tissue, L);
    return Eigen::EigenSolver<Eigen::Matrix3d>(M, false).eigenvalues().cwiseAbs().maxCoeff();
  });
}
BENCHMARK(sampled_map_by_eigenvalues)->Unit(benchmark::kMillisecond);

void robust_gain(benchmark::State& state) {
  const double T = designs[static_cast<std::size_t>(state.range(0))].T;
  RobustSampledGain<> result;
  for (auto _ : state) result = robust_sampled_gain<double>({tool, T, T}, box);
  state.counters["T"] = T;
  state.counters["worst_proved"] = result.worst_radius;
  state.counters["above_found"] = result.worst_radius / result.worst.found - 1;
  state.counters["cells"] = result.worst.proof.cells;
}
BENCHMARK(robust_gain)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

void gain_at_a_point(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(smallest_sampled_radius<double>({tool, 0.032, 0.032}, {1100, 30}).gain);
}
BENCHMARK(gain_at_a_point)->Unit(benchmark::kMicrosecond);

void proof_over_the_box(benchmark::State& state) {
  const Design& design = designs[static_cast<std::size_t>(state.range(0))];
  SampledProof<> proof;
  for (auto _ : state) proof = prove_sampled_stability<double>({tool, design.T, design.T}, box, design.L, 1);
  if (!proof.proved()) state.SkipWithError("not proved");
  state.counters["T"] = design.T;
  state.counters["cells"] = proof.cells;
}
BENCHMARK(proof_over_the_box)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

void proof_at_a_point(benchmark::State& state) {
  SampledProof<> proof;
  for (auto _ : state) proof = prove_sampled_stability<double>({tool, 0.016, 0.016}, Tissue<>{1100, 30}, designs[0].L);
  if (!proof.proved()) state.SkipWithError("not proved");
}
BENCHMARK(proof_at_a_point)->Unit(benchmark::kMicrosecond);

void proof_for_varying_tissue(benchmark::State& state) {
  const Design& design = designs[static_cast<std::size_t>(state.range(0))];
  VaryingProof<> proof;
  for (auto _ : state) proof = prove_varying_stability<double>({tool, design.T, design.T}, box, design.L);
  if (!proof.proved()) state.SkipWithError("not proved");
  state.counters["T"] = design.T;
  state.counters["cells"] = proof.cells;
}
BENCHMARK(proof_for_varying_tissue)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

void delay_root_map(benchmark::State& state) {
  const DelaySystem<> system{tool, 0.032};
  const Gain<> L(-200, -3);
  int stable = 0;
  for (auto _ : state) {
    stable = 0;
    for (int i = 0; i < 64; ++i) {
      for (int j = 0; j < 64; ++j) stable += rightmost_delay_root(system, cell(4 * i, 4 * j), L).real() < 0;
    }
  }
  double error = 0;
  for (int i = 0; i < 64; i += 9) {
    for (int j = 0; j < 64; j += 9) {
      const auto root = rightmost_delay_root(system, cell(4 * i, 4 * j), L);
      const auto other = collocated_delay_roots(system, cell(4 * i, 4 * j), L);
      error = maximum(error, std::abs(root - other.front()) / std::abs(root));
    }
  }
  state.counters["cells"] = 64 * 64;
  state.counters["stable"] = stable;
  state.counters["us/root"] =
      benchmark::Counter(64.0 * 64 * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["off_collocation"] = error;
}
BENCHMARK(delay_root_map)->Unit(benchmark::kMillisecond);

void delay_root_by_collocation(benchmark::State& state) {
  const DelaySystem<> system{tool, 0.032};
  for (auto _ : state) {
    benchmark::DoNotOptimize(collocated_delay_roots<double>(system, {600, 25}, {-200, -3}).front());
  }
}
BENCHMARK(delay_root_by_collocation)->Unit(benchmark::kMicrosecond);

}  // namespace
