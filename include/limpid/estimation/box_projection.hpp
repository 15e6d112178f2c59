// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace limpid {
namespace detail {

// Some rows of U, orthogonal in the metric of D: rows = T V, T unit upper triangular, V D V' = diagonal S (Gram and
// Schmidt, modified). So rows D rows' = T S T' stays definite where, multiplied out, it would not.
template <int N, Real Scalar>
struct OrthogonalRows {
  Eigen::Matrix<Scalar, N, N> V, T;
  Eigen::Matrix<Scalar, N, 1> S;

  template <typename Taken>
  OrthogonalRows(const Eigen::Matrix<Scalar, N, N>& U, const Eigen::Matrix<Scalar, N, 1>& D, Taken taken) noexcept
      : V{U}, T{Eigen::Matrix<Scalar, N, N>::Identity()}, S{Eigen::Matrix<Scalar, N, 1>::Ones()} {
    for (int i = N - 1; i >= 0; --i) {
      if (!taken(i)) {
        V.row(i).setZero();
        continue;
      }
      const Eigen::Matrix<Scalar, N, 1> weighted = D.cwiseProduct(V.row(i).transpose());
      S[i] = V.row(i).dot(weighted);
      for (int j = 0; j < i; ++j) {
        if (!taken(j)) continue;
        T(j, i) = V.row(j).dot(weighted) / S[i];
        V.row(j) -= T(j, i) * V.row(i);
      }
    }
  }

  // T' mu of T S T' mu = b
  [[nodiscard]] Eigen::Matrix<Scalar, N, 1> transposed_multipliers(Eigen::Matrix<Scalar, N, 1> b) const noexcept {
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) b[i] -= T(i, j) * b[j];
    }
    return b.cwiseQuotient(S);
  }
  // mu of z = T' mu
  [[nodiscard]] Eigen::Matrix<Scalar, N, 1> multipliers(Eigen::Matrix<Scalar, N, 1> z) const noexcept {
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < i; ++j) z[i] -= T(j, i) * z[j];
    }
    return z;
  }
};

// Gamma = U D U', U unit upper triangular.
template <int N, Real Scalar>
void factorise(Eigen::Matrix<Scalar, N, N> Gamma, Eigen::Matrix<Scalar, N, N>& U,
               Eigen::Matrix<Scalar, N, 1>& D) noexcept {
  U.setIdentity();
  for (int k = N - 1; k >= 0; --k) {
    D[k] = Gamma(k, k);
    for (int i = 0; i < k; ++i) U(i, k) = Gamma(i, k) / D[k];
    for (int i = 0; i < k; ++i) {
      for (int j = 0; j < k; ++j) Gamma(i, j) -= U(i, k) * D[k] * U(j, k);
    }
  }
}

}  // namespace detail

/// The point of the box lower <= theta <= upper nearest to `theta` in the metric of Gamma^-1: (4.47) over a step.
///
/// (4.47) slides along the face that the estimate stands on in the direction Gamma n; over a step that is the
/// projection on the face in the metric of Gamma^-1. Where several faces are active (corners and edges, on which (4.47)
/// is silent) the set of them is found by exchange of the first violated condition, so that theta_tilde' Gamma^-1
/// theta_tilde never grows.
/// @param U, D  of Gamma = U D U': U unit upper triangular, D positive
/// @return      inside the box, always
/// @realtime    no allocation, no throw; at most 3^N exchanges (2 N in practice), one factorisation of order N each
template <int N, Real Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, N, 1> project_on_box(const Eigen::Matrix<Scalar, N, N>& U,
                                                         const Eigen::Matrix<Scalar, N, 1>& D,
                                                         const Eigen::Matrix<Scalar, N, 1>& theta,
                                                         const Eigen::Matrix<Scalar, N, 1>& lower,
                                                         const Eigen::Matrix<Scalar, N, 1>& upper) noexcept {
  using Column = Eigen::Matrix<Scalar, N, 1>;
  enum class Face { none, at_lower, at_upper };
  std::array<Face, N> active{};
  const auto face = [&active](int i) -> Face& { return active[static_cast<std::size_t>(i)]; };

  // theta + Gamma mu with mu = 0 on the free entries; on the faces mu is what brings theta there.
  Column mu = Column::Zero(), nearest = theta;
  const auto solve = [&] {
    const detail::OrthogonalRows<N, Scalar> rows(U, D, [&](int i) { return face(i) != Face::none; });
    Column miss = Column::Zero();
    for (int i = 0; i < N; ++i) {
      if (face(i) != Face::none) miss[i] = (face(i) == Face::at_lower ? lower[i] : upper[i]) - theta[i];
    }
    const Column z = rows.transposed_multipliers(miss);
    mu = rows.multipliers(z);
    nearest = theta + U * D.cwiseProduct(rows.V.transpose() * z);
    for (int i = 0; i < N; ++i) {
      if (face(i) != Face::none) nearest[i] = face(i) == Face::at_lower ? lower[i] : upper[i];
    }
  };
  const auto exchange_first_violated = [&] {
    for (int i = 0; i < N; ++i) {
      Face better = face(i);
      if (face(i) == Face::none) {
        if (nearest[i] < lower[i]) better = Face::at_lower;
        if (nearest[i] > upper[i]) better = Face::at_upper;
      } else if (face(i) == Face::at_lower ? mu[i] < Scalar{0} : mu[i] > Scalar{0}) {
        better = Face::none;
      }
      if (better == face(i)) continue;
      face(i) = better;
      return true;
    }
    return false;
  };

  int most_exchanges = 1;
  for (int i = 0; i < N; ++i) most_exchanges *= 3;
  for (int i = 0; i < most_exchanges && exchange_first_violated(); ++i) solve();
  return nearest.cwiseMax(lower).cwiseMin(upper);
}

/// The same of Gamma itself, symmetric positive definite.
template <int N, Real Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, N, 1> project_on_box(const Eigen::Matrix<Scalar, N, N>& Gamma,
                                                         const Eigen::Matrix<Scalar, N, 1>& theta,
                                                         const Eigen::Matrix<Scalar, N, 1>& lower,
                                                         const Eigen::Matrix<Scalar, N, 1>& upper) noexcept {
  Eigen::Matrix<Scalar, N, N> U;
  Eigen::Matrix<Scalar, N, 1> D;
  detail::factorise<N, Scalar>(Gamma, U, D);
  return project_on_box<N, Scalar>(U, D, theta, lower, upper);
}

}  // namespace limpid
