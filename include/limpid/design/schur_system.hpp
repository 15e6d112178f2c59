// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/dynamic_block.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace limpid::detail {

/// M dx + C' y = r,  C dx = d - C x,  with M positive definite, or nearly singular where variables depend on one
/// another. By Cholesky's factor of M, refined. Of M the lower triangle is filled in.
///
/// This one is for a fixed number of unknowns and one equation.
template <Real Scalar, int unknowns, int equations>
class SchurSystem {
  static_assert(equations == 1, "SchurSystem: of fixed size there is one equation");

 public:
  using Vector = Eigen::Matrix<Scalar, unknowns, 1>;
  using Row = Eigen::Matrix<Scalar, 1, unknowns>;
  using Multiplier = Eigen::Matrix<Scalar, 1, 1>;

  void clear(Eigen::Index) { M_.fill(Scalar{0}); }
  [[nodiscard]] Scalar& operator()(int i, int j) { return M_[at(i, j)]; }

  /// False where M is too far from positive definite.
  [[nodiscard]] bool factorise(const Row& C) {
    for (int i = 0; i < unknowns; ++i) {
      if (M_[at(i, i)] == Scalar{0}) M_[at(i, i)] = Scalar{1};  // a variable that is in no block
    }
    Scalar shift = std::numeric_limits<Scalar>::epsilon();
    for (int attempt = 0; !decompose(); ++attempt, shift *= Scalar{256}) {
      if (attempt == 5) return false;
      for (int i = 0; i < unknowns; ++i) M_[at(i, i)] *= Scalar{1} + shift;
    }
    for (int i = 0; i < unknowns; ++i) by_equation_[i] = C[i];
    substitute(by_equation_);
    Scalar product{0};
    for (int i = 0; i < unknowns; ++i) product += C[i] * by_equation_[i];
    equation_ = product;
    return product > Scalar{0};
  }

  void solve(const Vector& right, const Row& C, const Multiplier& rest_of_equation, Vector& dx, Multiplier& y,
             int rounds) const {
    for (int i = 0; i < unknowns; ++i) dx[i] = Scalar{0};
    y[0] = Scalar{0};
    for (int round = 0; round < rounds; ++round) {
      Vector more;
      Scalar missing = -rest_of_equation[0];
      for (int i = 0; i < unknowns; ++i) {
        Scalar sum = right[i] - C[i] * y[0];
        for (int j = 0; round > 0 && j < unknowns; ++j) sum -= M_[i >= j ? at(i, j) : at(j, i)] * dx[j];
        more[i] = sum;
        missing += C[i] * dx[i];
      }
      substitute(more);
      for (int i = 0; i < unknowns; ++i) missing += C[i] * more[i];
      const Scalar dy = missing / equation_;
      y[0] += dy;
      for (int i = 0; i < unknowns; ++i) dx[i] += more[i] - by_equation_[i] * dy;
    }
  }

 private:
  using Square = std::array<Scalar, static_cast<std::size_t>(unknowns) * unknowns>;

  [[nodiscard]] static constexpr std::size_t at(int i, int j) { return static_cast<std::size_t>(i * unknowns + j); }

  [[nodiscard]] static auto segment(Scalar& first, int size) {
    return Eigen::Map<Eigen::Array<Scalar, Eigen::Dynamic, 1>>(&first, size);
  }

  // M = L D L', L below the diagonal of factor_, 1/D on it.
  [[nodiscard]] bool decompose() {
    factor_ = M_;
    std::array<Scalar, static_cast<std::size_t>(unknowns)> column;
    for (int j = 0; j < unknowns; ++j) {
      if (!(factor_[at(j, j)] > Scalar{0})) return false;
      const Scalar reciprocal = Scalar{1} / factor_[at(j, j)];
      factor_[at(j, j)] = reciprocal;
      for (int i = j + 1; i < unknowns; ++i) {
        column[static_cast<std::size_t>(i)] = factor_[at(i, j)];
        factor_[at(i, j)] *= reciprocal;
        segment(factor_[at(i, j + 1)], i - j) -=
            factor_[at(i, j)] * segment(column[static_cast<std::size_t>(j) + 1], i - j);
      }
    }
    return true;
  }
  void substitute(Vector& b) const {
    for (int i = 1; i < unknowns; ++i) {
      Scalar sum = b[i];
      for (int j = 0; j < i; ++j) sum -= factor_[at(i, j)] * b[j];
      b[i] = sum;
    }
    for (int i = 0; i < unknowns; ++i) b[i] *= factor_[at(i, i)];
    for (int i = unknowns - 1; i > 0; --i) {
      const Scalar solved = b[i];
      for (int j = 0; j < i; ++j) b[j] -= factor_[at(i, j)] * solved;
    }
  }

  Square M_, factor_;
  Vector by_equation_;  // M^-1 C'
  Scalar equation_{0};  // C M^-1 C'
};

/// M = L L' of dynamic size: up to some dozens of unknowns by plain loops, L D L', beyond by Eigen's blocked ones.
template <Real Scalar>
class DynamicFactor {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Block = DynamicBlock<Scalar>;

  /// False where M, of which the lower triangle is read, is not positive definite beyond rounding. It is singular
  /// wherever a combination of the variables is what another does, as P = I is for F(x) - t I.
  [[nodiscard]] bool compute(const Block& M) {
    small_ = M.rows() <= small;
    if (!small_) {
      blocked_.compute(M.matrix());
      return blocked_.info() == Eigen::Success;
    }
    L_ = M;
    const int n = L_.rows(), parts = L_.parts();
    reciprocal_.resize(L_.stride());
    for (int j = 0; j < n; ++j) {
      Scalar* const column = &L_(0, j);
      if (!(column[j] > M(j, j) * least_pivot())) return false;
      const Scalar by_pivot = reciprocal_[j] = Scalar{1} / column[j];
      for (int k = j + 1; k < n; ++k) {
        subtract_column<Scalar>(k / Block::lanes, parts, column, column[k] * by_pivot, &L_(0, k));
      }
      std::fill(column, column + j + 1, Scalar{0});
      for (int i = j + 1; i < n; ++i) column[i] *= by_pivot;
    }
    return true;
  }
  /// M^-1 right
  [[nodiscard]] Vector solve(const Vector& right) const {
    if (!small_) return blocked_.solve(right);
    Vector solution = Vector::Zero(L_.stride());
    solution.head(right.size()) = right;
    substitute(solution);
    solution.conservativeResize(right.size());
    return solution;
  }

 private:
  static constexpr int small = 48;
  static constexpr Scalar least_pivot() { return Scalar{8} * std::numeric_limits<Scalar>::epsilon(); }

  void substitute(Vector& b) const {
    const int n = L_.rows(), parts = L_.parts();
    for (int j = 0; j < n; ++j) subtract_column<Scalar>(j / Block::lanes, parts, &L_(0, j), b[j], b.data());
    for (int j = 0; j < n; ++j) b[j] *= reciprocal_[j];
    for (int j = n; j-- > 0;) b[j] -= product_of_columns<Scalar>(j / Block::lanes, parts, &L_(0, j), b.data());
  }

  Block L_;            // below the diagonal; on and above it zeros
  Vector reciprocal_;  // 1/D
  Eigen::LLT<Matrix> blocked_;
  bool small_ = false;
};

/// Any number of unknowns and equations.
template <Real Scalar>
class SchurSystem<Scalar, Eigen::Dynamic, Eigen::Dynamic> {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  void clear(Eigen::Index unknowns) {
    if (M_.rows() != unknowns) M_ = DynamicBlock<Scalar>(static_cast<int>(unknowns));
    M_.entries().setZero();
  }
  [[nodiscard]] Scalar& operator()(int i, int j) { return M_(i, j); }
  /// For who fills M in, at least that large.
  [[nodiscard]] Scalar* workspace(int size) {
    if (workspace_.size() < size) workspace_.resize(size);
    return workspace_.data();
  }

  [[nodiscard]] bool factorise(const Matrix& C) {
    for (int i = 0; i < M_.rows(); ++i) {
      if (M_(i, i) == Scalar{0}) M_(i, i) = Scalar{1};
    }
    Scalar shift = std::numeric_limits<Scalar>::epsilon();
    bool done = factor_.compute(M_);
    for (int attempt = 0; !done && attempt < 5; ++attempt, shift *= Scalar{256}) {
      DynamicBlock<Scalar> shifted = M_;  // the refinement is of M itself
      shifted.entries().diagonal() *= Scalar{1} + shift;
      done = factor_.compute(shifted);
    }
    if (!done) return false;
    if (C.rows() != 0) {
      by_equations_.resize(C.cols(), C.rows());
      for (Eigen::Index e = 0; e < C.rows(); ++e) by_equations_.col(e) = factor_.solve(C.row(e));
      equations_.compute(C * by_equations_);
    }
    return true;
  }

  void solve(const Vector& right, const Matrix& C, const Vector& rest_of_equations, Vector& dx, Vector& y,
             int rounds) const {
    dx = Vector::Zero(right.size());
    y = Vector::Zero(C.rows());
    for (int round = 0; round < rounds; ++round) {
      Vector rest = right;
      if (round > 0) rest -= M_.matrix().template selfadjointView<Eigen::Lower>() * dx;
      if (C.rows() != 0) rest -= C.transpose() * y;
      Vector more = factor_.solve(rest);
      if (C.rows() != 0) {
        const Vector dy = equations_.solve(C * (dx + more) - rest_of_equations);
        more -= by_equations_ * dy;
        y += dy;
      }
      dx += more;
    }
  }

 private:
  DynamicBlock<Scalar> M_;
  Vector workspace_;
  DynamicFactor<Scalar> factor_;
  Matrix by_equations_;           // M^-1 C'
  Eigen::LLT<Matrix> equations_;  // C M^-1 C'
};

}  // namespace limpid::detail
