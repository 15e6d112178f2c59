// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

#include <limpid/design/lmi.hpp>
#include <limpid/design/lmi_certificate.hpp>
#include <limpid/design/lmi_dual_certificate.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <cmath>
#include <limits>

using Eigen::MatrixXd;
using Eigen::VectorXd;
using limpid::Ball;
using limpid::certified_upper_bound;
using limpid::certifies_feasible;
using limpid::certifies_infeasible;
using limpid::Lmi;
using limpid::LmiMultipliers;

namespace {

MatrixXd number(double value) { return MatrixXd::Constant(1, 1, value); }
VectorXd vector(double value) { return VectorXd::Constant(1, value); }

// x > low, x < high
Lmi<> between(double low, double high) {
  Lmi<> lmi;
  const auto x = lmi.scalar("x");
  lmi.require(x > low);
  lmi.require(x < high);
  return lmi;
}

}  // namespace

TEST_CASE("a solution is accepted with its margin and not with more") {
  const Lmi<> lmi = between(1, 3);
  CHECK(certifies_feasible<double>(lmi.problem(), vector(2), 0.0));
  CHECK(certifies_feasible<double>(lmi.problem(), vector(2), 1 - 1e-12));
  CHECK(!certifies_feasible<double>(lmi.problem(), vector(2), 1.0));
  CHECK(!certifies_feasible<double>(lmi.problem(), vector(1), 0.0));  // on the border
  CHECK(!certifies_feasible<double>(lmi.problem(), vector(4), 0.0));
  CHECK(!certifies_feasible<double>(lmi.problem(), vector(std::numeric_limits<double>::quiet_NaN()), 0.0));
}

TEST_CASE("what rounding could hide is not accepted") {
  Lmi<> lmi;
  const auto x = lmi.scalar("x"), y = lmi.scalar("y"), z = lmi.scalar("z");
  lmi.require(x + y - z > 0);
  VectorXd values(3);
  values << 1e17, 1, 1e17;  // x + y - z = 1, but the sum rounds at 16
  CHECK(!certifies_feasible<double>(lmi.problem(), values, 0.0));
  values << 1e10, 1, 1e10;
  CHECK(certifies_feasible<double>(lmi.problem(), values, 0.0));
}

TEST_CASE("data that were formed with rounding are covered by their balls") {
  Lmi<> lmi;
  const auto x = lmi.scalar("x");
  lmi.require(Ball<double>(1.0, 0.25) * x > 1.0);  // some factor in [0.75, 1.25]
  CHECK(certifies_feasible<double>(lmi.problem(), vector(1.34), 0.0));
  CHECK(!certifies_feasible<double>(lmi.problem(), vector(1.33), 0.0));
}

TEST_CASE("multipliers that prove infeasibility are accepted, perturbed a little too") {
  const Lmi<> lmi = between(2, 1);
  // 1 (x - 2) + 1 (1 - x) = -1
  CHECK(certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(1), number(1)}}));
  CHECK(certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(1 + 1e-14), number(1)}}));
  // Here the correction could be as large as the first multiplier.
  CHECK(!certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(1), number(4)}}));
}

TEST_CASE("multipliers of a feasible problem are never accepted") {
  const Lmi<> lmi = between(1, 2);
  for (double a = 0; a <= 2; a += 0.125) {
    for (double b = 0; b <= 2; b += 0.125) {
      CHECK(!certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(a), number(b)}}));
    }
  }
  CHECK(!certifies_infeasible(between(2, 1).problem(), LmiMultipliers<double>{{number(-1), number(-1)}}));
  CHECK(!certifies_infeasible(between(2, 1).problem(), LmiMultipliers<double>{{number(1)}}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(!certifies_infeasible(between(2, 1).problem(), LmiMultipliers<double>{{number(nan), number(1)}}));
}

TEST_CASE("an upper bound is above the maximum and moves with the multiplier's residual") {
  Lmi<> bounded;
  const auto x = bounded.scalar("x");
  bounded.require(x > 1);
  bounded.require(x < 3);
  bounded.maximise(x);
  // x + a (x - 1) + b (3 - x) with b = 1 + a: 3 + 2 a
  for (const double a : {1e-9, 0.25, 1.0}) {
    const double bound = certified_upper_bound(bounded.problem(), LmiMultipliers<double>{{number(a), number(1 + a)}});
    CHECK(bound >= 3);
    CHECK(bound == doctest::Approx(3 + 2 * a).epsilon(1e-6));
  }
  const double off = certified_upper_bound(bounded.problem(), LmiMultipliers<double>{{number(0.25), number(1.2)}});
  CHECK(off >= 3);
}

TEST_CASE("a block whose multiplier is exactly zero is left out; all zero prove nothing") {
  Lmi<> lmi;
  const auto x = lmi.scalar("x"), y = lmi.scalar("y");
  lmi.require(x > 2);
  lmi.require(x < 1);
  lmi.require(y > 0);
  CHECK(certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(1), number(1), number(0)}}));
  CHECK(!certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(0), number(0), number(0)}}));
}

TEST_CASE("an objective that is unbounded by less than rounding has no bound") {
  const auto bound = [](double by_x, double by_y) {
    Lmi<> lmi;
    const auto x = lmi.scalar("x"), y = lmi.scalar("y");
    lmi.require(1 - (x + y) > 0);
    lmi.require(1 + (x + y) > 0);
    lmi.maximise(by_x * x + by_y * y);
    return certified_upper_bound(lmi.problem(), LmiMultipliers<double>{{number(1), number(1 + 2.3e-16)}});
  };
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(bound(0, 1e-40) == infinity);  // along y = -x
  CHECK(bound(1e-40, 0) == infinity);
  CHECK(bound(1e-40, 2e-40) == infinity);
}

TEST_CASE("the equation's multiplier takes part") {
  Lmi<> lmi;
  const auto x = lmi.scalar("x");
  lmi.require(x > 0);
  lmi.normalise(x == -1);
  // 1 x + y (x + 1) with y = -1: -1
  CHECK(certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(1)}, -1}));
  CHECK(!certifies_infeasible(lmi.problem(), LmiMultipliers<double>{{number(1)}, 1}));
}
