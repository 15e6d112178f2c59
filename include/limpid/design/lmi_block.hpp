// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_expression.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace limpid {

/// Rows of blocks, as a paper writes them; a plain 0 fills its place, and a row of such zeros is one high.
template <Real Scalar>
using LmiRows = std::initializer_list<std::initializer_list<LmiExpression<std::type_identity_t<Scalar>>>>;

namespace detail {

template <Real Scalar>
[[nodiscard]] bool fills_its_place(const LmiExpression<Scalar>& entry) {
  return entry.is_zero() && entry.rows() == 1 && entry.columns() == 1;
}

/// Where each block row and column begins; the last entry is where they end.
struct BlockPlaces {
  std::vector<int> rows, columns;
};

inline constexpr int open_size = -1;  // of a block row or column in which nothing but plain zeros has come yet

template <Real Scalar>
void settle(int& size, int entry, const char* what, std::size_t i, std::size_t j, const LmiExpression<Scalar>& got) {
  if (size == open_size) size = entry;
  if (size == entry) return;
  throw std::invalid_argument("Lmi: block: expected " + std::to_string(size) + " " + what + " in block row " +
                              std::to_string(i + 1) + " and column " + std::to_string(j + 1) + ", got " +
                              got.describe());
}

inline std::vector<int> ends(const std::vector<int>& sizes) {
  std::vector<int> places{0};
  for (const int size : sizes) places.push_back(places.back() + (size == open_size ? 1 : size));
  return places;
}

/// @param symmetric  whether row i and column i are one size
template <Real Scalar>
[[nodiscard]] BlockPlaces places(const LmiRows<Scalar>& rows, std::size_t width, bool symmetric) {
  std::vector<int> heights(rows.size(), open_size), widths(width, open_size);
  std::size_t i = 0;
  for (const auto& row : rows) {
    std::size_t j = 0;
    for (const auto& entry : row) {
      if (!fills_its_place<Scalar>(entry)) {
        settle(heights[i], entry.rows(), "rows", i, j, entry);
        settle(symmetric ? heights[j] : widths[j], entry.columns(), "columns", i, j, entry);
      }
      ++j;
    }
    ++i;
  }
  return {ends(heights), ends(symmetric ? heights : widths)};
}

inline void expect_entries(std::size_t row, std::size_t expected, std::size_t got) {
  if (got == expected) return;
  throw std::invalid_argument("Lmi: block: expected " + std::to_string(expected) + " entries in block row " +
                              std::to_string(row + 1) + ", got " + std::to_string(got));
}

}  // namespace detail

/// A matrix of blocks, each row given in full.
/// Off line: allocates.
/// @throws std::invalid_argument  where rows differ in length or shapes do not fit
template <Real Scalar = double>
[[nodiscard]] LmiExpression<Scalar> block(LmiRows<Scalar> rows) {
  const std::size_t width = rows.size() == 0 ? 0 : rows.begin()->size();
  std::size_t i = 0;
  for (const auto& row : rows) detail::expect_entries(i++, width, row.size());
  const detail::BlockPlaces at = detail::places<Scalar>(rows, width, false);
  LmiExpression<Scalar> whole(nullptr, at.rows.back(), at.columns.back());
  i = 0;
  for (const auto& row : rows) {
    std::size_t j = 0;
    for (const auto& entry : row) whole.add(entry, at.rows[i], at.columns[j++]);
    ++i;
  }
  return whole;
}

/// A symmetric matrix of blocks of which row i gives the first i: the triangle above is the one below, transposed.
/// Off line: allocates.
/// @throws std::invalid_argument  where row i has not i entries or shapes do not fit
template <Real Scalar = double>
[[nodiscard]] LmiExpression<Scalar> symmetric_block(LmiRows<Scalar> rows) {
  std::size_t i = 0;
  for (const auto& row : rows) {
    detail::expect_entries(i, i + 1, row.size());
    ++i;
  }
  const detail::BlockPlaces at = detail::places<Scalar>(rows, rows.size(), true);
  LmiExpression<Scalar> whole(nullptr, at.rows.back(), at.rows.back());
  i = 0;
  for (const auto& row : rows) {
    std::size_t j = 0;
    for (const auto& entry : row) {
      whole.add(entry, at.rows[i], at.rows[j]);
      if (i != j) whole.add(transpose(entry), at.rows[j], at.rows[i]);
      ++j;
    }
    ++i;
  }
  return whole;
}

/// I of n x n.
template <Real Scalar = double>
[[nodiscard]] LmiExpression<Scalar> identity(int n) {
  LmiExpression<Scalar> unit(nullptr, n, n);
  for (int i = 0; i < n; ++i) unit.add(LmiExpression<Scalar>::constant, i, i, Ball<Scalar>(Scalar{1}));
  return unit;
}

/// 0 of the shape given; in a block a plain 0 does.
template <Real Scalar = double>
[[nodiscard]] LmiExpression<Scalar> zero(int rows, int columns) {
  return {nullptr, rows, columns};
}

}  // namespace limpid
