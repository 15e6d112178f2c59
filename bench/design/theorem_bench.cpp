// SPDX-License-Identifier: MIT
#include <design/palpation.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/design/theorem3_design.hpp>
#include <limpid/design/theorem5.hpp>

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace limpid;
using limpid::test::design_at;

const Gain<double> gain_016{-441.3, -12.12}, gain_1{-195.1, -4.89};  // Table 6.4

template <typename Result>
void tell(benchmark::State& state, const Result& result) {
  state.SetLabel(std::string(describe(result.verdict)));
  state.counters["iterations"] = result.iterations;
}

void verify_theorem3_at(benchmark::State& state, double T_d, const Gain<double>& L, const Tissue<double>& tissue) {
  const auto design = design_at(T_d);
  Theorem3Verdict<double> result;
  for (auto _ : state) benchmark::DoNotOptimize(result = verify_theorem3(design, tissue, L));
  tell(state, result);
}
BENCHMARK_CAPTURE(verify_theorem3_at, typical, 0.016, gain_016, Tissue<double>{1100, 30});
BENCHMARK_CAPTURE(verify_theorem3_at, near_the_border, 0.1, gain_1, Tissue<double>{202, 23});
BENCHMARK_CAPTURE(verify_theorem3_at, infeasible, 0.1, gain_1, Tissue<double>{200, 40});

void verify_theorem3_by_neighbour(benchmark::State& state) {
  const auto design = design_at(0.016);
  const auto known = verify_theorem3(design, Tissue<double>{1100, 30}, gain_016);
  Theorem3Verdict<double> result;
  for (auto _ : state) {
    benchmark::DoNotOptimize(result = verify_theorem3(design, Tissue<double>{1110, 30}, gain_016, &known.certificate));
  }
  tell(state, result);
}
BENCHMARK(verify_theorem3_by_neighbour);

void verify_theorem3_box(benchmark::State& state) {
  const auto design = design_at(0.016);
  const TissueBox<double> box{{1000, 28}, {1200, 32}};
  Theorem3Verdict<double, 4> result;
  for (auto _ : state) benchmark::DoNotOptimize(result = verify_theorem3(design, box, gain_016));
  tell(state, result);
}
BENCHMARK(verify_theorem3_box);

void design_theorem3_at(benchmark::State& state, double T_d, const Tissue<double>& tissue) {
  const auto design = design_at(T_d);
  GainDesign<double> result;
  for (auto _ : state) benchmark::DoNotOptimize(result = design_theorem3(design, tissue));
  tell(state, result);
}
BENCHMARK_CAPTURE(design_theorem3_at, typical, 0.016, Tissue<double>{1100, 30});
BENCHMARK_CAPTURE(design_theorem3_at, near_the_border, 0.1, Tissue<double>{200, 31});
BENCHMARK_CAPTURE(design_theorem3_at, infeasible_by_its_slow_mode, 0.1, Tissue<double>{200, 36});

void design_theorem5_box(benchmark::State& state, double T_d) {
  const auto design = design_at(T_d, 0);
  ScheduledGainDesign<double> result;
  for (auto _ : state) benchmark::DoNotOptimize(result = design_theorem5(design, test::box, test::rates));
  tell(state, result);
}
BENCHMARK_CAPTURE(design_theorem5_box, T_d_016, 0.016);
BENCHMARK_CAPTURE(design_theorem5_box, T_d_032, 0.032);
BENCHMARK_CAPTURE(design_theorem5_box, infeasible_T_d_1, 0.1);

}  // namespace
