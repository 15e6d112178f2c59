// SPDX-License-Identifier: MIT
#include "eigen_instances.hpp"

#include <limpid/robot/serial_chain.hpp>

#include "chains.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

using limpid::test::puma_560, limpid::test::RandomChains;

TEST_CASE("parameters that carry nothing against gravity or motion do not act, and the others are not told apart") {
  RandomChains random(63);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(66, 66);
  for (int i = 0; i < 100; ++i) {
    const Eigen::MatrixXd phi =
        puma_560()
            .at(random.joints<6>(-3, 3))
            .regressor(random.joints<6>(-1, 1), random.joints<6>(-1, 1), random.joints<6>(-1, 1));
    information += phi.transpose() * phi;
  }
  CHECK(information.diagonal().head<9>().maxCoeff() < 1e-20);  // of link 1 only I_zz acts
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(information);
  const int acting = static_cast<int>((directions.eigenvalues().array() > 1e-9 * directions.eigenvalues()[65]).count());
  CHECK(acting == 36 + 6);  // inertial parameters that act on a PUMA 560, and six frictions
}
