// SPDX-License-Identifier: MIT
#include <limpid/robot/serial_chain.hpp>

#include "chains.hpp"
#include "support/precision.hpp"
#include "worst.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <cstddef>
#include <limits>

using limpid::SerialChain;
using limpid::test::Fifty, limpid::test::puma_560_settings, limpid::test::puma_560_theta, limpid::test::RandomChains,
    limpid::test::Worst;

namespace {

/// The PUMA 560 with the same numbers, to the last bit of a double, in another scalar.
template <typename Scalar>
SerialChain<6, Scalar> puma() {
  typename SerialChain<6, Scalar>::Settings settings{.links = {}};
  const auto from = puma_560_settings();
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& row = from.links[i];
    settings.links[i] = {
        .alpha = Scalar(row.alpha), .a = Scalar(row.a), .d = Scalar(row.d), .theta = Scalar(row.theta)};
  }
  settings.tip = from.tip.cast<Scalar>();
  settings.gravity = from.gravity.cast<Scalar>();
  return SerialChain<6, Scalar>(settings);
}

/// Torques of random motions by recursion, over 60 N m, against 50 digits.
template <typename Scalar>
Worst torque_errors() {
  RandomChains random(50);
  const auto theta = puma_560_theta();
  Worst worst;
  for (int i = 0; i < 200; ++i) {
    const auto q = random.joints<6, float>(-3, 3), qdot = random.joints<6, float>(-1, 1),
               qdot_r = random.joints<6, float>(-1, 1),
               qddot_r = random.joints<6, float>(-5, 5);  // exact in all scalars
    const auto torque = [&]<typename T>(T) {
      return puma<T>()
          .at(q.template cast<T>())
          .torque(theta.cast<T>(), qdot.template cast<T>(), qdot_r.template cast<T>(), qddot_r.template cast<T>());
    };
    const Eigen::Matrix<Fifty, 6, 1> error = torque(Scalar(0)).template cast<Fifty>() - torque(Fifty(0));
    worst.see(error / Fifty(60), i);
  }
  return worst;
}

}  // namespace

TEST_CASE("torques in double and in float are within tens of roundings of those in 50 digits") {
  const Worst in_double = torque_errors<double>(), in_float = torque_errors<float>();
  CAPTURE(in_double);
  CAPTURE(in_float);
  CHECK(in_double.error() < 20 * std::numeric_limits<double>::epsilon());
  CHECK(in_float.error() < 20 * static_cast<double>(std::numeric_limits<float>::epsilon()));
}
