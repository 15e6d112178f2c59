// SPDX-License-Identifier: MIT
#include <limpid/estimation/largest_eigenvalue.hpp>
#include <limpid/estimation/symmetric_eigenvalues.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using limpid::SymmetricLanes;
using limpid::test::Fifty;

namespace {

template <int N, typename Scalar>
using Four = SymmetricLanes<N, Eigen::Array<Scalar, 4, 1>>;

template <int N, typename Scalar>
void set(Four<N, Scalar>& A, int lane, const Eigen::Matrix<Scalar, N, N>& M) {
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i <= j; ++i) A(i, j)[lane] = M(i, j);
  }
}

/// B B' of random B, its rows over six decades, some matrices as good as singular, some as good as a multiple of 1.
template <int N, typename Scalar>
Eigen::Matrix<Scalar, N, N> random_matrix(std::mt19937& random, int kind) {
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, N, N> B;
  for (int i = 0; i < N; ++i) {
    const double size = std::pow(10, -3 * std::abs(normal(random)));
    for (int j = 0; j < N; ++j) B(i, j) = normal(random) * (kind == 0 ? size : 1);
  }
  if (kind == 1) B.row(1) = B.row(0) * (1 + 1e-9);
  Eigen::Matrix<double, N, N> M = B * B.transpose();
  if (kind == 2) M = Eigen::Matrix<double, N, N>::Identity() + std::pow(10, -8 * std::abs(normal(random))) * M;
  return (M / M.trace()).template cast<Scalar>();
}

/// Largest relative error, in roundings, against rotations in 50 digits.
template <int N, typename Scalar>
double worst_error() {
  constexpr unsigned seed = 29;
  CAPTURE(seed);
  std::mt19937 random(seed);
  double worst = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Four<N, Scalar> A;
    Eigen::Array<Fifty, 4, 1> expected;
    for (int lane = 0; lane < 4; ++lane) {
      const auto M = random_matrix<N, Scalar>(random, (trial + lane) % 4);
      set<N, Scalar>(A, lane, M);
      Eigen::Matrix<Fifty, N, N> exact = M.template cast<Fifty>();
      for (int j = 0; j < N; ++j) {
        for (int i = 0; i < j; ++i) exact(j, i) = exact(i, j);
      }
      expected[lane] = limpid::symmetric_eigenvalues<N, Fifty>(exact).maxCoeff();
    }
    const Eigen::Array<Scalar, 4, 1> largest = limpid::largest_eigenvalue<N>(A);
    for (int lane = 0; lane < 4; ++lane) {
      const double error = static_cast<double>(Fifty(largest[lane]) / expected[lane] - 1);
      worst = std::max(worst, std::abs(error) * 2 / double(std::numeric_limits<Scalar>::epsilon()));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE_TEMPLATE("the largest eigenvalue is right to a few roundings in every lane", Scalar, float, double) {
  CHECK(worst_error<2, Scalar>() <= 4);   // of the two sums, the root and its argument
  CHECK(worst_error<3, Scalar>() <= 16);  // two for each rotation that turns the largest, two of them in four sweeps
  CHECK(worst_error<4, Scalar>() <= 24);  // three of them
}

TEST_CASE("1 and a rank more: the largest eigenvalue is 1 + v' v, in any order of the axes") {
  for (const Eigen::Vector3d& v : {Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(1e-9, 1, -1e-3),
                                   Eigen::Vector3d(3, -4, 5), Eigen::Vector3d(0, 0, 0)}) {
    Four<3, double> A;
    for (int lane = 0; lane < 4; ++lane) set<3, double>(A, lane, Eigen::Matrix3d::Identity() + v * v.transpose());
    CHECK(limpid::largest_eigenvalue<3>(A)[2] == doctest::Approx(1 + v.squaredNorm()).epsilon(2e-15));
  }
}
