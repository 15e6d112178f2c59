// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace limpid {
namespace detail {

// By elimination, which needs no pivots for a symmetric positive definite A.
template <int N, Real Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, N, 1> solve_definite(Eigen::Matrix<Scalar, N, N> A,
                                                         Eigen::Matrix<Scalar, N, 1> b) noexcept {
  for (int k = 0; k < N; ++k) {
    for (int i = k + 1; i < N; ++i) {
      const Scalar factor = A(i, k) / A(k, k);
      for (int j = k; j < N; ++j) A(i, j) -= factor * A(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (int k = N - 1; k >= 0; --k) {
    for (int j = k + 1; j < N; ++j) b[k] -= A(k, j) * b[j];
    b[k] /= A(k, k);
  }
  return b;
}

}  // namespace detail

/// The point of the box lower <= theta <= upper nearest to `theta` in the metric of Gamma^-1: (4.47) over a step.
///
/// (4.47) slides along the face that the estimate stands on in the direction Gamma n; over a step that is the
/// projection on the face in the metric of Gamma^-1. Where several faces are active (corners and edges, on which (4.47)
/// is silent) the set of them is found by exchange of the first violated condition, so that theta_tilde' Gamma^-1
/// theta_tilde never grows.
/// @param Gamma  symmetric positive definite
/// @return       inside the box, always
/// @realtime     no allocation, no throw; at most 3^N exchanges (2 N in practice), one solution of order N each
template <int N, Real Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, N, 1> project_on_box(const Eigen::Matrix<Scalar, N, N>& Gamma,
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
    Eigen::Matrix<Scalar, N, N> system = Gamma;
    Column miss = Column::Zero();
    for (int i = 0; i < N; ++i) {
      if (face(i) != Face::none) {
        miss[i] = (face(i) == Face::at_lower ? lower[i] : upper[i]) - theta[i];
        continue;
      }
      system.row(i).setZero();
      system.col(i).setZero();
      system(i, i) = Scalar{1};
    }
    mu = detail::solve_definite<N, Scalar>(system, miss);
    nearest = theta + Gamma * mu;
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

}  // namespace limpid
