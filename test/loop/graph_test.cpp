// SPDX-License-Identifier: MIT
#include <limpid/loop/graph.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>

namespace {

using limpid::wiring::Relation;
using limpid::wiring::Row;
using limpid::wiring::Set;

template <std::size_t N>
constexpr Set<N> everyone() {
  Set<N> set{};
  for (bool& member : set) member = true;
  return set;
}

}  // namespace

TEST_CASE("the order is found by the compiler") {
  constexpr Relation<3> after{{{false, true, false}, {false, false, true}, {}}};  // 0 after 1 after 2
  constexpr Row<3> order = limpid::wiring::sorted(after, everyone<3>());
  static_assert(order.size == 3 && order.block[0] == 2 && order.block[1] == 1 && order.block[2] == 0);
}

TEST_CASE("blocks that do not depend on each other keep the order in which they were given") {
  const Row<4> order = limpid::wiring::sorted(Relation<4>{}, everyone<4>());
  for (std::size_t k = 0; k < 4; ++k) CHECK(order.block[k] == k);
}

TEST_CASE("in random graphs without cycles every block comes after all that it depends on, once") {
  constexpr std::size_t n = 9;
  std::mt19937 random(20170602);
  std::bernoulli_distribution edge(0.3);
  for (int round = 0; round < 1000; ++round) {
    CAPTURE(round);
    std::array<std::size_t, n> rank{};  // a random numbering; edges go to lower ranks, so that there is no cycle
    for (std::size_t i = 0; i < n; ++i) rank[i] = i;
    std::shuffle(rank.begin(), rank.end(), random);
    Relation<n> after{};
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) after[i][j] = rank[j] < rank[i] && edge(random);
    }
    const Row<n> order = limpid::wiring::sorted(after, everyone<n>());
    REQUIRE(order.size == n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (after[i][j]) REQUIRE(limpid::wiring::position(order, j) < limpid::wiring::position(order, i));
      }
    }
    REQUIRE(limpid::wiring::cycle(after, everyone<n>(), order).size == 0);
  }
}

TEST_CASE("a cycle is named block by block, without those that only hang on it") {
  // 0 after 1 after 2 after 1: block 0 hangs on the cycle of 1 and 2; 3 is free
  constexpr Relation<4> after{
      {{false, true, false, false}, {false, false, true, false}, {false, true, false, false}, {}}};
  const Row<4> order = limpid::wiring::sorted(after, everyone<4>());
  CHECK(order.size == 1);
  const Row<4> cycle = limpid::wiring::cycle(after, everyone<4>(), order);
  REQUIRE(cycle.size == 2);
  CHECK(cycle.block[0] + cycle.block[1] == 3);
}

TEST_CASE("a block put last comes after all that does not depend on it, and before all that does") {
  constexpr Relation<4> after{{{false, true, false, false}, {}, {}, {}}};  // 0 depends on 1, the one put last
  constexpr Set<4> last{false, true, false, false};
  const Row<4> order = limpid::wiring::sorted(limpid::wiring::put_last(after, everyone<4>(), last), everyone<4>());
  REQUIRE(order.size == 4);
  CHECK(order.block[0] == 2);
  CHECK(order.block[1] == 3);
  CHECK(order.block[2] == 1);
  CHECK(order.block[3] == 0);
}

TEST_CASE("two blocks put last do not wait for each other") {
  constexpr Set<3> last{true, true, false};
  const Row<3> order =
      limpid::wiring::sorted(limpid::wiring::put_last(Relation<3>{}, everyone<3>(), last), everyone<3>());
  REQUIRE(order.size == 3);
  CHECK(order.block[0] == 2);
}
