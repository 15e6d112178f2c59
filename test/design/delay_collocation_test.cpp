// SPDX-License-Identifier: MIT
#include "design/delay_cases.hpp"
#include "sampled_instances.hpp"

#include <limpid/design/delay_collocation.hpp>
#include <limpid/design/delay_stability.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using limpid::collocated_delay_roots;
using limpid::delay_roots_right_of;
using limpid::rightmost_delay_root;
using limpid::test::DelayCase;
using limpid::test::draw_delay_case;
using limpid::test::tool;

TEST_CASE("the rightmost root is the one that collocation finds, where that resolves it") {
  std::mt19937 generator(52);
  INFO("seed 52");
  int compared = 0;
  for (int i = 0; i < 150; ++i) {
    const DelayCase p = draw_delay_case(generator);
    const auto root = rightmost_delay_root(p.system, p.tissue, p.L);
    if (std::abs(root) * p.system.delay > 8) continue;
    const auto roots = collocated_delay_roots(p.system, p.tissue, p.L, 24);
    CAPTURE(p.system.delay);
    CAPTURE(p.L);
    REQUIRE(!roots.empty());
    // Double roots come to half the digits.
    REQUIRE(std::abs(roots.front() - root) < 1e-6 * std::abs(root));
    // And the next ones are as many as are counted.
    int count = 0;
    const double abscissa = root.real() - 0.5 / p.system.delay;
    bool clear = true;
    for (const auto& s : roots) {
      clear = clear && std::abs(s.real() - abscissa) > 1e-6 * std::abs(abscissa);
      if (s.real() > abscissa) count += s.imag() > 1e-6 * std::abs(s) ? 2 : 1;
    }
    // Chains of many roots are not resolved.
    const int exact = delay_roots_right_of(p.system, p.tissue, p.L, abscissa);
    if (clear && exact <= 6) REQUIRE(count == exact);
    ++compared;
  }
  CHECK(compared > 75);
}

TEST_CASE("a system without delay, and too few points, are refused") {
  CHECK_THROWS_AS((void)collocated_delay_roots<double>({tool, 0}, {1, 1}, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)collocated_delay_roots<double>({tool, 1}, {1, 1}, {0, 0}, 3), std::invalid_argument);
}
