// SPDX-License-Identifier: MIT
#include <limpid/estimation/tissue_belief.hpp>
#include <limpid/estimation/tissue_law.hpp>
#include <limpid/estimation/tissue_prior.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace {

using namespace limpid;
using Law = TissueLaw<2, 8, 48>;
using Belief = TissueBelief<Law>;
using State = Law::State;

TissueLearnerSettings<Law> settings() {
  TissueLearnerSettings<Law> s;
  s.mass = 0.1;
  s.knot_spacing = 1e-4;
  return s;
}

Belief belief_about_zero() {
  const auto s = settings();
  Belief belief({s.curvature, s.damping_change, s.most_slope, s.most_damping}, Law(s.law(), 0.0));
  set_prior(belief, s, 0.0, 1.0);
  return belief;
}

// Of the elastic force at a depth.
double variance(const Belief& belief, double x) {
  const auto w = belief.law.knots().at(x);
  State row = State::Zero();
  for (std::size_t k = 0; k < 4; ++k) row[Law::coefficient(w.first + int(k))] += w.value[k];
  return row.dot(belief.P * row);
}

}  // namespace

TEST_CASE("where the knots' spacing doubles a straight law stays, also beyond both ends") {
  Belief belief = belief_about_zero();
  belief.extend(-5e-4, 3.5e-3);
  for (int j = belief.law.knots().low(); j <= belief.law.knots().high(); ++j) {
    belief.s[Law::coefficient(j)] = 0.3 + 800 * j * 1e-4;
  }
  belief.extend(-5e-4, 6e-3);  // 65 knots of .1 mm: more than there are
  CHECK(belief.law.knots().spacing() == doctest::Approx(2e-4));
  for (double x = -2e-3; x < 8e-3; x += 1.7e-4) {
    CHECK(belief.law.elastic(belief.s, x).force == doctest::Approx(0.3 + 800 * x).epsilon(1e-12));
    CHECK(belief.law.elastic(belief.s, x).slope == doctest::Approx(800).epsilon(1e-10));
  }
}

TEST_CASE("a law of four coefficients stays straight where its range grows at once to hundreds of spacings") {
  for (const double about : {0.0, 1e-4, -1e-4, 7e-4}) {
    const auto s = settings();
    Belief belief({s.curvature, s.damping_change, s.most_slope, s.most_damping}, Law(s.law(), about));
    for (int j = belief.law.knots().low(); j <= belief.law.knots().high(); ++j) {
      belief.s[Law::coefficient(j)] = 0.3 + 800 * j * 1e-4;
    }
    belief.extend(-0.03, 0.05);
    for (double x = -0.03; x < 0.05; x += 1.7e-3) {
      CHECK(belief.law.elastic(belief.s, x).force == doctest::Approx(0.3 + 800 * x).epsilon(1e-12));
    }
  }
}

TEST_CASE("what is believed of the force grows with the distance from what was seen") {
  Belief belief = belief_about_zero();
  belief.extend(-1e-3, 3e-3);
  for (double x = 1e-3; x < 2.8e-3; x += 2e-4) CHECK(variance(belief, x + 2e-4) > variance(belief, x));
}

TEST_CASE("P stays symmetric to the last bit where its range grows") {
  Belief belief = belief_about_zero();
  belief.extend(-1e-3, 3e-3);
  CHECK((belief.P - belief.P.transpose()).cwiseAbs().maxCoeff() == 0);
}

TEST_CASE("slopes and dampings that cannot be become physical, and what three measurements say of them stays") {
  const unsigned seed = 11;
  CAPTURE(seed);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Belief belief = belief_about_zero();
  belief.extend(-5e-4, 2e-3);
  const int low = belief.law.knots().low(), high = belief.law.knots().high();
  Belief::Rows H = Belief::Rows::Zero(), PH;
  for (int k = 0; k < 3; ++k) {
    for (int j = low; j <= high; ++j) H(Law::coefficient(j), k) = normal(generator);
    H(Law::damper(0), k) = 0.02 * normal(generator);
  }
  belief.project_rows(H, PH);
  const Eigen::Matrix3d S = H.transpose() * PH + 1e-12 * Eigen::Matrix3d::Identity();
  const Cholesky3<double> factor(S);
  State x = belief.s, u = State::Zero();
  x += belief.P.col(Law::coefficient(high)) - belief.P.col(Law::coefficient(high - 3));  // bent down between
  u[Law::coefficient(high)] += 1;
  u[Law::coefficient(high - 3)] -= 1;
  x -= 0.5 * belief.P.col(Law::damper(0));
  u[Law::damper(0)] -= 0.5;
  REQUIRE(x[Law::damper(0)] < 0);
  const Eigen::Vector3d said = H.transpose() * x;
  belief.keep_physical(x, u, {H, PH, factor});
  CHECK(x[Law::damper(0)] > -1e-6);
  const Eigen::Vector3d then = H.transpose() * x;
  // S holds 1e-12 of noise beside variances of some N^2: what moves is that part of the way
  for (int k = 0; k < 3; ++k) CHECK(then[k] == doctest::Approx(said[k]).epsilon(1e-6).scale(1));
  CHECK((belief.s + belief.P * u - x).cwiseAbs().maxCoeff() < 1e-9);  // roundings of P u, with entries of 1e3
}
