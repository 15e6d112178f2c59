// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/delay_stability.hpp>
#include <limpid/design/design_point.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace limpid {

namespace detail {

/// Derivative at the Chebyshev points cos(pi j / points) of the polynomial through values there.
template <Real Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> chebyshev_derivative(int points) {
  using std::acos, std::cos;
  const Scalar pi = acos(Scalar{-1});
  const auto x = [&](int j) { return cos(pi * Scalar(j) / Scalar(points)); };
  const auto c = [&](int j) { return Scalar(j % 2 == 0 ? 1 : -1) * Scalar(j == 0 || j == points ? 2 : 1); };
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> D(points + 1, points + 1);
  for (int i = 0; i <= points; ++i) {
    D(i, i) = Scalar{0};
    for (int j = 0; j <= points; ++j) {
      if (i != j) D(i, j) = c(i) / (c(j) * (x(i) - x(j)));
    }
    D(i, i) = -D.row(i).sum();
  }
  return D;
}

}  // namespace detail

/// The roots of the delay system with the largest real parts, from the right, one of each pair: eigenvalues of the
/// generator of its semigroup, d/dtheta on [-delay, 0] with the equation as its condition at 0, collocated at Chebyshev
/// points (D. Breda, S. Maset, R. Vermiglio, SIAM J. Sci. Comput. 27, 2005); each polished on the characteristic
/// equation. Roots with |s| delay above some half of the points are not resolved, and may be missing.
///
/// `rightmost_delay_root` needs no such care and is far faster; this shows what lies beside it.
/// Off line: some 0.5 ms with 32 points; the system's delay > 0.
/// @throws std::invalid_argument  where an argument is not finite, the system refused or there are fewer than 4 points
template <Real Scalar>
[[nodiscard]] std::vector<std::complex<Scalar>> collocated_delay_roots(const DelaySystem<Scalar>& system,
                                                                       const Tissue<Scalar>& tissue,
                                                                       const Gain<Scalar>& L, int points = 32) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Complex = std::complex<Scalar>;
  const auto f = detail::characteristic_of(system, tissue, L);
  expect(system.delay > Scalar{0}, "collocated_delay_roots: delay", "> 0", system.delay);
  expect(points >= 4 && points <= 256, "collocated_delay_roots: points", "4 to 256", points);
  const Matrix D = detail::chebyshev_derivative<Scalar>(points) * (Scalar{2} / f.delay);
  // Position and velocity at each point, that of theta = 0 first.
  const Eigen::Index last = Eigen::Index{2} * points;
  Matrix A = Matrix::Zero(last + 2, last + 2);
  A(0, 1) = Scalar{1};
  A(1, 0) = -f.kappa;
  A(1, 1) = -f.beta;
  A(1, last) = f.l1;
  A(1, last + 1) = f.l2;
  for (Eigen::Index i = 1; i <= points; ++i) {
    for (Eigen::Index j = 0; j <= points; ++j) A(2 * i, 2 * j) = A(2 * i + 1, 2 * j + 1) = D(i, j);
  }
  const Eigen::EigenSolver<Matrix> solver(A, false);
  std::vector<Complex> roots;
  if (solver.info() != Eigen::Success) return roots;
  for (const Complex& guess : solver.eigenvalues()) {
    Complex s = guess;
    for (int i = 0; i < 12; ++i) s -= f.value(s) / f.derivative(s);
    const bool stayed = std::abs(s - guess) <= std::abs(guess) / Scalar{100};
    if (stayed && !(s.imag() < Scalar{0})) roots.push_back(s);
  }
  std::sort(roots.begin(), roots.end(), [](const Complex& l, const Complex& r) { return l.real() > r.real(); });
  return roots;
}

}  // namespace limpid
