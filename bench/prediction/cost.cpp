// SPDX-License-Identifier: MIT
#include "prediction/cost.hpp"

#include "prediction/contenders.hpp"
#include "prediction/sampling.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace limpid::bench {

namespace {

constexpr double mean_asked = 0.5, p999_asked = 2;  // us
constexpr int rounds = 3;

Cost round_of(const Course& course) {
  std::vector<double> taken = microseconds_of_chosen(course);
  double sum = 0;
  for (const double each : taken) sum += each;
  const auto count = static_cast<double>(taken.size());
  std::ranges::sort(taken);
  return {sum / count, taken[static_cast<std::size_t>(0.999 * count)], taken.back()};
}

}  // namespace

std::vector<Cost> cost_of_chosen(const Selection& selection) {
  const Truth truth = simulate(selection.tissues.front(), selection.forces.front(), {}, selection.seconds);
  std::vector<Cost> costs;
  for (const std::size_t period : selection.periods) {
    const std::vector<SensedSample> samples = sampled(truth, period, {}, 1);
    constexpr double far = std::numeric_limits<double>::infinity();
    Cost best{far, far, far};
    for (int i = 0; i < rounds; ++i) {
      const Cost cost = round_of({truth, samples, period});
      best = {std::min(best.mean, cost.mean), std::min(best.p999, cost.p999), std::min(best.most, cost.most)};
    }
    costs.push_back(best);
  }
  return costs;
}

std::vector<Finding> cost_verdict(const Selection& selection, const std::vector<Cost>& costs) {
  if (costs.empty()) return {};
  std::vector<Measured> means, peaks;
  for (std::size_t period = 0; period < costs.size(); ++period) {
    means.push_back({costs[period].mean, tissue_and_period(selection, 0, period)});
    peaks.push_back({costs[period].p999, tissue_and_period(selection, 0, period)});
  }
  return {finding_of("6 chosen, a tick in the mean, us", mean_asked, std::move(means)),
          finding_of("6 chosen, a tick at p99.9, us", p999_asked, std::move(peaks))};
}

void print_cost(const Selection& selection, const std::vector<Cost>& costs) {
  std::printf("\ntime of a tick of chosen, %s, %s, best of %d rounds, us: mean / p99.9 / most\n",
              selection.tissues.front().name.c_str(), selection.forces.front().name.c_str(), rounds);
  for (std::size_t period = 0; period < costs.size(); ++period) {
    const auto& [mean, p999, most] = costs[period];
    const double seconds = static_cast<double>(selection.periods[period]) * tick_seconds;
    std::printf("T_d = %.3g: %.2f / %.0f / %.0f\n", seconds, mean, p999, most);
  }
}

}  // namespace limpid::bench
