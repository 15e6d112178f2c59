// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/prediction/knots.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limpid {

/// Knots over a box of tissues, at least two along each side, rising: the products of the hat functions on them are the
/// tensor-product B-splines of degree 1.
template <Real Scalar = double>
struct KnotGrid {
  std::vector<Scalar> stiffness_knots{};  ///< N/m
  std::vector<Scalar> damping_knots{};    ///< N s/m

  static constexpr std::size_t most = 1'000'000;  ///< nodes

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
    detail::check_knots<Scalar>("KnotGrid: stiffness_knots", stiffness_knots);
    detail::check_knots<Scalar>("KnotGrid: damping_knots", damping_knots);
    expect(stiffness_knots.size() <= most / damping_knots.size(), "KnotGrid: nodes", "a million or fewer",
           stiffness_knots.size() * damping_knots.size());
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
    expect(count >= 2 && count <= static_cast<int>(most), "KnotGrid: knots of a side", "2 to a million", count);
    std::vector<Scalar> knots;
    for (int i = 0; i < count; ++i) knots.push_back(from + (to - from) * Scalar(i) / Scalar(count - 1));
    knots.back() = to;
    return knots;
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
  /// @throws std::invalid_argument  where there is not one L for each knot, as where a design found none
  [[nodiscard]] Gain<Scalar> operator()(const Tissue<Scalar>& rho) const {
    const std::size_t knots_of = knots.stiffness_knots.size(), each = knots.damping_knots.size();
    expect(knots_of >= 2 && each >= 2 && L.size() == knots_of * each, "GainSpline: L", "one for each knot", L.size());
    const auto [i, s] = place(knots.stiffness_knots, rho.stiffness);
    const auto [j, t] = place(knots.damping_knots, rho.damping);
    const auto at = [this](std::size_t k, std::size_t b) -> const Gain<Scalar>& {
      return L[k * knots.damping_knots.size() + b];
    };
    return (at(i, j) * (Scalar{1} - t) + at(i, j + 1) * t) * (Scalar{1} - s) +
           (at(i + 1, j) * (Scalar{1} - t) + at(i + 1, j + 1) * t) * s;
  }

 private:
  static detail::KnotPlace<Scalar> place(const std::vector<Scalar>& side, const Scalar& value) {
    return detail::place_among<Scalar>(side, std::clamp<Scalar>(value, side.front(), side.back()));
  }
};

}  // namespace limpid
