// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"
#include "sampled_instances.hpp"

#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/sampled_varying.hpp>

#include <Eigen/Cholesky>

#include <doctest/doctest.h>

#include <stdexcept>

using limpid::Gain;
using limpid::prove_varying_stability;
using limpid::SampledStability;
using limpid::SampledSystem;
using limpid::Verdict;
using limpid::test::tool;

namespace {

const auto& box = limpid::test::box;

}  // namespace

TEST_CASE("a quadratic function serves tissues that change from sample to sample") {
  // The notes' robust gains, a printed one, and none.
  struct {
    double T;
    Gain<double> L;
  } const designs[] = {{0.016, {-536, -3.18}}, {0.032, {-240, -1.73}},   {0.1, {-39.1, 0.196}},
                       {0.2, {-8.46, 0.13}},   {0.016, {-194.8, -4.89}}, {0.1, {0, 0}}};
  for (const auto& design : designs) {
    CAPTURE(design.T);
    const SampledSystem<double> system{tool, design.T, design.T};
    const auto proof = prove_varying_stability(system, box, design.L);
    REQUIRE(proof.proved());
    const Eigen::Matrix3d P = proof.P;
    REQUIRE(Eigen::LLT<Eigen::Matrix3d>(P).info() == Eigen::Success);
    const SampledStability<double> stability(system);
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j <= 10; ++j) {
        const Eigen::Matrix3d M = stability.monodromy({200 + 180.0 * i, 20 + 2.0 * j}, design.L);
        CHECK(Eigen::LLT<Eigen::Matrix3d>(P - M.transpose() * P * M).info() == Eigen::Success);
      }
    }
  }
}

TEST_CASE("what is unstable for a constant tissue has no common quadratic function, nor what is asked too much") {
  const SampledSystem<double> system{tool, 1.0 / 60, 1.0 / 60};
  CHECK(prove_varying_stability(system, box, {-753.2, -17.01}).verdict == Verdict::infeasible);
  const SampledSystem<double> good{tool, 0.016, 0.016};
  const auto close = prove_varying_stability(good, box, {-536, -3.18}, 0.634);
  CHECK(close.verdict == Verdict::undecided);
  CHECK_FALSE(close.reason.empty());
}

TEST_CASE("a delay of too many periods is refused") {
  CHECK_THROWS_AS((void)prove_varying_stability({tool, 0.016, 0.1}, box, Gain<double>(0, 0)), std::invalid_argument);
}
