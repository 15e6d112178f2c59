// SPDX-License-Identifier: MIT
// The dynamics at the tip on fewer task axes than there are joints.
#include <limpid/robot/cartesian_dynamics.hpp>
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/omni.hpp>

#include "cartesian_consistency.hpp"
#include "support/no_allocation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::cartesian_dynamics, limpid::FiveBar, limpid::Omni, limpid::Status;
using limpid::test::inconsistency;

TEST_CASE("with fewer axes than joints F is that of the least kinetic energy, for any motion of the joints") {
  const Omni<> omni;
  limpid::TaskDirections<2> axes;
  axes << 1, 0, 0, 0, 0.6, 0.8;
  const auto [two, most] =
      inconsistency<2>(omni, Omni<>::table_5_2(), axes, limpid::test::clear_of_axis<double>(), 65, 1000);
  CHECK(two <= 1e4 * std::numeric_limits<double>::epsilon() * most);
  const FiveBar<> five_bar;
  const auto [one, most1] =
      inconsistency<1>(five_bar, five_bar.theta_of({}), {0.6, 0.8, 0}, five_bar.limits(), 66, 1000);
  CHECK(one <= 1e5 * std::numeric_limits<double>::epsilon() * most1);

  // on one axis M_x = 1 / (J H^-1 J^T), by Cramer's rule
  const Eigen::Vector2d q(1.75, 0.75);
  const auto tip =
      cartesian_dynamics<FiveBar<>, 1>(five_bar, five_bar.theta_of({}), {q, Eigen::Vector2d::Zero()}, {1, 0, 0});
  const Eigen::Matrix2d H = five_bar.at(q).H(five_bar.theta_of({}));
  const Eigen::Vector2d J = five_bar.at(q).jacobian().row(0);
  const double mobility = (H(1, 1) * J[0] * J[0] - 2 * H(0, 1) * J[0] * J[1] + H(0, 0) * J[1] * J[1]) / H.determinant();
  CHECK(tip.M_x(0, 0) == doctest::Approx(1 / mobility).epsilon(1e-13));
}

TEST_CASE("axes that do not span a plane are singular, and a theta without inertia is no body") {
  const Omni<> omni;
  limpid::TaskDirections<2> same;  // axes that do not span a plane
  same << 1, 0, 0, 1, 0, 0;
  const auto tip = cartesian_dynamics<Omni<>, 2>(omni, Omni<>::table_5_2(), {{0.2, 0.7, -1.2}, {1, -1, 1}}, same);
  CHECK(tip.status == Status::singular);
  CHECK(tip.M_x.allFinite());
  const FiveBar<> robot;
  const auto none = cartesian_dynamics<FiveBar<>, 1>(robot, -robot.theta_of({}), {{1.7, 0.7}, {0, 0}});
  CHECK(none.status == Status::not_finite);
}

TEST_CASE("nothing allocates on fewer axes") {
  const Omni<> omni;
  double kept = 0;
  limpid::test::check_no_allocation([&] {
    kept += cartesian_dynamics<Omni<>, 2>(omni, Omni<>::table_5_2(), {{0.2, 0.7, -1.2}, {1, 1, 1}}).M_x.sum();
  });
  CHECK(std::isfinite(kept));
}
