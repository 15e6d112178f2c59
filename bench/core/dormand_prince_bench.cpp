// SPDX-License-Identifier: MIT
#include <limpid/core/dormand_prince.hpp>

#include <benchmark/benchmark.h>

namespace {

// One millisecond of a tool of 0.1 kg in tissue of 2000 N/m and 45 N s/m, to 1e-10.
void dormand_prince_1_ms(benchmark::State& state) {
  using State = Eigen::Array2d;
  const limpid::DormandPrince<State> integrator;
  State start(1e-3, 0.05);
  for (auto _ : state) {
    benchmark::DoNotOptimize(start);
    State y = start;
    benchmark::DoNotOptimize(integrator.advance(
        y, 0.0, 1e-3, [](double, const State& at) { return State(at[1], (3 - 45 * at[1] - 2000 * at[0]) / 0.1); }));
    benchmark::DoNotOptimize(y);
  }
}
BENCHMARK(dormand_prince_1_ms);

}  // namespace
