// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace limpid::wiring {

/// A set of N blocks.
template <std::size_t N>
using Set = std::array<bool, N>;

/// relation[i][j]: block i stands in it to block j.
template <std::size_t N>
using Relation = std::array<Set<N>, N>;

/// The first block of a set; N where it is empty.
template <std::size_t N>
[[nodiscard]] constexpr std::size_t first(const Set<N>& set) noexcept {
  std::size_t i = 0;
  while (i < N && !set[i]) ++i;
  return i;
}

template <std::size_t N>
[[nodiscard]] constexpr std::size_t count(const Set<N>& set) noexcept {
  std::size_t members = 0;
  for (const bool member : set) members += member ? 1 : 0;
  return members;
}

/// The first block of a set behind a given one; N where there is none.
template <std::size_t N>
[[nodiscard]] constexpr std::size_t first_after(Set<N> set, std::size_t block) noexcept {
  for (std::size_t i = 0; i <= block && i < N; ++i) set[i] = false;
  return first(set);
}

/// Whether the sets have a member in common.
template <std::size_t N>
[[nodiscard]] constexpr bool meet(const Set<N>& a, const Set<N>& b) noexcept {
  for (std::size_t i = 0; i < N; ++i) {
    if (a[i] && b[i]) return true;
  }
  return false;
}

/// Blocks in a row; the first `size` entries count.
template <std::size_t N>
struct Row {
  std::array<std::size_t, N> block{};
  std::size_t size = 0;
};

/// Where a block stands in a row; its size where it does not.
template <std::size_t N>
[[nodiscard]] constexpr std::size_t position(const Row<N>& row, std::size_t block) noexcept {
  std::size_t k = 0;
  while (k < row.size && row.block[k] != block) ++k;
  return k;
}

/// `from` and all that its members stand in the relation to, directly or through others.
template <std::size_t N>
[[nodiscard]] constexpr Set<N> reach(const Relation<N>& relation, Set<N> from) noexcept {
  for (std::size_t round = 0; round < N; ++round) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) from[j] = from[j] || (from[i] && relation[i][j]);
    }
  }
  return from;
}

template <std::size_t N>
[[nodiscard]] constexpr Relation<N> transposed(const Relation<N>& relation) noexcept {
  Relation<N> other{};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) other[j][i] = relation[i][j];
  }
  return other;
}

/// Lets each block of `last` come after every kept block that does not depend on a block of `last`.
template <std::size_t N>
[[nodiscard]] constexpr Relation<N> put_last(Relation<N> after, const Set<N>& kept, const Set<N>& last) noexcept {
  const Set<N> downstream = reach(transposed(after), last);
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) after[i][j] = after[i][j] || (last[i] && kept[j] && !downstream[j]);
  }
  return after;
}

/// The kept blocks, each after those it comes after, otherwise as given; blocks on or behind a cycle are missing.
template <std::size_t N>
[[nodiscard]] constexpr Row<N> sorted(const Relation<N>& after, const Set<N>& kept) noexcept {
  Row<N> order;
  Set<N> open = kept;
  for (std::size_t i = 0; i < N;) {
    bool ready = open[i];
    for (std::size_t j = 0; j < N; ++j) ready = ready && !(open[j] && after[i][j]);
    if (ready) {
      open[i] = false;
      order.block[order.size++] = i;
    }
    i = ready ? 0 : i + 1;
  }
  return order;
}

/// Blocks that each come after the next, and the last after the first; none where `order` holds all that are kept.
template <std::size_t N>
[[nodiscard]] constexpr Row<N> cycle(const Relation<N>& after, const Set<N>& kept, const Row<N>& order) noexcept {
  Set<N> open = kept;
  for (std::size_t k = 0; k < order.size; ++k) open[order.block[k]] = false;
  std::size_t at = first(open);
  Row<N> path;
  if (at == N) return path;
  const auto next = [&](std::size_t i) {
    std::size_t j = 0;
    while (!(open[j] && after[i][j])) ++j;
    return j;
  };
  for (std::size_t step = 0; step < N; ++step) at = next(at);  // now on the cycle
  const std::size_t start = at;
  do {
    path.block[path.size++] = at;
    at = next(at);
  } while (at != start);
  return path;
}

}  // namespace limpid::wiring
