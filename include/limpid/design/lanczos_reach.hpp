// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/design/block_matrix.hpp>
#include <limpid/design/dynamic_block.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

/// How far A + alpha dA stays positive definite, from G = A^-1 dA.
namespace limpid::detail {

/// A symmetric tridiagonal matrix.
template <typename Scalar>
struct Tridiagonal {
  static constexpr int most = 12;
  std::array<Scalar, most> diagonal, square_beside;  ///< of the entry after each
  int size = 0;

  /// Laguerre's iteration from below on the characteristic polynomial, whose roots are real: it never passes the
  /// first. To a thousandth.
  [[nodiscard]] Scalar least_eigenvalue() const {
    using std::abs, std::sqrt;
    Scalar x = diagonal[0], before{0};
    for (int i = 0; i < size; ++i) {  // Gershgorin
      const Scalar after = i + 1 < size ? Scalar(sqrt(square_beside[index(i)])) : Scalar{0};
      x = std::min<Scalar>(x, diagonal[index(i)] - before - after);
      before = after;
    }
    x -= abs(x) / Scalar{1000} + std::numeric_limits<Scalar>::min();
    for (int round = 0; round < 12; ++round) {
      Scalar first{0}, second{0};  // sums of 1/(lambda - x) and of its square
      Scalar pivot{1}, slope{0}, curvature{0}, square{0};
      for (int i = 0; i < size; ++i) {  // pivots of T - x I, and their derivatives
        const Scalar by = Scalar{1} / pivot, ratio = square * by * by;
        curvature = ratio * (curvature - Scalar{2} * slope * slope * by);
        slope = ratio * slope - Scalar{1};
        pivot = diagonal[index(i)] - x - square * by;
        const Scalar relative = slope / pivot;
        first -= relative;
        second += relative * relative - curvature / pivot;
        square = square_beside[index(i)];
      }
      const Scalar n = static_cast<Scalar>(size), spread = (n - Scalar{1}) * (n * second - first * first);
      const Scalar step = n / (first + (spread > Scalar{0} ? Scalar(sqrt(spread)) : Scalar{0}));
      if (!(step > Scalar{0}) || !is_finite(step)) break;
      x += step;
      if (step < abs(x) / Scalar{1000}) break;
    }
    return x;
  }

 private:
  [[nodiscard]] static std::size_t index(int i) { return static_cast<std::size_t>(i); }
};

/// By some steps of Lanczos in the inner product of A, in which G is symmetric: the least eigenvalue of G from above,
/// so that the reach may come out a little too long.
template <typename Scalar>
[[nodiscard]] Scalar lanczos_reach(const DynamicBlock<Scalar>& A, const DynamicBlock<Scalar>& G, int steps) {
  using std::sqrt;
  const int n = A.rows();
  steps = std::min({steps, n, Tridiagonal<Scalar>::most});
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> vectors =
      Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>::Zero(A.stride(), 5);
  auto q = vectors.col(0), before = vectors.col(1), Aq = vectors.col(2), w = vectors.col(3), Aw = vectors.col(4);
  const auto multiply_by = [n](const DynamicBlock<Scalar>& matrix, const auto& by, auto& to) {
    for_each_strip(0, matrix.parts(), [&](int first, auto width) {
      const auto column = [&matrix](int k) { return &matrix(0, k); };
      combine_columns<Scalar>(
          first, width, 0, n, column, [&by](int k) { return by[k]; }, to.data());
    });
  };
  for (int i = 0; i < n; ++i) w[i] = static_cast<Scalar>(8 + i * 5 % 7);  // no direction is likelier than another
  multiply_by(A, w, Aw);
  Tridiagonal<Scalar> T;
  Scalar square = w.dot(Aw), beta{0}, largest{0};
  while (T.size < steps && square > largest * std::numeric_limits<Scalar>::epsilon()) {
    const auto step = static_cast<std::size_t>(T.size++);
    if (step > 0) {
      beta = sqrt(square);
      T.square_beside[step - 1] = square;
    }
    const Scalar by_length = Scalar{1} / Scalar(sqrt(square));
    before = q;
    q = w * by_length;
    Aq = Aw * by_length;
    multiply_by(G, q, w);
    T.diagonal[step] = w.dot(Aq);
    w -= T.diagonal[step] * q + beta * before;
    multiply_by(A, w, Aw);
    square = w.dot(Aw);
    largest = std::max<Scalar>(largest, square + T.diagonal[step] * T.diagonal[step]);
  }
  if (T.size == 0) return Scalar{0};
  const Scalar least = T.least_eigenvalue();
  return least < Scalar{-1} / Scalar{1'000'000} ? Scalar{-1} / least : Scalar{1'000'000};
}

/// To a few per cent; without steps and of two rows or less by Laguerre's step, which is a lower bound and then exact.
template <typename Scalar>
[[nodiscard]] Scalar reach_of(const DynamicBlock<Scalar>& A, const DynamicBlock<Scalar>& G, int lanczos_steps) {
  return lanczos_steps == 0 || A.rows() <= 2 ? laguerre_step(G) : lanczos_reach(A, G, lanczos_steps);
}
/// A lower bound.
template <typename E, int n>
[[nodiscard]] auto reach_of(const FixedBlock<E, n>&, const FixedBlock<E, n>& G, int /*lanczos_steps*/) {
  return laguerre_step(G);
}

}  // namespace limpid::detail
