// SPDX-License-Identifier: MIT
#include <limpid/estimation/box_projection.hpp>
#include <limpid/estimation/symmetric_eigenvalues.hpp>

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace {

template <int N>
struct Problem {
  Eigen::Matrix<double, N, N> Gamma, inverse;
  Eigen::Matrix<double, N, 1> theta, lower, upper;

  explicit Problem(std::mt19937& random) {
    std::normal_distribution<double> normal;
    Eigen::Matrix<double, N, N> factor;
    for (auto& entry : factor.reshaped()) entry = normal(random);
    Gamma = factor * factor.transpose() + 0.05 * Eigen::Matrix<double, N, N>::Identity();
    inverse = Gamma.inverse();
    for (int i = 0; i < N; ++i) {
      theta[i] = 3 * normal(random);
      lower[i] = -std::abs(normal(random));
      upper[i] = std::abs(normal(random));
    }
  }

  [[nodiscard]] double cost(const Eigen::Matrix<double, N, 1>& at) const {
    return (at - theta).dot(inverse * (at - theta));
  }

  // The least cost over all points of all faces that lie in the box: 3^N of them.
  [[nodiscard]] double least_by_enumeration() const {
    double least = std::numeric_limits<double>::infinity();
    int faces = 1;
    for (int i = 0; i < N; ++i) faces *= 3;
    for (int code = 0; code < faces; ++code) {
      Eigen::Matrix<double, N, N> system = inverse;
      Eigen::Matrix<double, N, 1> right = inverse * theta;
      for (int i = 0, rest = code; i < N; ++i, rest /= 3) {
        if (rest % 3 == 0) continue;
        system.row(i).setZero();
        system(i, i) = 1;
        right[i] = rest % 3 == 1 ? lower[i] : upper[i];
      }
      const Eigen::Matrix<double, N, 1> at = system.partialPivLu().solve(right);
      const bool inside = (at.array() >= lower.array() - 1e-12).all() && (at.array() <= upper.array() + 1e-12).all();
      if (inside) least = std::min(least, cost(at));
    }
    return least;
  }
};

template <int N>
void check_against_enumeration() {
  std::mt19937 random(47);
  for (int i = 0; i < 2000; ++i) {
    const Problem<N> problem(random);
    CAPTURE(i);
    const auto nearest = limpid::project_on_box<N, double>(problem.Gamma, problem.theta, problem.lower, problem.upper);
    REQUIRE((nearest.array() >= problem.lower.array()).all());
    REQUIRE((nearest.array() <= problem.upper.array()).all());
    // condition up to 1e3 in Gamma and in the enumeration's system
    REQUIRE(problem.cost(nearest) <= problem.least_by_enumeration() * (1 + 1e-9) + 1e-9);
  }
}

}  // namespace

TEST_CASE("the projection is the nearest point of the box, on faces, edges and corners alike") {
  check_against_enumeration<1>();
  check_against_enumeration<2>();
  check_against_enumeration<3>();
  check_against_enumeration<4>();
}

// The box is [0, 1]^2; along the face x = 1 the estimate slides by Gamma_xy / Gamma_xx of the overshoot, (4.47).
TEST_CASE("on a face the estimate slides along Gamma n") {
  Eigen::Matrix2d Gamma;
  Gamma << 4, 1, 1, 2;
  const Eigen::Vector2d nearest =
      limpid::project_on_box<2, double>(Gamma, {3.0, 0.75}, Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones());
  CHECK(nearest[0] == 1.0);
  CHECK(nearest[1] == 0.25);  // 0.75 - 2 * 1 / 4
}

TEST_CASE("eigenvalues of badly scaled matrices keep their digits") {
  // S diag(1, 1e4, 1e8) with an entry beside each pair: eigenvalues from trace, minors and determinant
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (int i = 0; i < 200; ++i) {
    Eigen::Matrix3d C = Eigen::Matrix3d::Identity();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < r; ++c) C(r, c) = C(c, r) = uniform(random);
    }
    const Eigen::Vector3d scale(1, 1e2, 1e4);
    const Eigen::Matrix3d A = scale.asDiagonal() * C * scale.asDiagonal();
    const auto values = limpid::symmetric_eigenvalues<3, double>(A);
    CAPTURE(i);
    // C is diagonally dominant or nearly so: its determinant costs few digits
    REQUIRE(values.prod() == doctest::Approx(C.determinant() * 1e12).epsilon(1e-11));
    REQUIRE(values.sum() == doctest::Approx(A.trace()).epsilon(1e-14));
  }
}
