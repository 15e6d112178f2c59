// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_problem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace limpid::detail {

/// Scales of unknowns and of the rows of blocks by powers of two, so that all coefficients are about 1 in size. Whether
/// there is a solution does not change, nor is anything rounded.
///
///     x_i = s_i x^_i,    F^_j = D_j F_j D_j,    Z_j = D_j Z^_j D_j
template <Real Scalar>
class LmiScaling {
 public:
  using Problem = LmiProblem<Scalar>;
  using Term = typename Problem::Term;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// @param homogenise  whether the constant part has an unknown, with a scale, of its own
  LmiScaling(const Problem& problem, bool homogenise) : problem_{problem}, homogenised_{homogenise} {
    scale();
    equation_scale_ = Scalar{1} / power_of_two(largest(problem.equation));
    objective_scale_ = Scalar{1} / power_of_two(largest(problem.objective));
  }

  /// s_i; of the constant part where `unknown` is that.
  [[nodiscard]] const Scalar& unknown(int unknown) const {
    return unknown == constant ? constant_scale_ : scale_[static_cast<std::size_t>(unknown)];
  }
  [[nodiscard]] const std::vector<Vector>& rows() const { return D_; }        ///< D_j
  [[nodiscard]] const Scalar& equation() const { return equation_scale_; }    ///< times c and d
  [[nodiscard]] const Scalar& objective() const { return objective_scale_; }  ///< times b

  /// Of a term in F^_j.
  [[nodiscard]] Scalar value(const Term& term, std::size_t block) const {
    return term.factor.centre() * unknown(term.unknown) * D_[block][term.row] * D_[block][term.column];
  }
  /// Z_j of Z^_j.
  [[nodiscard]] Matrix unscale(std::size_t block, const Matrix& Z) const {
    return D_[block].asDiagonal() * Z * D_[block].asDiagonal();
  }

 private:
  static constexpr int constant = LmiExpression<Scalar>::constant;

  static Scalar power_of_two(const Scalar& size) {
    using std::frexp, std::ldexp;
    if (!(size > Scalar{0}) || !is_finite(size)) return Scalar{1};
    int exponent = 0;
    const Scalar mantissa = frexp(size, &exponent);
    return ldexp(Scalar{1}, mantissa * mantissa * Scalar{2} < Scalar{1} ? exponent - 1 : exponent);
  }

  // Unknowns to coefficients of norm 1, rows to a largest entry of 1, in turns.
  void scale() {
    using std::abs, std::sqrt;
    scale_.assign(static_cast<std::size_t>(problem_.unknowns), Scalar{1});
    for (const auto& block : problem_.blocks) D_.push_back(Vector::Ones(block.size));
    bool settled = false;
    for (int sweep = 0; sweep < most_sweeps && !settled; ++sweep) {
      settled = true;
      std::vector<Scalar> squares(scale_.size(), Scalar{0});
      Scalar constant_square{0};
      for_each_value([&](const Term& term, std::size_t, const Scalar& size) {
        (term.unknown == constant ? constant_square : squares[static_cast<std::size_t>(term.unknown)]) += size * size;
      });
      for (std::size_t i = 0; i < squares.size(); ++i) scale_[i] /= power_of_two(sqrt(squares[i]));
      if (homogenised_) constant_scale_ /= power_of_two(sqrt(constant_square));
      if (sweep + 1 == most_sweeps) break;
      std::vector<Vector> largest;
      for (const Vector& D : D_) largest.push_back(Vector::Zero(D.size()));
      for_each_value([&](const Term& term, std::size_t j, const Scalar& size) {
        for (const int row : {term.row, term.column}) largest[j][row] = std::max<Scalar>(largest[j][row], size);
      });
      for (std::size_t j = 0; j < D_.size(); ++j) {
        for (Eigen::Index row = 0; row < D_[j].size(); ++row) {
          const Scalar by = power_of_two(sqrt(largest[j][row]));
          settled = settled && by == Scalar{1};
          D_[j][row] /= by;
        }
      }
    }
  }
  [[nodiscard]] Scalar largest(const std::vector<Term>& row) const {
    using std::abs;
    Scalar size{0};
    for (const Term& term : row) size = std::max<Scalar>(size, abs(term.factor.centre() * unknown(term.unknown)));
    return size;
  }
  template <typename F>
  void for_each_value(F&& f) const {
    using std::abs;
    for (std::size_t j = 0; j < problem_.blocks.size(); ++j) {
      for (const Term& term : problem_.blocks[j].terms) f(term, j, Scalar(abs(value(term, j))));
    }
  }

  // More would let rows drift: they have no scale of their own, only beside the unknowns'.
  static constexpr int most_sweeps = 4;

  const Problem& problem_;
  bool homogenised_;
  std::vector<Scalar> scale_;  // s_i
  Scalar constant_scale_{1};
  std::vector<Vector> D_;
  Scalar equation_scale_{1}, objective_scale_{1};
};

}  // namespace limpid::detail
