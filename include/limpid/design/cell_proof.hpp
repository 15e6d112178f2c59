// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/ball.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/mean_value_form.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

namespace limpid::detail {

/// The values of two parameters with lower <= value <= upper.
template <Real Scalar>
struct Cell {
  std::array<Scalar, 2> lower{}, upper{};

  [[nodiscard]] std::array<Scalar, 2> centre() const {
    return {(lower[0] + upper[0]) / Scalar{2}, (lower[1] + upper[1]) / Scalar{2}};
  }
};

/// Two halves that share their edge; false where there is no number between the ends of either side.
template <Real Scalar>
[[nodiscard]] bool halve(const Cell<Scalar>& cell, std::size_t first, Cell<Scalar>& low, Cell<Scalar>& high) {
  const auto middle = cell.centre();
  const auto can = [&](std::size_t side) { return cell.lower[side] < middle[side] && middle[side] < cell.upper[side]; };
  if (!can(0) && !can(1)) return false;
  const std::size_t side = can(first) ? first : 1 - first;
  low = high = cell;
  low.upper[side] = high.lower[side] = middle[side];
  return true;
}

/// Hands the conditions under which all roots of the monic p are inside the unit circle to `holds`, one by one, while
/// it says yes: each is positive, and where one is negative and all before it positive a root is outside.
template <typename Coefficients, typename Holds>
[[nodiscard]] bool jury_conditions(Coefficients p, Holds&& holds) {
  using Form = typename Coefficients::Scalar;
  const Form one = p[p.size() - 1];
  Eigen::Index N = p.size() - 1;
  // (p(z) - p_0 p*(z))/z, with p* the reversed polynomial, has one root fewer inside where |p_0| < 1.
  for (; N > 3; --N) {
    const Form k = p[0];
    if (!holds(one - k) || !holds(one + k)) return false;
    const Form scale = one / ((one - k) * (one + k));
    const auto old = p;
    for (Eigen::Index i = 0; i + 1 < N; ++i) p[i] = (old[i + 1] - k * old[N - 1 - i]) * scale;
    p[N - 1] = one;
  }
  if (N == 2) return holds(one - p[0]) && holds(one + p[1] + p[0]) && holds(one - p[1] + p[0]);
  const Form even = one + p[1], odd = p[2] + p[0];
  return holds(one - p[0]) && holds(one + p[0]) && holds(even + odd) && holds(even - odd) &&
         holds(one - p[1] + p[0] * (p[2] - p[0]));
}

/// One cell: whether all roots over it are smaller than a radius, and where not.
template <Real Scalar>
struct CellTest {
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;
  enum class Outcome { holds, fails, divide };

  Outcome outcome = Outcome::holds;
  std::size_t side{0};            // to divide
  std::array<Scalar, 2> point{};  // where it fails

  /// @param p  over the cell; changed by the way
  template <typename Coefficients>
  CellTest(const Cell<Scalar>& cell, Coefficients p, const Scalar& radius) : point{cell.centre()} {
    const Number inverse = Number{Scalar{1}} / Number{radius};
    Number power = inverse;
    for (Eigen::Index i = p.size() - 2; i >= 0; --i, power *= inverse) p[i] = power * p[i];
    bool at_centre = true;  // all conditions so far hold there
    (void)jury_conditions(p, [&](const Form& condition) {
      if (outcome == Outcome::holds && !condition.range().certainly_positive()) fail(cell, condition);
      if (condition.centre().certainly_negative() && at_centre) {
        outcome = Outcome::fails;
        point = cell.centre();
      }
      at_centre = at_centre && condition.centre().certainly_positive();
      return at_centre && outcome != Outcome::fails;
    });
  }

 private:
  // The first condition that does not hold all over the cell: those before hold at its lowest corner too.
  void fail(const Cell<Scalar>& cell, const Form& condition) {
    const std::array<const Number*, 2> slopes{&condition.slope1(), &condition.slope2()};
    std::array<Scalar, 2> corner{};
    std::array<Number, 2> Delta{};
    for (std::size_t i = 0; i < 2; ++i) {
      corner[i] = slopes[i]->centre() > Scalar{0} ? cell.lower[i] : cell.upper[i];
      Delta[i] = place(cell.lower[i], cell.upper[i], corner[i]);
    }
    if (condition.at(Delta[0], Delta[1]).certainly_negative()) {
      outcome = Outcome::fails;
      point = corner;
      return;
    }
    outcome = Outcome::divide;
    const bool first = condition.range().bounded() ? condition.slope1().magnitude() > condition.slope2().magnitude()
                                                   : relative_width(cell, 0) > relative_width(cell, 1);
    side = first ? 0 : 1;
  }

  static Scalar relative_width(const Cell<Scalar>& cell, std::size_t i) {
    using std::abs;
    return cell.upper[i] > cell.lower[i] ? (cell.upper[i] - cell.lower[i]) / (abs(cell.lower[i]) + abs(cell.upper[i]))
                                         : Scalar{0};
  }

  // Delta of a value of the side [lower, upper].
  static Number place(const Scalar& lower, const Scalar& upper, const Scalar& value) {
    const Number whole = Number::between(lower, upper);
    if (whole.radius() == Scalar{0}) return Number{};
    return (Number{value} - Number{whole.centre()}) / Number{whole.radius()};
  }
};

/// What came of a proof over a box of two parameters.
template <Real Scalar>
struct CellProof {
  Verdict verdict = Verdict::undecided;  // feasible: in every cell; infeasible: not at `point`
  int cells{0};                          // looked at
  Cell<Scalar> cell{};                   // where it ended, unless feasible
  std::array<Scalar, 2> point{};         // centre of that cell or one of its corners
  std::string_view reason{};
};

/// Proves that all roots are smaller than `radius` everywhere in a box, or not at some point of it, by halving it until
/// the conditions of Jury, enclosed with everything that is rounded, hold all over each cell.
/// @param polynomial  polynomial(cell): enclosure of the coefficients, p_N = 1
template <Real Scalar, typename Polynomial>
[[nodiscard]] CellProof<Scalar> prove_roots_inside(const Cell<Scalar>& box, const Polynomial& polynomial,
                                                   const Scalar& radius, int most_cells) {
  using Test = CellTest<Scalar>;
  std::vector<Cell<Scalar>> open{box};
  CellProof<Scalar> proof;
  while (!open.empty()) {
    proof.cell = open.back();
    if (proof.cells == most_cells) {
      proof.reason = "cells exhausted: the radius comes too close to the bound";
      return proof;
    }
    open.pop_back();
    ++proof.cells;
    const Test test(proof.cell, polynomial(proof.cell), radius);
    if (test.outcome == Test::Outcome::holds) continue;
    proof.point = test.point;
    if (test.outcome == Test::Outcome::fails) {
      proof.verdict = Verdict::infeasible;
      proof.reason = "a point of the box has a radius above the bound";
      return proof;
    }
    Cell<Scalar> low, high;
    if (!halve(proof.cell, test.side, low, high)) {
      proof.reason = "a cell cannot be halved: the radius is at the bound, or the numbers too large";
      return proof;
    }
    open.push_back(high);
    open.push_back(low);
  }
  proof.verdict = Verdict::feasible;
  proof.reason = "the radius is below the bound in every cell";
  return proof;
}

}  // namespace limpid::detail
