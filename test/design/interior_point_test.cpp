// SPDX-License-Identifier: MIT
#include <limpid/design/interior_point.hpp>

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace {

using limpid::SdpData;
using limpid::SdpStatus;
using limpid::solve_sdp;

/// max t with A - t I >= 0: the least eigenvalue.
template <typename Scalar>
SdpData<Scalar> least_eigenvalue(const Eigen::Matrix<Scalar, -1, -1>& A) {
  const int n = static_cast<int>(A.rows());
  SdpData<Scalar> data;
  data.block_sizes = {n};
  data.coefficients.resize(1);
  for (int i = 0; i < n; ++i) {
    data.coefficients[0].push_back({0, i, i, Scalar{-1}});
    for (int j = 0; j <= i; ++j) data.constant.push_back({0, i, j, A(i, j)});
  }
  data.objective = SdpData<Scalar>::Vector::Ones(1);
  return data;
}

}  // namespace

TEST_CASE_TEMPLATE("The largest t with A - t I >= 0 is the least eigenvalue", Scalar, double, long double) {
  Eigen::Matrix<Scalar, -1, -1> A(2, 2);
  A << 2, 1, 1, 3;  // (5 - sqrt 5)/2
  const auto result = solve_sdp(least_eigenvalue<Scalar>(A));
  using std::sqrt;
  const Scalar expected = (5 - sqrt(Scalar{5})) / 2;
  CHECK(result.status == SdpStatus::optimal);
  CHECK(std::abs(result.value - expected) < 1e6 * std::numeric_limits<Scalar>::epsilon());  // its tolerance, 65536 eps
  CHECK(std::abs(result.dual_value - expected) < 1e6 * std::numeric_limits<Scalar>::epsilon());
  CHECK(result.value <= result.dual_value);
}

TEST_CASE("Lovasz's number of the pentagon is sqrt 5") {
  // min t with t I + sum over edges x_ij E_ij - J >= 0
  SdpData<double> data;
  data.block_sizes = {5};
  data.coefficients.resize(6);
  for (int i = 0; i < 5; ++i) {
    data.coefficients[0].push_back({0, i, i, 1.0});
    for (int j = 0; j <= i; ++j) data.constant.push_back({0, i, j, -1.0});
    const int next = (i + 1) % 5;
    data.coefficients[static_cast<std::size_t>(i) + 1].push_back({0, std::max(i, next), std::min(i, next), 1.0});
  }
  data.objective = -Eigen::VectorXd::Unit(6, 0);
  const auto result = solve_sdp(data);
  CHECK(result.status == SdpStatus::optimal);
  CHECK(result.value == doctest::Approx(-std::sqrt(5.0)).epsilon(1e-9));
  CHECK(result.gap < 1e-9);
  CHECK(result.residual < 1e-9);
}

TEST_CASE("Equations hold, of blocks of different sizes") {
  // The largest x_1 with [1 x_1; x_1 1 - x_2] >= 0, x_2 >= 0 and x_1 = 3 x_2: x^2 = 1 - x/3, x = (sqrt 37 - 1)/6
  SdpData<double> data;
  data.block_sizes = {2, 1};
  data.coefficients = {{{0, 1, 0, 1.0}}, {{0, 1, 1, -1.0}, {1, 0, 0, 1.0}}};
  data.constant = {{0, 0, 0, 1.0}, {0, 1, 1, 1.0}};
  data.objective = Eigen::Vector2d(1, 0);
  data.equations = Eigen::RowVector2d(1, -3);
  data.right_hand_side = Eigen::VectorXd::Zero(1);
  const auto result = solve_sdp(data);
  CHECK(result.status == SdpStatus::optimal);
  CHECK(result.value == doctest::Approx((std::sqrt(37.0) - 1) / 6).epsilon(1e-9));
  CHECK(std::abs(result.x[0] - 3 * result.x[1]) < 1e-12);
}

TEST_CASE("Both sides agree on random margins") {
  constexpr unsigned seed = 5;
  INFO("seed ", seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    // max t with sum x_i F_i >= t I and tr F(x) = n
    constexpr int variables = 8;
    SdpData<double> data;
    data.block_sizes = {6, 3};
    data.coefficients.resize(variables + 1);
    data.equations = Eigen::MatrixXd::Zero(1, variables + 1);
    for (int v = 0; v < variables; ++v) {
      for (int block = 0; block < 2; ++block) {
        for (int i = 0; i < data.block_sizes[static_cast<std::size_t>(block)]; ++i) {
          for (int j = 0; j <= i; ++j) {
            const double value = normal(random) + (i == j ? 0.5 : 0);
            data.coefficients[static_cast<std::size_t>(v)].push_back({block, i, j, value});
            if (i == j) data.equations(0, v) += value;
          }
        }
      }
    }
    for (int i = 0; i < 6; ++i) data.coefficients.back().push_back({0, i, i, -1.0});
    for (int i = 0; i < 3; ++i) data.coefficients.back().push_back({1, i, i, -1.0});
    data.objective = Eigen::VectorXd::Unit(variables + 1, variables);
    data.right_hand_side = Eigen::VectorXd::Constant(1, 9);
    const auto result = solve_sdp(data);
    CHECK(result.status == SdpStatus::optimal);
    CHECK(std::abs(result.value - result.dual_value) < 1e-8 * (1 + std::abs(result.value)));
    CHECK(result.residual < 1e-9);
  }
}

TEST_CASE("The caller may stop it") {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 3);
  int calls = 0;
  const auto result = solve_sdp(least_eigenvalue<double>(A), limpid::SdpSettings<double>{}, [&](const auto&...) {
    return ++calls == 3 ? SdpStatus::dual_certificate : SdpStatus::optimal;
  });
  CHECK(result.status == SdpStatus::dual_certificate);
  CHECK(result.iterations == 2);
}

TEST_CASE("Hard data end with a status") {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(2, 2);
  auto unbounded = least_eigenvalue<double>(A);  // t I >= -I for every t > 0
  unbounded.coefficients[0][0].value = unbounded.coefficients[0][1].value = 1;
  CHECK(solve_sdp(unbounded).status != SdpStatus::optimal);

  auto infeasible = least_eigenvalue<double>(A);  // -1 >= 0 in a block of its own
  infeasible.block_sizes.push_back(1);
  infeasible.constant.push_back({1, 0, 0, -1.0});
  CHECK(solve_sdp(infeasible).status != SdpStatus::optimal);

  auto huge = least_eigenvalue<double>(A);
  huge.constant[0].value = 1e300;
  CHECK_NOTHROW(static_cast<void>(solve_sdp(huge)));
  auto unused = least_eigenvalue<double>(A);  // a variable in no block
  unused.coefficients.emplace_back();
  unused.objective = Eigen::Vector2d(1, 0);
  CHECK(solve_sdp(unused).value == doctest::Approx(1));
}

TEST_CASE("Data that do not fit are refused") {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(2, 2);
  const auto refused = [&](auto spoil) {
    auto data = least_eigenvalue<double>(A);
    spoil(data);
    CHECK_THROWS_AS(static_cast<void>(solve_sdp(data)), std::invalid_argument);
  };
  refused([](auto& data) { data.coefficients.clear(); });
  refused([](auto& data) { data.objective = Eigen::Vector2d::Ones(); });
  refused([](auto& data) { data.objective[0] = std::nan(""); });
  refused([](auto& data) { data.constant[0].block = 1; });
  refused([](auto& data) { data.constant[0].col = 1; });
  refused([](auto& data) { data.constant[0].value = std::nan(""); });
  refused([](auto& data) { data.right_hand_side = Eigen::VectorXd::Zero(1); });
}
