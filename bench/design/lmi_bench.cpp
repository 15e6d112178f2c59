// SPDX-License-Identifier: MIT
#include <design/palpation.hpp>
#include <limpid/design/printed_theorem5.hpp>
#include <limpid/design/printed_theorems.hpp>

#include <benchmark/benchmark.h>

#include <optional>
#include <span>

// The printed, unreduced problems in the general Lmi: what it costs to write one down and to solve it, with its
// certificate. Beside the time: iterations, and whether the verdict was proved (1).
namespace {

using limpid::Gain;
using limpid::Tissue;
using limpid::Verdict;
using limpid::test::box;
using limpid::test::design_at;
using limpid::test::rates;

const limpid::PredictorDesign<> case2 = design_at(1 / 60.0), slow = design_at(0.1);
const Tissue<> typical{2000, 25}, near{235, 30}, beyond{225, 30};  // the last two about Table 6.4's boundary at 0.1 s
const Gain<> L2(-574.1, -7.260), L3(-195.1, -4.89);

limpid::PrintedTheorem<double> theorem3(const limpid::PredictorDesign<>& design, const Tissue<>& tissue,
                                        const std::optional<Gain<>>& L) {
  return limpid::printed_theorem3<double>(design, std::span<const Tissue<>>(&tissue, 1), L);
}

void report(benchmark::State& state, const limpid::LmiResult<>& result) {
  state.counters["iterations"] = result.iterations;
  state.counters["certified"] = result.verdict != Verdict::undecided ? 1 : 0;
}

void write_theorem3(benchmark::State& state) {
  for (auto _ : state) {
    const auto theorem = theorem3(case2, typical, L2);
    benchmark::DoNotOptimize(theorem.lmi.problem().unknowns);
  }
}

void solve(benchmark::State& state, const limpid::PredictorDesign<>& design, const Tissue<>& tissue,
           const std::optional<Gain<>>& L) {
  const auto theorem = theorem3(design, tissue, L);
  limpid::LmiResult<> result;
  for (auto _ : state) {
    result = theorem.lmi.solve();
    benchmark::DoNotOptimize(result.verdict);
  }
  report(state, result);
}

void solve_theorem5(benchmark::State& state, double T_d) {
  const auto theorem = limpid::printed_theorem5<double>(design_at(T_d, 0), box, rates);
  limpid::LmiResult<> result;
  for (auto _ : state) {
    result = theorem.at_centre.lmi.solve();
    benchmark::DoNotOptimize(result.verdict);
  }
  report(state, result);
}

}  // namespace

BENCHMARK(write_theorem3)->Name("lmi/write theorem 3, L fixed");
BENCHMARK_CAPTURE(solve, fixed, case2, typical, L2)->Name("lmi/theorem 3, L fixed, typical");
BENCHMARK_CAPTURE(solve, free, case2, typical, std::nullopt)->Name("lmi/theorem 3, L free, typical");
BENCHMARK_CAPTURE(solve, near, slow, near, L3)->Name("lmi/theorem 3, L fixed, near the boundary");
BENCHMARK_CAPTURE(solve, beyond, slow, beyond, L3)->Name("lmi/theorem 3, L fixed, just infeasible");
BENCHMARK_CAPTURE(solve_theorem5, at16, 0.016)->Name("lmi/theorem 5 on the box, feasible");
BENCHMARK_CAPTURE(solve_theorem5, at100, 0.1)->Name("lmi/theorem 5 on the box, infeasible");
