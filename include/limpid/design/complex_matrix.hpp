// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace limpid {

template <Real Scalar = double>
using ComplexMatrix = Eigen::Matrix<std::complex<Scalar>, Eigen::Dynamic, Eigen::Dynamic>;

}  // namespace limpid

/// The few operations on small complex matrices that the norms need, for every scalar; Eigen's own would cost the
/// compiler most of a minute.
namespace limpid::detail {

template <Real Scalar>
[[nodiscard]] Scalar squared_size(const std::complex<Scalar>& z) {
  return z.real() * z.real() + z.imag() * z.imag();
}

/// The larger of the parts, whose square neither over- nor underflows.
template <Real Scalar>
[[nodiscard]] Scalar largest_part(const std::complex<Scalar>& z) {
  using std::abs;
  return std::max<Scalar>(abs(z.real()), abs(z.imag()));
}

/// a/b without the tests for infinities of the language's own.
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> quotient(const std::complex<Scalar>& a, const std::complex<Scalar>& b) {
  const Scalar unit = largest_part(b), re = b.real() / unit, im = b.imag() / unit, square = re * re + im * im;
  return {(a.real() / square * re + a.imag() / square * im) / unit,
          (a.imag() / square * re - a.real() / square * im) / unit};
}

/// X of A X = B, by elimination with row pivots; not finite where A is singular.
template <Real Scalar>
[[nodiscard]] ComplexMatrix<Scalar> solved(ComplexMatrix<Scalar> A, ComplexMatrix<Scalar> B) {
  const Eigen::Index n = A.rows(), m = B.cols();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i) {
      if (largest_part(A(i, k)) > largest_part(A(pivot, k))) pivot = i;
    }
    for (Eigen::Index j = k; j < n; ++j) std::swap(A(k, j), A(pivot, j));
    for (Eigen::Index j = 0; j < m; ++j) std::swap(B(k, j), B(pivot, j));
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const std::complex<Scalar> part = quotient(A(i, k), A(k, k));
      for (Eigen::Index j = k + 1; j < n; ++j) A(i, j) -= part * A(k, j);
      for (Eigen::Index j = 0; j < m; ++j) B(i, j) -= part * B(k, j);
    }
  }
  for (Eigen::Index j = 0; j < m; ++j) {
    for (Eigen::Index i = n - 1; i >= 0; --i) {
      for (Eigen::Index k = i + 1; k < n; ++k) B(i, j) -= A(i, k) * B(k, j);
      B(i, j) = quotient(B(i, j), A(i, i));
    }
  }
  return B;
}

/// A B, A real
template <Real Scalar>
[[nodiscard]] ComplexMatrix<Scalar> product(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& A,
                                            const ComplexMatrix<Scalar>& B) {
  ComplexMatrix<Scalar> C = ComplexMatrix<Scalar>::Zero(A.rows(), B.cols());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j < B.cols(); ++j) {
      for (Eigen::Index k = 0; k < A.cols(); ++k) C(i, j) += A(i, k) * B(k, j);
    }
  }
  return C;
}

/// The largest singular value and how fast it changes with G, which does by `slope`: sigma' = Re u* G' v.
template <Real Scalar>
struct LargestSingular {
  Scalar value{0};
  Scalar slope{0};
};

/// One-sided Jacobi rotations make the columns of G orthogonal; those of `slope` turn with them. In units of G's
/// largest entry, so that squares neither over- nor underflow.
template <Real Scalar>
[[nodiscard]] LargestSingular<Scalar> largest_singular(ComplexMatrix<Scalar> G, ComplexMatrix<Scalar> slope) {
  using std::abs, std::sqrt;
  using Complex = std::complex<Scalar>;
  constexpr int most_sweeps = 40;
  const auto dot = [](const ComplexMatrix<Scalar>& A, Eigen::Index p, const ComplexMatrix<Scalar>& B, Eigen::Index q) {
    Complex sum(Scalar{0});
    for (Eigen::Index i = 0; i < A.rows(); ++i) sum += Complex(A(i, p).real(), -A(i, p).imag()) * B(i, q);
    return sum;
  };
  Scalar unit{0};
  for (Eigen::Index p = 0; p < G.cols(); ++p) {
    for (Eigen::Index i = 0; i < G.rows(); ++i) {
      if (!is_finite(G(i, p).real()) || !is_finite(G(i, p).imag())) {
        return {std::numeric_limits<Scalar>::infinity(), Scalar{0}};
      }
      unit = std::max<Scalar>(unit, largest_part(G(i, p)));
    }
  }
  if (!(unit > Scalar{0})) return {};
  for (Eigen::Index p = 0; p < G.cols(); ++p) {
    for (Eigen::Index i = 0; i < G.rows(); ++i) G(i, p) = Complex(G(i, p).real() / unit, G(i, p).imag() / unit);
  }
  bool turned = true;
  for (int sweep = 0; turned && sweep < most_sweeps; ++sweep) {
    turned = false;
    for (Eigen::Index p = 0; p < G.cols(); ++p) {
      for (Eigen::Index q = p + 1; q < G.cols(); ++q) {
        const Complex pq = dot(G, p, G, q);
        const Scalar pp = dot(G, p, G, p).real(), qq = dot(G, q, G, q).real(), size = sqrt(squared_size(pq));
        if (!(size > std::numeric_limits<Scalar>::epsilon() * sqrt(pp * qq))) continue;
        turned = true;
        const Scalar zeta = (qq - pp) / (Scalar{2} * size);
        const Scalar t = (zeta < Scalar{0} ? Scalar{-1} : Scalar{1}) / (abs(zeta) + sqrt(Scalar{1} + zeta * zeta));
        const Scalar c = Scalar{1} / sqrt(Scalar{1} + t * t), s = c * t;
        const Complex phase(pq.real() / size, -pq.imag() / size);  // turns column q so that pq is real
        for (ComplexMatrix<Scalar>* M : {&G, &slope}) {
          for (Eigen::Index i = 0; i < M->rows(); ++i) {
            const Complex a = (*M)(i, p), b = (*M)(i, q) * phase;
            (*M)(i, p) = c * a - s * b;
            (*M)(i, q) = s * a + c * b;
          }
        }
      }
    }
  }
  LargestSingular<Scalar> largest;
  for (Eigen::Index p = 0; p < G.cols(); ++p) {
    const Scalar value = sqrt(dot(G, p, G, p).real());
    if (value > largest.value) largest = {value, dot(G, p, slope, p).real() / value};
  }
  return {largest.value * unit, largest.slope};
}

}  // namespace limpid::detail
