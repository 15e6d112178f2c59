// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/robot/omni.hpp>

#include <Eigen/Core>

#include <cmath>
#include <random>

namespace limpid::test {

struct OmniState {
  Eigen::Vector3d q, qdot, qddot;
};

/// Random motions at poses inside Table 5.1, (5.4), the smallest radius and the largest reach.
class OmniStates {
 public:
  explicit OmniStates(unsigned seed) : random_{seed} {}

  OmniState operator()() {
    const auto limits = robot_.limits();
    OmniState state;
    do {
      for (int i = 0; i < 3; ++i) state.q[i] = uniform(limits.lower[i], limits.upper[i]);
    } while (!inside(state.q));
    for (int i = 0; i < 3; ++i) {
      state.qdot[i] = uniform(-5, 5);
      state.qddot[i] = uniform(-50, 50);
    }
    return state;
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  bool inside(const Eigen::Vector3d& q) const {
    const Eigen::Vector3d x = robot_.at(q).position();
    const double r =
        robot_.link2() * std::cos(q[1]) + robot_.link3() * std::cos(q[1] + q[2]);  // negative behind the axis
    return q[1] + q[2] <= Omni<>::elbow_sum_limit() && r >= Omni<>::radius_min() && x.norm() <= Omni<>::reach_max();
  }

  std::mt19937 random_;
  Omni<> robot_;
};

}  // namespace limpid::test
