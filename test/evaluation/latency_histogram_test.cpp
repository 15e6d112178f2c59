// SPDX-License-Identifier: MIT
#include <limpid/evaluation/latency_histogram.hpp>

#include "support/no_allocation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

using limpid::Duration;
using limpid::LatencyHistogram;
using namespace std::chrono_literals;

TEST_CASE("an empty histogram answers zero") {
  const LatencyHistogram histogram;
  CHECK(histogram.count() == 0);
  CHECK(histogram.max() == 0ns);
  CHECK(histogram.mean().count() == 0);
  CHECK(histogram.quantile(0.5) == 0ns);
}

TEST_CASE("below 128 ns quantiles are exact") {
  LatencyHistogram histogram;
  for (int ns = 100; ns > 0; --ns) histogram.add(Duration{ns});
  CHECK(histogram.quantile(0) == 1ns);
  CHECK(histogram.quantile(0.5) == 50ns);
  CHECK(histogram.quantile(0.99) == 99ns);
  CHECK(histogram.quantile(1) == 100ns);
}

TEST_CASE("quantiles are at most one part in 64 above those of the sorted durations, from 1 ns to 1 s") {
  std::mt19937 random(20170603);
  std::uniform_real_distribution<double> decades(0, 9);
  LatencyHistogram histogram;
  std::vector<Duration> sorted;
  for (int i = 0; i < 100'000; ++i) {
    const Duration duration{std::llround(std::pow(10, decades(random)))};
    histogram.add(duration);
    sorted.push_back(duration);
  }
  std::sort(sorted.begin(), sorted.end());
  for (const double p : {0.001, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    CAPTURE(p);
    const Duration exact = sorted[static_cast<std::size_t>(std::ceil(p * 100'000)) - 1];
    CHECK(histogram.quantile(p) >= exact);
    CHECK(histogram.quantile(p) - exact <= exact / 64);
  }
}

TEST_CASE("largest, mean and count are exact") {
  LatencyHistogram histogram;
  histogram.add(1'000'003ns);
  histogram.add(7ns);
  histogram.add(500'001ns);
  CHECK(histogram.max() == 1'000'003ns);
  CHECK(histogram.quantile(1) == 1'000'003ns);
  CHECK(histogram.mean().count() == 1'500'011.0 / 3);
  CHECK(histogram.count() == 3);
}

TEST_CASE("a merged histogram answers as if it had counted all itself") {
  LatencyHistogram all, odd, even;
  for (int i = 0; i < 5000; ++i) {
    all.add(Duration{i * i});
    (i % 2 == 0 ? even : odd).add(Duration{i * i});
  }
  odd.merge(even);
  CHECK(odd.count() == all.count());
  CHECK(odd.max() == all.max());
  CHECK(odd.mean() == all.mean());
  for (const double p : {0.0, 0.25, 0.5, 0.99, 1.0}) CHECK(odd.quantile(p) == all.quantile(p));
}

TEST_CASE("what is out of range is counted in the nearest bin") {
  LatencyHistogram histogram;
  histogram.add(-5ns);
  CHECK(histogram.quantile(1) == 0ns);
  histogram.add(24h);
  CHECK(histogram.count() == 2);
  CHECK(histogram.max() == 24h);
  CHECK(histogram.quantile(1) == Duration{(1LL << 40) - 1});  // the end of the last bin
}

TEST_CASE("a fraction that is none is refused with its value") {
  const LatencyHistogram histogram;
  CHECK_THROWS_WITH_AS((void)histogram.quantile(1.5), "LatencyHistogram: quantile: expected from 0 to 1, got 1.5",
                       std::invalid_argument);
  CHECK_THROWS_AS((void)histogram.quantile(-0.1), std::invalid_argument);
  CHECK_THROWS_AS((void)histogram.quantile(std::nan("")), std::invalid_argument);
}

TEST_CASE("counting allocates nothing") {
  LatencyHistogram histogram;
  limpid::test::check_no_allocation([&] { histogram.add(123ns); });
  CHECK(histogram.count() == 1);
}
