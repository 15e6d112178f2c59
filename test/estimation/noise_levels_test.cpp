// SPDX-License-Identifier: MIT
#include <limpid/estimation/noise_levels.hpp>
#include <limpid/estimation/scale_change.hpp>

#include <Eigen/Dense>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using limpid::NoiseLevels;
using limpid::ScaleChange;

TEST_CASE("before anything is seen the variance is the mean over the levels") {
  const NoiseLevels<2> noise({1.0, 3.0}, 0.98);
  CHECK(noise.variance() == doctest::Approx(5.0));
}

TEST_CASE("levels that are doubted weigh less at first, each by the same factor") {
  const NoiseLevels<3> noise({1.0, 2.0, 3.0}, 0.98, 1.5);
  const double d = std::exp(-1.5);
  CHECK(noise.variance() == doctest::Approx((1 + 4 * d + 9 * d * d) / (1 + d + d * d)).epsilon(1e-13));
}

TEST_CASE("one innovation weighs the levels by their densities") {
  NoiseLevels<2> noise({1.0, 3.0}, 1.0);
  noise.observe(0.5, 0.0);
  // densities of N(0, 1) and N(0, 9) at 0.5, but for the common factor
  const double a = std::exp(-0.125), b = std::exp(-0.25 / 18) / 3;
  CHECK(noise.variance() == doctest::Approx((a + 9 * b) / (a + b)).epsilon(1e-13));
}

TEST_CASE("what the prediction itself is unsure of says little of the noise") {
  NoiseLevels<2> noise({0.001, 1.0}, 1.0);
  noise.observe(10.0, 100.0);
  CHECK(noise.variance() == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("the noise of a signal is found among the levels, and a change of it too") {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  NoiseLevels<4> noise({1e-4, 1e-3, 1e-2, 1e-1}, 0.98);
  for (int i = 0; i < 40; ++i) noise.observe(1e-3 * normal(generator), 0.0);
  CHECK(std::sqrt(noise.variance()) == doctest::Approx(1e-3).epsilon(0.01));
  for (int i = 0; i < 40; ++i) noise.observe(1e-1 * normal(generator), 0.0);
  CHECK(std::sqrt(noise.variance()) == doctest::Approx(1e-1).epsilon(0.01));
}

TEST_CASE("the log likelihood is that of a normal distribution of three, but for a constant") {
  Eigen::Matrix3d S;
  S << 4, 1, 0.5, 1, 3, 0.2, 0.5, 0.2, 2;
  const Eigen::Vector3d y(0.3, -1.0, 0.7);
  const double expected = -(y.dot(S.inverse() * y) + std::log(S.determinant())) / 2;
  CHECK(limpid::log_likelihood<double>(S, y) == doctest::Approx(expected).epsilon(1e-13));
}

TEST_CASE("a tissue that is 30 % stiffer at once is noticed at the first sample, one that is not is left alone") {
  ScaleChange<> scale(ScaleChange<>::Settings{});
  const Eigen::Matrix3d S = Eigen::Vector3d(1e-12, 1e-10, 1e-6).asDiagonal();
  const Eigen::Vector3d effect(-1e-3, -1e-2, 2.0);  // of twice the stiffness on x, v and F_e
  const double T = 0.1, quiet = scale.variance(S, Eigen::Vector3d::Zero(), effect, T);
  CHECK(std::sqrt(quiet) < 0.01);
  CHECK(std::sqrt(scale.variance(S, 0.3 * effect, effect, T)) > 0.1);
}
