// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/state_space.hpp>

#include <Eigen/Core>

#include <complex>

namespace limpid {

/// A quotient of polynomials in s, or in z where `period` is not zero. Coefficients run from the highest power to the
/// constant: {2, 0, 5} is 2 s^2 + 5. Off line.
template <Real Scalar = double>
struct TransferFunction {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  Vector numerator;    ///< at most as long as the denominator
  Vector denominator;  ///< the first coefficient not zero
  Scalar period{0};    ///< between samples, s; 0: continuous

  /// @throws std::invalid_argument  where it is improper, has a leading zero below or an entry that is not finite
  void check() const {
    expect(denominator.size() > 0 && is_finite(denominator) && denominator[0] != Scalar{0},
           "TransferFunction: denominator", "finite, with a first coefficient that is not 0", denominator);
    expect(numerator.size() > 0 && numerator.size() <= denominator.size() && is_finite(numerator),
           "TransferFunction: numerator", "finite, with 1 coefficient to as many as the denominator", numerator);
    expect(is_finite(period) && period >= Scalar{0}, "TransferFunction: period", "finite and >= 0", period);
  }

  [[nodiscard]] std::complex<Scalar> operator()(const std::complex<Scalar>& s) const {
    return value(numerator, s) / value(denominator, s);
  }

 private:
  static std::complex<Scalar> value(const Vector& p, const std::complex<Scalar>& s) {
    std::complex<Scalar> sum(Scalar{0});
    for (Eigen::Index i = 0; i < p.size(); ++i) sum = sum * s + p[i];
    return sum;
  }
};

/// Controllable canonical form.
/// @throws std::invalid_argument  where the transfer function is refused
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> state_space(const TransferFunction<Scalar>& G) {
  G.check();
  using Matrix = detail::DynamicMatrix<Scalar>;
  const Eigen::Index n = G.denominator.size() - 1;
  const typename TransferFunction<Scalar>::Vector a = G.denominator / G.denominator[0];
  typename TransferFunction<Scalar>::Vector b = TransferFunction<Scalar>::Vector::Zero(n + 1);
  b.tail(G.numerator.size()) = G.numerator / G.denominator[0];
  StateSpace<Scalar> result{Matrix::Zero(n, n), Matrix::Zero(n, 1), Matrix::Zero(1, n), Matrix::Constant(1, 1, b[0]),
                            G.period};
  if (n == 0) return result;
  result.A.row(0) = -a.tail(n).transpose();
  for (Eigen::Index i = 1; i < n; ++i) result.A(i, i - 1) = Scalar{1};
  result.B(0, 0) = Scalar{1};
  result.C = (b.tail(n) - b[0] * a.tail(n)).transpose();
  return result;
}

/// corner/(s + corner)
/// @throws std::invalid_argument  where the corner, rad/s, is not positive and finite
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> first_order_weight(const Scalar& corner) {
  expect(is_finite(corner) && corner > Scalar{0}, "first_order_weight: corner", "finite and > 0", corner);
  using Matrix = detail::DynamicMatrix<Scalar>;
  return {Matrix::Constant(1, 1, -corner), Matrix::Constant(1, 1, corner), Matrix::Ones(1, 1), Matrix::Zero(1, 1)};
}

}  // namespace limpid
