// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_certificate.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace limpid {

/// Multipliers of an Lmi's inequalities and of its equation.
template <Real Scalar = double>
struct LmiMultipliers {
  std::vector<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>> Z;
  Scalar y{0};
};

namespace detail {

/// Bounds of what is left of the dual's equalities, sum_j <F_ji, Z_j> + y c_i + b_i, and of what can be done about it.
template <Real Scalar>
class DualResidual {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Problem = LmiProblem<Scalar>;

  /// @param balance  in units in which the diagonals of Z are about 1
  DualResidual(const Problem& problem, const LmiMultipliers<Scalar>& dual, bool with_objective, bool balance)
      : problem_{problem}, rows_(static_cast<std::size_t>(problem.unknowns)) {
    using std::sqrt;
    for (std::size_t j = 0; j < problem.blocks.size(); ++j) {
      Vector D = Vector::Ones(dual.Z[j].rows());
      for (Eigen::Index i = 0; balance && i < D.size(); ++i) D[i] = inverse_power_of_two<Scalar>(sqrt(dual.Z[j](i, i)));
      scaled_.push_back(D.asDiagonal() * dual.Z[j] * D.asDiagonal());
      if (dual.Z[j].isZero(Scalar{0})) continue;  // the block is not used
      for (auto term : problem.blocks[j].terms) {
        const Scalar scale = Scalar{1} / (D[term.row] * D[term.column]);
        term.factor = {term.factor.centre() * scale, term.factor.radius() * scale};
        const bool diagonal = term.row == term.column;
        put(term, static_cast<int>(j), scaled_[j](term.row, term.column), diagonal ? Scalar{1} : Scalar{2});
      }
    }
    if (dual.y != Scalar{0}) {
      for (const auto& term : problem.equation) put(term, static_cast<int>(problem.blocks.size()), dual.y, Scalar{1});
    }
    if (!with_objective) return;
    for (const auto& term : problem.objective) {
      sum(term.unknown).add(term.factor, Scalar{1});
      if (term.unknown == LmiExpression<Scalar>::constant) continue;
      objective_.push_back({static_cast<int>(problem.blocks.size()) + 1, 0, 0, term.unknown, Scalar{1}, term.factor});
    }
  }

  /// D Z D, D of powers of two: in these units all below is meant, with D^-1 F_i D^-1.
  [[nodiscard]] const std::vector<Matrix>& scaled_multipliers() const { return scaled_; }

  /// At least the least ||(dZ, dy)|| that makes every equality hold; infinite where no bound is proved.
  [[nodiscard]] Scalar correction() {
    using std::abs, std::sqrt;
    std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.order() < b.order(); });
    const std::vector<int> used = independent_unknowns();
    if (used.empty()) return Scalar{0};
    const Vector scale = gram(used);
    Scalar squares{0};
    for (std::size_t i = 0; i < used.size(); ++i) {
      const auto& row = rows_[static_cast<std::size_t>(used[i])];
      const Scalar bound = (abs(row.value) + row.error()) * scale[static_cast<Eigen::Index>(i)];
      squares += bound * bound;
    }
    const int n = static_cast<int>(used.size());
    const Scalar least = least_eigenvalue();
    if (!(least > Scalar{0})) return std::numeric_limits<Scalar>::infinity();
    return rounded_up<Scalar>(sqrt(rounded_up<Scalar>(rounded_up(squares, 2 * n) / least, n)), 1);
  }

  /// At least sum_j <F_j0, Z_j> - y d, with the correction's part in it.
  [[nodiscard]] Scalar value(const Scalar& correction) const {
    using std::sqrt;
    if (constant_.terms == 0) return Scalar{0};
    const Scalar length = rounded_up<Scalar>(sqrt(rounded_up(constant_squares_, constant_.terms)), 1);
    const Scalar sum = constant_.value + constant_.error() + rounded_up<Scalar>(correction * length, 1);
    using std::abs;
    return sum + Scalar{8} * std::numeric_limits<Scalar>::epsilon() * (abs(constant_.value) + abs(sum));
  }

 private:
  struct Place {
    int block, row, column, unknown;
    Scalar weight;
    Ball<Scalar> factor;
    [[nodiscard]] auto order() const { return std::tuple(block, row, column, unknown); }
    [[nodiscard]] bool same_exact_entry(const Place& other) const {
      return std::tuple(block, row, column) == std::tuple(other.block, other.row, other.column) &&
             factor.centre() == other.factor.centre() && factor.radius() == Scalar{0} &&
             other.factor.radius() == Scalar{0};
    }
  };

  BoundedSum<Scalar>& sum(int unknown) {
    return unknown == LmiExpression<Scalar>::constant ? constant_ : rows_[static_cast<std::size_t>(unknown)];
  }
  void put(const typename Problem::Term& term, int block, const Scalar& multiplier, const Scalar& weight) {
    sum(term.unknown).add(term.factor, weight * multiplier);
    if (term.unknown == LmiExpression<Scalar>::constant) {
      const Scalar magnitude = term.factor.magnitude();
      constant_squares_ += weight * magnitude * magnitude;
    } else {
      places_.push_back({block, term.row, term.column, term.unknown, weight, term.factor});
    }
  }

  // Those with terms, of unknowns with equal exact coefficients (as in X + X'), the objective's too, the first.
  [[nodiscard]] std::vector<int> independent_unknowns() const {
    std::vector<std::vector<const Place*>> coefficients(rows_.size());
    for (const auto* places : {&places_, &objective_}) {
      for (const Place& place : *places) coefficients[static_cast<std::size_t>(place.unknown)].push_back(&place);
    }
    const auto same = [&](int a, int b) {
      const auto &x = coefficients[static_cast<std::size_t>(a)], &y = coefficients[static_cast<std::size_t>(b)];
      return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                        [](const Place* p, const Place* q) { return p->same_exact_entry(*q); });
    };
    std::vector<int> used;
    for (int i = 0; i < problem_.unknowns; ++i) {
      if (rows_[static_cast<std::size_t>(i)].terms == 0) continue;
      if (std::none_of(used.begin(), used.end(), [&](int k) { return same(i, k); })) used.push_back(i);
    }
    return used;
  }

  // Gram_ik = <F_i, F_k> + c_i c_k, scaled by powers of two to a diagonal of about 1. The scales.
  Vector gram(const std::vector<int>& used) {
    using std::sqrt;
    const auto n = static_cast<Eigen::Index>(used.size());
    std::vector<Eigen::Index> index(rows_.size(), -1);
    for (std::size_t i = 0; i < used.size(); ++i)
      index[static_cast<std::size_t>(used[i])] = static_cast<Eigen::Index>(i);
    Eigen::Matrix<BoundedSum<Scalar>, Eigen::Dynamic, Eigen::Dynamic> sums(n, n);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Place& a = places_[i];
      if (index[static_cast<std::size_t>(a.unknown)] < 0) continue;
      for (std::size_t k = i + 1; k-- > 0;) {
        const Place& b = places_[k];
        if (std::tuple(a.block, a.row, a.column) != std::tuple(b.block, b.row, b.column)) break;
        if (index[static_cast<std::size_t>(b.unknown)] < 0) continue;
        sums(index[static_cast<std::size_t>(a.unknown)], index[static_cast<std::size_t>(b.unknown)])
            .add(a.factor, b.factor, a.weight);
      }
    }
    Vector scale(n);
    for (Eigen::Index i = 0; i < n; ++i) scale[i] = inverse_power_of_two<Scalar>(sqrt(sums(i, i).value));
    gram_ = Matrix::Zero(n, n);
    Scalar squares{0};
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k <= i; ++k) {
        if (sums(i, k).terms == 0) continue;
        gram_(i, k) = gram_(k, i) = sums(i, k).value * scale[i] * scale[k];
        const Scalar error = sums(i, k).error() * scale[i] * scale[k];
        squares += error * error * (i == k ? Scalar{1} : Scalar{2});
      }
    }
    gram_error_ = rounded_up<Scalar>(sqrt(rounded_up(squares, static_cast<int>(n * n))), 1);
    return scale;
  }

  // Below that of the Gram matrix, or 0: a few guesses, since a correction of the size of rounding need not be sharp.
  [[nodiscard]] Scalar least_eigenvalue() const {
    for (Scalar guess = Scalar{1} / Scalar{32}; guess > std::numeric_limits<Scalar>::epsilon(); guess /= Scalar{64}) {
      if (verified_positive_definite(gram_, rounded_up<Scalar>(gram_error_ + guess, 1))) return guess;
    }
    return Scalar{0};
  }

  const Problem& problem_;
  std::vector<BoundedSum<Scalar>> rows_;
  BoundedSum<Scalar> constant_;
  Scalar constant_squares_{0};
  std::vector<Place> places_, objective_;
  std::vector<Matrix> scaled_;
  Matrix gram_;
  Scalar gram_error_{0};
};

template <Real Scalar>
[[nodiscard]] Scalar upper_bound(const LmiProblem<Scalar>& problem, const LmiMultipliers<Scalar>& dual,
                                 bool with_objective, bool balance) {
  constexpr Scalar none = std::numeric_limits<Scalar>::infinity();
  DualResidual<Scalar> residual(problem, dual, with_objective, balance);
  const Scalar correction = residual.correction();
  if (!is_finite(correction)) return none;
  bool used = false;
  for (const auto& Z : residual.scaled_multipliers()) {
    if (Z.isZero(Scalar{0})) continue;
    used = true;
    if (!verified_positive_definite(Z, correction)) return none;
  }
  return used ? residual.value(correction) : none;
}

}  // namespace detail

/// A number that the objective of no solution exceeds, proved by the multipliers; infinity where they prove none.
///
///     b'x <= b'x + sum_j <F_j(x), Z_j> + y (c'x - d) = sum_j <F_j0, Z_j> - y d      where
///     Z_j >= 0,   sum_j <F_ji, Z_j> + y c_i + b_i = 0  for each i
///
/// The equalities need hold up to a residual r only: some dZ with ||dZ|| <= ||r|| / sqrt(lambda_min(Gram)) makes up for
/// it, and Z_j > ||dZ|| I keeps its sign. A Z_j that is exactly 0 stays so. Off line: allocates.
template <Real Scalar>
[[nodiscard]] Scalar certified_upper_bound(const LmiProblem<Scalar>& problem, const LmiMultipliers<Scalar>& dual,
                                           bool with_objective = true) {
  constexpr Scalar none = std::numeric_limits<Scalar>::infinity();
  if (dual.Z.size() != problem.blocks.size() || !is_finite(dual.y)) return none;
  for (std::size_t j = 0; j < dual.Z.size(); ++j) {
    const auto& Z = dual.Z[j];
    if (Z.rows() != problem.blocks[j].size || Z.cols() != problem.blocks[j].size || !is_finite(Z)) return none;
  }
  // The second way is for multipliers of very different sizes.
  const Scalar bound = detail::upper_bound(problem, dual, with_objective, false);
  return is_finite(bound) ? bound : detail::upper_bound(problem, dual, with_objective, true);
}

/// Whether the multipliers prove that there is no solution: with b = 0 one would make
/// 0 < sum_j <F_j(x), Z_j> <= 0. Off line: allocates.
template <Real Scalar>
[[nodiscard]] bool certifies_infeasible(const LmiProblem<Scalar>& problem, const LmiMultipliers<Scalar>& dual) {
  return certified_upper_bound(problem, dual, false) <= Scalar{0};
}

}  // namespace limpid
