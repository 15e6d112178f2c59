// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_expression.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace limpid {

/// What an Lmi says, ready to be solved and checked:
///
///     F_j(x) = F_j0 + sum_i x_i F_ji > 0   for each block j,      c'x = d   where there is an equation
///
/// Terms are of the lower triangle, one for a place and unknown, sorted by unknown; constants come first.
template <Real Scalar = double>
struct LmiProblem {
  using Expression = LmiExpression<Scalar>;
  using Term = typename Expression::Term;

  struct Block {
    int size = 0;
    std::vector<Term> terms;
  };

  int unknowns = 0;
  std::vector<Block> blocks;
  std::vector<Term> equation;   ///< c'x - d, of shape 1 x 1
  std::vector<Term> objective;  ///< to be maximised; empty where none
  bool has_equation = false;

  /// No block has a constant part: with x also every multiple of it, by a number > 0, is a solution.
  [[nodiscard]] bool homogeneous() const {
    return std::all_of(blocks.begin(), blocks.end(), [](const Block& block) {
      return block.terms.empty() || block.terms.front().unknown != Expression::constant;
    });
  }
};

namespace detail {

/// Sums the terms that share an unknown and a place.
template <typename Term>
void merge_terms(std::vector<Term>& terms) {
  const auto place = [](const Term& t) { return std::tuple(t.unknown, t.row, t.column); };
  std::sort(terms.begin(), terms.end(), [&place](const Term& a, const Term& b) { return place(a) < place(b); });
  auto last = terms.begin();
  for (auto next = terms.begin(); next != terms.end(); ++next) {
    if (next == last) continue;
    if (place(*last) == place(*next)) {
      last->factor += next->factor;
    } else {
      *++last = *next;
    }
  }
  if (!terms.empty()) terms.erase(last + 1, terms.end());
}

/// Where an entry and its mirror image differ by rounding, a ball around both; more is refused.
/// @throws std::invalid_argument  where the expression is not symmetric
template <Real Scalar>
[[nodiscard]] std::vector<typename LmiExpression<Scalar>::Term> lower_triangle(
    const LmiExpression<Scalar>& expression) {
  using Term = typename LmiExpression<Scalar>::Term;
  using std::abs;
  std::vector<Term> lower, upper;
  for (const Term& term : expression.terms()) {
    if (term.row >= term.column) lower.push_back(term);
    if (term.row <= term.column) upper.push_back({term.unknown, term.column, term.row, term.factor});
  }
  merge_terms(lower);
  merge_terms(upper);
  Scalar largest{0};
  for (const Term& term : lower) largest = std::max<Scalar>(largest, abs(term.factor.centre()));
  const Scalar rounding = largest * std::numeric_limits<Scalar>::epsilon() * Scalar(16 + 4 * expression.rows());
  const auto refuse = [&expression] {
    throw std::invalid_argument("Lmi: inequality: expected a symmetric matrix, got " + expression.describe());
  };
  const auto before = [](const Term& a, const Term& b) {
    return std::tuple(a.unknown, a.row, a.column) < std::tuple(b.unknown, b.row, b.column);
  };
  std::vector<Term> symmetric;
  symmetric.reserve(lower.size());
  for (auto l = lower.begin(), u = upper.begin(); l != lower.end() || u != upper.end();) {
    const bool below = u == upper.end() || (l != lower.end() && before(*l, *u));
    const bool above = l == lower.end() || (u != upper.end() && before(*u, *l));
    Term term = above ? *u : *l;
    const Ball<Scalar> zero{Scalar{0}};
    const Ball<Scalar> x = above ? zero : l->factor, y = below ? zero : u->factor;
    if (abs(x.centre() - y.centre()) > rounding + x.radius() + y.radius()) refuse();
    if (x.centre() != y.centre() || x.radius() != y.radius()) term.factor = hull(x, y);
    symmetric.push_back(term);
    if (!above) ++l;
    if (!below) ++u;
  }
  return symmetric;
}

}  // namespace detail
}  // namespace limpid
