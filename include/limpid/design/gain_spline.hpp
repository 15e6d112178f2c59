// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/design/design_point.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace limpid {

/// Knots over a box of tissues, at least two along each side, rising: the products of the hat functions on them are the
/// tensor-product B-splines of degree 1.
template <Real Scalar = double>
struct KnotGrid {
  std::vector<Scalar> stiffness_knots{};  ///< N/m
  std::vector<Scalar> damping_knots{};    ///< N s/m

  /// @param stiffnesses, dampings  how many along each side, at equal distances; >= 2
  /// @throws std::invalid_argument  where there are fewer or the box is empty or flat
  [[nodiscard]] static KnotGrid uniform(const TissueBox<Scalar>& box, int stiffnesses, int dampings) {
    box.check();
    const KnotGrid grid{side(box.lower.stiffness, box.upper.stiffness, stiffnesses),
                        side(box.lower.damping, box.upper.damping, dampings)};
    grid.check();
    return grid;
  }

  /// @throws std::invalid_argument  where knots do not rise, are not finite or too few
  void check() const {
    check_side("KnotGrid: stiffness_knots", stiffness_knots);
    check_side("KnotGrid: damping_knots", damping_knots);
  }

  [[nodiscard]] int stiffnesses() const { return static_cast<int>(stiffness_knots.size()); }
  [[nodiscard]] int dampings() const { return static_cast<int>(damping_knots.size()); }
  [[nodiscard]] const Scalar& stiffness(int i) const { return stiffness_knots[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Scalar& damping(int j) const { return damping_knots[static_cast<std::size_t>(j)]; }

  [[nodiscard]] int nodes() const { return stiffnesses() * dampings(); }
  [[nodiscard]] int index(int i, int j) const { return i * dampings() + j; }  ///< of the knot (i, j) among the nodes
  [[nodiscard]] Tissue<Scalar> node(int index) const {
    return {stiffness(index / dampings()), damping(index % dampings())};
  }
  [[nodiscard]] TissueBox<Scalar> box() const {
    return {{stiffness_knots.front(), damping_knots.front()}, {stiffness_knots.back(), damping_knots.back()}};
  }

 private:
  static std::vector<Scalar> side(const Scalar& from, const Scalar& to, int count) {
    expect(count >= 2, "KnotGrid: knots of a side", ">= 2", count);
    std::vector<Scalar> knots;
    for (int i = 0; i < count; ++i) knots.push_back(from + (to - from) * Scalar(i) / Scalar(count - 1));
    knots.back() = to;
    return knots;
  }
  static void check_side(std::string_view name, const std::vector<Scalar>& knots) {
    expect(knots.size() >= 2, name, "two or more", knots.size());
    for (std::size_t i = 0; i < knots.size(); ++i) {
      expect(is_finite(knots[i]) && (i == 0 || knots[i - 1] < knots[i]), name, "finite and rising", knots[i]);
    }
  }
};

/// L(rho) given at knots, bilinear between them.
template <Real Scalar = double>
struct GainSpline {
  KnotGrid<Scalar> knots{};
  std::vector<Gain<Scalar>> L{};  ///< at each node of the knots: N/m, N s/m

  /// @throws std::invalid_argument  where the knots cannot be used, or L is not one finite row for each
  void check() const {
    knots.check();
    expect(L.size() == static_cast<std::size_t>(knots.nodes()), "GainSpline: L", "one for each knot", L.size());
    for (const Gain<Scalar>& row : L) expect(is_finite(row), "GainSpline: L", "finite", row);
  }

  /// Outside the box as on its face.
  [[nodiscard]] Gain<Scalar> operator()(const Tissue<Scalar>& rho) const {
    const auto [i, s] = place(knots.stiffness_knots, rho.stiffness);
    const auto [j, t] = place(knots.damping_knots, rho.damping);
    const auto at = [this](int k, int b) -> const Gain<Scalar>& {
      return L[static_cast<std::size_t>(knots.index(k, b))];
    };
    return (at(i, j) * (Scalar{1} - t) + at(i, j + 1) * t) * (Scalar{1} - s) +
           (at(i + 1, j) * (Scalar{1} - t) + at(i + 1, j + 1) * t) * s;
  }

 private:
  struct Place {
    int cell;
    Scalar part;  // of the cell, 0..1
  };
  static Place place(const std::vector<Scalar>& side, const Scalar& value) {
    const Scalar inside = std::clamp<Scalar>(value, side.front(), side.back());
    const auto above = std::upper_bound(side.begin() + 1, side.end() - 1, inside);
    const auto cell = static_cast<std::size_t>(above - side.begin()) - 1;
    return {static_cast<int>(cell), (inside - side[cell]) / (side[cell + 1] - side[cell])};
  }
};

}  // namespace limpid
