// SPDX-License-Identifier: MIT
// Whether every scene's whole tick keeps its budget: p99.9 of at most a microsecond, and no allocation.
// usage: budget [TICKS]
#include "scenes/scene.hpp"

#include <support/count_allocations.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace limpid;
using namespace limpid::bench;

constexpr Duration most = std::chrono::microseconds{1};

struct TickVerdict {
  Duration p50 = Duration::max(), p999 = Duration::max();
  std::size_t allocations = 0;

  [[nodiscard]] bool holds() const { return p999 <= most && allocations == 0; }
};

// The best of some rounds: another process that takes the processor away says nothing of the code.
TickVerdict judge(Scene& scene, long ticks) {
  constexpr int rounds = 5;
  TickVerdict verdict;
  scene.run(1000);
  for (int round = 0; round < rounds; ++round) {
    LatencyHistogram histogram;
    const std::size_t before = test::allocations.load();
    scene.run(ticks, &histogram);
    verdict.allocations = std::max(verdict.allocations, test::allocations.load() - before);
    if (histogram.quantile(0.999) >= verdict.p999) continue;
    verdict.p50 = histogram.quantile(0.5);
    verdict.p999 = histogram.quantile(0.999);
  }
  return verdict;
}

}  // namespace

int main(int argc, char** argv) {
  const long ticks = argc > 1 ? std::atol(argv[1]) : 200'000;
  if (argc > 2 || ticks <= 0) {
    std::fprintf(stderr, "budget: expected a number of ticks > 0\n");
    return 1;
  }
  bool all = true;
  std::printf("%ld ticks, the best of five rounds; the clock's own cost included\n%-48s %8s %8s %12s\n", ticks, "",
              "p50, ns", "p99.9", "allocations");
  for (Scene& scene : all_scenes()) {
    const TickVerdict verdict = judge(scene, ticks);
    all = all && verdict.holds();
    std::printf("%-48s %8ld %8ld %12zu%s\n", scene.name().c_str(), static_cast<long>(verdict.p50.count()),
                static_cast<long>(verdict.p999.count()), verdict.allocations,
                verdict.holds() ? "" : "  over the budget");
  }
  return all ? 0 : 1;
}
