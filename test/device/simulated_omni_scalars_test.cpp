// SPDX-License-Identifier: MIT
#include <limpid/device/simulated_omni.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <type_traits>

using limpid::Realism;
using limpid::SimulatedOmni;
using namespace std::chrono_literals;

namespace {

const Eigen::Vector3d start{0.1, 0.8, -1.5};

}  // namespace

TEST_CASE_TEMPLATE("all scalars tell the same story", Scalar, float, long double) {
  SimulatedOmni<Scalar> omni({.q0 = start.cast<Scalar>(), .realism = Realism::realistic});
  SimulatedOmni<> reference({.q0 = start, .realism = Realism::realistic});
  for (int k = 0; k <= 50; ++k) {
    const Eigen::Vector3d F_h(std::sin(0.1 * k), 1, 0);
    (void)omni.advance(k * 1ms, F_h.cast<Scalar>());
    (void)reference.advance(k * 1ms, F_h);
  }
  // 50 steps of the coarser of both tolerances: 2e-6 in float, 1e-10 otherwise
  const double tolerance = std::is_same_v<Scalar, float> ? 1e-4 : 5e-9;
  CHECK((omni.true_state().q.template cast<double>() - reference.true_state().q).norm() < tolerance);
}
