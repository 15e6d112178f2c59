// SPDX-License-Identifier: MIT
// Whether every scene's whole tick keeps its budget: p99.9 of at most a microsecond in the best of five rounds, and no
// allocation. Beside it the median round, and the median of ticks with cold caches. usage: budget [TICKS]
#include "other_work.hpp"
#include "scenes/scene.hpp"

#include <support/count_allocations.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace limpid;
using namespace limpid::bench;

constexpr Duration most = std::chrono::microseconds{1};

struct Round {
  Duration p50, p999;
};

struct TickVerdict {
  Round best, median;  ///< by p99.9: of some rounds the best says what the code can, the median what this machine lets
  Duration cold;       ///< median
  std::size_t allocations = 0;

  [[nodiscard]] bool holds() const { return best.p999 <= most && allocations == 0; }
};

Duration cold_median(Scene& scene, OtherWork& other_work) {
  constexpr int ticks = 100;
  LatencyHistogram histogram;
  for (int tick = 0; tick < ticks; ++tick) {
    other_work();
    scene.run(1, &histogram);
  }
  return histogram.quantile(0.5);
}

TickVerdict judge(Scene& scene, long ticks, OtherWork& other_work) {
  TickVerdict verdict{};
  std::array<Round, 5> rounds;
  scene.run(2000);
  for (Round& round : rounds) {
    LatencyHistogram histogram;
    const std::size_t before = test::allocations.load();
    scene.run(ticks, &histogram);
    verdict.allocations = std::max(verdict.allocations, test::allocations.load() - before);
    round = {histogram.quantile(0.5), histogram.quantile(0.999)};
  }
  std::sort(rounds.begin(), rounds.end(), [](const Round& a, const Round& b) { return a.p999 < b.p999; });
  verdict.best = rounds.front();
  verdict.median = rounds[rounds.size() / 2];
  verdict.cold = cold_median(scene, other_work);
  return verdict;
}

}  // namespace

int main(int argc, char** argv) {
  const long ticks = argc > 1 ? std::atol(argv[1]) : 200'000;
  if (argc > 2 || ticks <= 0) {
    std::fprintf(stderr, "budget: expected a number of ticks > 0\n");
    return 1;
  }
  std::vector<Scene> scenes = all_scenes();
  if (!premises_hold(scenes)) return 1;
  OtherWork other_work;
  bool all = true;
  std::printf(
      "five rounds of %ld ticks, 100 cold ones (%zu MiB walked before each); ns, the clock's own cost included\n"
      "%-48s %8s %8s %8s %8s %8s %12s\n",
      ticks, other_work.mebibytes(), "by p99.9: the best round and the median one", "p50", "p99.9", "p50", "p99.9",
      "cold p50", "allocations");
  const auto ns = [](Duration of) { return static_cast<long>(of.count()); };
  for (Scene& scene : scenes) {
    const TickVerdict verdict = judge(scene, ticks, other_work);
    all = all && verdict.holds();
    std::printf("%-48s %8ld %8ld %8ld %8ld %8ld %12zu%s\n", scene.name().c_str(), ns(verdict.best.p50),
                ns(verdict.best.p999), ns(verdict.median.p50), ns(verdict.median.p999), ns(verdict.cold),
                verdict.allocations, verdict.holds() ? "" : "  over the budget");
  }
  return all ? 0 : 1;
}
