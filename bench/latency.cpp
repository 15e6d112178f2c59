// SPDX-License-Identifier: MIT
// Histogram of the whole tick's duration over 1e7 ticks (or as many as the first argument says).
#include "tick/library_tick.hpp"

#include <limpid/evaluation/latency_histogram.hpp>

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace limpid;
using namespace limpid::bench;

template <typename Step>
void measure(const char* name, long ticks, Step&& step) {
  const auto inputs = tick_inputs<double>();
  LatencyHistogram histogram;
  Time now{0};
  for (long i = 0; i < ticks; ++i, now += std::chrono::milliseconds{1}) {
    const auto& input = inputs[static_cast<std::size_t>(i) % inputs.size()];
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(step(now, input));
    histogram.add(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start));
  }
  const auto ns = [&](double p) { return static_cast<long>(histogram.quantile(p).count()); };
  std::printf("%-28s %8ld %8ld %8ld %10ld\n", name, ns(0.5), ns(0.99), ns(0.999),
              static_cast<long>(histogram.max().count()));
}

}  // namespace

int main(int argc, char** argv) {
  const long ticks = argc > 1 ? std::atol(argv[1]) : 10'000'000;
  if (ticks < 1) {
    std::fprintf(stderr, "latency: expected a number of ticks >= 1, got %s\n", argv[1]);
    return 1;
  }
  std::printf("%ld ticks; ns, the clock's own cost included\n%-28s %8s %8s %8s %10s\n", ticks, "", "p50", "p99",
              "p99.9", "max");
  measure("the clock alone", ticks, [](Time now, const auto&) { return now; });

  auto safe = composed_tick<palpation::AllowedTorque<Omni<>>, double>();
  measure("composed, with safety", ticks,
          [&](Time now, const auto& in) { return safe.step(now, in.F_h, in.F_h, in.tool, in.device); });
  auto loop = composed_tick<palpation::WantedTorque<Omni<>>, double>();
  measure("composed", ticks,
          [&](Time now, const auto& in) { return loop.step(now, in.F_h, in.F_h, in.tool, in.device); });
  HandWrittenTick<double> calls;
  measure("hand-written calls", ticks,
          [&](Time now, const auto& in) { return calls.step(now, in.F_h, in.F_h, in.tool, in.device); });
  StraightforwardTick straightforward(TickParts<double>::settings());
  measure("straightforward Eigen", ticks, [&](Time now, const auto& in) {
    return straightforward.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
  });
}
