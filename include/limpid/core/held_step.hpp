// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <limits>

namespace limpid {

/// Exact step of x' = A x + u over h seconds with u held:
///
///     x(t + h) = Phi x(t) + Psi u,     Phi = exp(A h),     Psi = integral of exp(A s), s from 0 to h
template <typename Matrix>
struct HeldStep {
  Matrix Phi, Psi;
};

/// By the power series of Psi over a piece of h short enough, doubled until it spans h; A may be singular. Not finite
/// where the numbers are too large.
/// @realtime  no allocation for fixed sizes, no throw
template <typename Matrix>
[[nodiscard]] HeldStep<Matrix> held_step(const Matrix& A, typename Matrix::Scalar h) noexcept {
  using Scalar = typename Matrix::Scalar;
  constexpr int most_doublings = 2'000;
  const Matrix I = Matrix::Identity(A.rows(), A.cols());
  const Scalar norm = A.cwiseAbs().colwise().sum().maxCoeff(), longest = Scalar{1} / Scalar{2};
  int doublings = 0;
  for (; !(norm * h <= longest) && doublings < most_doublings; ++doublings) h /= Scalar{2};
  if (doublings == most_doublings) h = std::numeric_limits<Scalar>::quiet_NaN();
  const Matrix Ah = A * h;
  // Psi/h = sum (A h)^n/(n + 1)!, whose terms are below 2^-n/(n + 1)!
  Matrix term = I, sum = I;
  Scalar bound{1};
  for (int n = 2; bound > std::numeric_limits<Scalar>::epsilon() / Scalar{8}; ++n) {
    term = Matrix(term.lazyProduct(Ah)) / Scalar(n);  // a product of 1 x 1 would turn into a number
    sum += term;
    bound /= Scalar(2 * n);
  }
  Matrix Psi = sum * h, Phi = I + A.lazyProduct(Psi);
  for (; doublings > 0; --doublings) {
    Psi += Phi.lazyProduct(Psi).eval();
    Phi = Phi.lazyProduct(Phi).eval();
  }
  return {Phi, Psi};
}

}  // namespace limpid
