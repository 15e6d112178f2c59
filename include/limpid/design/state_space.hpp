// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace limpid {

/// A linear system of any size, continuous where `period` is zero, else discrete:
///
///     x' = A x + B u,   y = C x + D u         x[k+1] = A x[k] + B u[k],   y[k] = C x[k] + D u[k]
///
/// Without states A is 0 x 0, B 0 x inputs, C outputs x 0. Off line.
template <Real Scalar = double>
struct StateSpace {
  using Matrix = detail::DynamicMatrix<Scalar>;

  Matrix A;          ///< order x order
  Matrix B;          ///< order x inputs
  Matrix C;          ///< outputs x order
  Matrix D;          ///< outputs x inputs
  Scalar period{0};  ///< between samples, s; 0: continuous

  [[nodiscard]] Eigen::Index order() const { return A.rows(); }
  [[nodiscard]] Eigen::Index inputs() const { return D.cols(); }
  [[nodiscard]] Eigen::Index outputs() const { return D.rows(); }
  [[nodiscard]] bool is_discrete() const { return period > Scalar{0}; }

  /// @throws std::invalid_argument  where the sizes do not fit, an entry is not finite or the period negative
  void check() const {
    const auto size = [](const Matrix& M) {
      return Eigen::Vector2i(static_cast<int>(M.rows()), static_cast<int>(M.cols()));
    };
    expect(A.rows() == A.cols(), "StateSpace: A", "order x order", size(A));
    expect(D.rows() > 0 && D.cols() > 0, "StateSpace: D", "outputs x inputs, at least 1 x 1", size(D));
    expect(B.rows() == A.rows() && B.cols() == D.cols(), "StateSpace: B", "order x inputs", size(B));
    expect(C.rows() == D.rows() && C.cols() == A.rows(), "StateSpace: C", "outputs x order", size(C));
    expect(is_finite(A), "StateSpace: A", "finite", A);
    expect(is_finite(B), "StateSpace: B", "finite", B);
    expect(is_finite(C), "StateSpace: C", "finite", C);
    expect(is_finite(D), "StateSpace: D", "finite", D);
    expect(is_finite(period) && period >= Scalar{0}, "StateSpace: period", "finite and >= 0", period);
  }
};

/// y = D u
/// @throws std::invalid_argument  where D is empty or not finite
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> static_gain(const detail::DynamicMatrix<Scalar>& D, const Scalar& period = Scalar{0}) {
  using Matrix = detail::DynamicMatrix<Scalar>;
  const StateSpace<Scalar> G{Matrix(0, 0), Matrix(0, D.cols()), Matrix(D.rows(), 0), D, period};
  G.check();
  return G;
}

namespace detail {

template <Real Scalar>
void expect_connectable(const StateSpace<Scalar>& first, const StateSpace<Scalar>& second) {
  first.check();
  second.check();
  expect(first.period == second.period, "StateSpace: period", "the same in both systems", second.period);
}

/// [[P, Q], [R, S]]
template <Real Scalar>
[[nodiscard]] DynamicMatrix<Scalar> blocks(const DynamicMatrix<Scalar>& P, const DynamicMatrix<Scalar>& Q,
                                           const DynamicMatrix<Scalar>& R, const DynamicMatrix<Scalar>& S) {
  DynamicMatrix<Scalar> M(P.rows() + R.rows(), P.cols() + Q.cols());
  M.topLeftCorner(P.rows(), P.cols()) = P;
  M.topRightCorner(Q.rows(), Q.cols()) = Q;
  M.bottomLeftCorner(R.rows(), R.cols()) = R;
  M.bottomRightCorner(S.rows(), S.cols()) = S;
  return M;
}

/// diag(d)^-1 A diag(d), diag(d)^-1 B, C diag(d): the same system in states of like size, with B and C of like size.
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> balanced_states(const StateSpace<Scalar>& G) {
  const DynamicVector<Scalar> d = balancing<Scalar>(G.A), inverse = d.cwiseInverse();
  StateSpace<Scalar> same{inverse.asDiagonal() * G.A * d.asDiagonal(), inverse.asDiagonal() * G.B, G.C * d.asDiagonal(),
                          G.D, G.period};
  if (same.B.isZero(Scalar{0}) || same.C.isZero(Scalar{0})) return same;
  Scalar B = same.B.cwiseAbs().maxCoeff(), C = same.C.cwiseAbs().maxCoeff(), factor{1};
  if (!is_finite(B) || !is_finite(C)) return same;
  for (; B < C / Scalar{4}; factor *= Scalar{2}) B *= Scalar{2}, C /= Scalar{2};
  for (; C < B / Scalar{4}; factor /= Scalar{2}) C *= Scalar{2}, B /= Scalar{2};
  same.B *= factor;
  same.C /= factor;
  return same;
}

/// M^-1, M with rows of any units; empty where M is singular to within rounding or its numbers are too large.
template <Real Scalar>
[[nodiscard]] DynamicMatrix<Scalar> inverse_of(const DynamicMatrix<Scalar>& M) {
  const DynamicVector<Scalar> size = M.cwiseAbs().rowwise().maxCoeff(), per_size = size.cwiseInverse();
  if (!is_finite(M) || !is_finite(per_size)) return {};
  const Eigen::FullPivLU<DynamicMatrix<Scalar>> lu(DynamicMatrix<Scalar>(per_size.asDiagonal() * M));
  if (!lu.isInvertible()) return {};
  return lu.inverse() * per_size.asDiagonal();
}

template <Real Scalar>
[[nodiscard]] DynamicMatrix<Scalar> zeros(Eigen::Index rows, Eigen::Index columns) {
  return DynamicMatrix<Scalar>::Zero(rows, columns);
}

}  // namespace detail

/// y = second(first(u)); states of the first, then of the second.
/// @throws std::invalid_argument  where the systems do not fit together
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> series(const StateSpace<Scalar>& first, const StateSpace<Scalar>& second) {
  using detail::blocks, detail::DynamicMatrix;
  detail::expect_connectable(first, second);
  expect(second.inputs() == first.outputs(), "series: second", "as many inputs as the first has outputs",
         second.inputs());
  const auto& [A1, B1, C1, D1, period] = first;
  const auto& [A2, B2, C2, D2, same] = second;
  const DynamicMatrix<Scalar> B = blocks<Scalar>(B1, {B1.rows(), 0}, B2 * D1, {B2.rows(), 0});
  const DynamicMatrix<Scalar> C = blocks<Scalar>(D2 * C1, C2, {0, C1.cols()}, {0, C2.cols()});
  return {blocks<Scalar>(A1, detail::zeros<Scalar>(A1.rows(), A2.cols()), B2 * C1, A2), B, C, D2 * D1, period};
}

/// y = first(u) + second(u)
/// @throws std::invalid_argument  where the systems do not fit together
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> parallel(const StateSpace<Scalar>& first, const StateSpace<Scalar>& second) {
  using detail::blocks, detail::DynamicMatrix;
  detail::expect_connectable(first, second);
  expect(second.inputs() == first.inputs(), "parallel: second", "as many inputs as the first", second.inputs());
  expect(second.outputs() == first.outputs(), "parallel: second", "as many outputs as the first", second.outputs());
  const auto& [A1, B1, C1, D1, period] = first;
  const auto& [A2, B2, C2, D2, same] = second;
  const DynamicMatrix<Scalar> B = blocks<Scalar>(B1, {B1.rows(), 0}, B2, {B2.rows(), 0});
  const DynamicMatrix<Scalar> C = blocks<Scalar>(C1, C2, {0, C1.cols()}, {0, C2.cols()});
  return {
      blocks<Scalar>(A1, detail::zeros<Scalar>(A1.rows(), A2.cols()), detail::zeros<Scalar>(A2.rows(), A1.cols()), A2),
      B, C, D1 + D2, period};
}

/// factor G
/// @throws std::invalid_argument  where the factor is not finite or the system refused
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> scaled(const StateSpace<Scalar>& G, const Scalar& factor) {
  G.check();
  expect(is_finite(factor), "scaled: factor", "finite", factor);
  return {G.A, G.B, G.C * factor, G.D * factor, G.period};
}

/// Negative feedback, y = G(u - H(y)): (I + G H)^-1 G.
/// @throws std::invalid_argument  where the systems do not fit together, or I + D_H D_G is singular
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> feedback(const StateSpace<Scalar>& G, const StateSpace<Scalar>& H) {
  using Matrix = detail::DynamicMatrix<Scalar>;
  detail::expect_connectable(G, H);
  expect(H.inputs() == G.outputs(), "feedback: H", "as many inputs as G has outputs", H.inputs());
  expect(H.outputs() == G.inputs(), "feedback: H", "as many outputs as G has inputs", H.outputs());
  const Matrix loop = Matrix::Identity(G.inputs(), G.inputs()) + H.D * G.D, E = detail::inverse_of<Scalar>(loop);
  expect(E.size() > 0, "feedback: I + D_H D_G", "invertible", loop);
  // e = u - H(y) = E (u - C_H x_H - D_H C_G x_G),   y = C_G x_G + D_G e
  const Matrix from_G = -E * H.D * G.C, from_H = -E * H.C;
  const Matrix C_G = G.C + G.D * from_G, C_H = G.D * from_H, D = G.D * E;
  return {detail::blocks<Scalar>(G.A + G.B * from_G, G.B * from_H, H.B * C_G, H.A + H.B * C_H),
          detail::blocks<Scalar>(G.B * E, {G.order(), 0}, H.B * D, {H.order(), 0}),
          detail::blocks<Scalar>(C_G, C_H, {0, G.order()}, {0, H.order()}), D, G.period};
}

/// Eigenvalues of A, 1/s or of z; empty without states, or where the entries are too large to tell.
/// @throws std::invalid_argument  where the system is refused
template <Real Scalar>
[[nodiscard]] std::vector<std::complex<Scalar>> poles(const StateSpace<Scalar>& G) {
  G.check();
  return detail::eigenvalues_of<Scalar>(G.A);
}

/// Largest real part of the poles (continuous), 1/s, or largest magnitude less one (discrete): negative where stable.
/// Minus infinity or -1 without states; infinite where the entries are too large to tell.
/// @throws std::invalid_argument  where the system is refused
template <Real Scalar>
[[nodiscard]] Scalar stability_excess(const StateSpace<Scalar>& G) {
  using std::abs, std::sqrt;
  const auto values = poles(G);
  const Scalar infinity = std::numeric_limits<Scalar>::infinity();
  if (values.empty() && G.order() > 0) return infinity;
  Scalar most = G.is_discrete() ? Scalar{-1} : Scalar(-infinity);
  for (const auto& p : values) {
    const Scalar excess =
        G.is_discrete() ? Scalar(sqrt(p.real() * p.real() + p.imag() * p.imag()) - Scalar{1}) : p.real();
    most = std::max<Scalar>(most, excess);
  }
  return most;
}

/// Whether every pole is in the open left half plane or unit disc, by more than the rounding of the poles.
/// @throws std::invalid_argument  where the system is refused
template <Real Scalar>
[[nodiscard]] bool is_stable(const StateSpace<Scalar>& G) {
  const Scalar excess = stability_excess(G);
  if (G.order() == 0) return true;
  const Scalar size = detail::largest_row(detail::balanced<Scalar>(G.A));
  return excess < -Scalar{4} * std::numeric_limits<Scalar>::epsilon() * size;
}

}  // namespace limpid
