// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

/// Knots along one side of a table: two or more, rising.
namespace limpid::detail {

/// @throws std::invalid_argument  where there are fewer than two, or they do not rise or are not finite
template <Real Scalar>
void check_knots(std::string_view name, const std::vector<Scalar>& knots) {
  expect(knots.size() >= 2, name, "two or more", knots.size());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    expect(is_finite(knots[i]) && (i == 0 || knots[i - 1] < knots[i]), name, "finite and rising", knots[i]);
  }
  expect(is_finite(Scalar(knots.back() - knots.front())), name, "a finite span", knots.back());
}

template <Real Scalar>
struct KnotPlace {
  std::size_t cell;
  Scalar part;  // of the cell, 0 to 1
};

/// Of a value between the first and the last knot.
template <Real Scalar>
[[nodiscard]] KnotPlace<Scalar> place_among(const std::vector<Scalar>& knots, const Scalar& value) noexcept {
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, value);
  const auto cell = static_cast<std::size_t>(above - knots.begin()) - 1;
  return {cell, (value - knots[cell]) / (knots[cell + 1] - knots[cell])};
}

}  // namespace limpid::detail
