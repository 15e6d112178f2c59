// SPDX-License-Identifier: MIT
#pragma once

#include "peers/model.hpp"

#include <benchmark/benchmark.h>
#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace limpid::bench {

/// A robot's function as one library computes it.
struct Function {
  std::string name;
  std::function<void()> at_all;                    ///< at every motion, for its time
  std::function<Eigen::MatrixXd(std::size_t)> at;  ///< at one, as what must be equal in all libraries
};

/// @param call   computes it at motion i, into what it returns
/// @param value  what must be equal, of that
template <typename Call, typename Value>
[[nodiscard]] Function function(std::string name, std::size_t motions, Call call, Value value) {
  return {std::move(name),
          [=] {
            for (std::size_t i = 0; i < motions; ++i) {
              auto&& result = call(i);
              benchmark::DoNotOptimize(result);
            }
          },
          [=](std::size_t i) -> Eigen::MatrixXd { return value(call(i)); }};
}

/// What is compared, by its name in all libraries.
namespace names {
inline const std::string forward = "forward kinematics", jacobian = "Jacobian", inertia = "mass matrix H",
                         coriolis_matrix = "Coriolis matrix C", coriolis = "Coriolis torque C q'", gravity = "gravity",
                         torque = "inverse dynamics", regressor = "regressor", inverse = "inverse kinematics";
}  // namespace names

/// Another library.
struct Peer {
  std::string name;
  std::string absent;  ///< why it is not compared; empty where it is
  std::function<std::vector<Function>(const ArmModel&, const std::vector<Motion>&)> functions;
};

Peer kdl();
Peer pinocchio();
std::vector<Function> limpid_omni(const ArmModel& model, const std::vector<Motion>& motions);
std::vector<Function> limpid_chain(const ArmModel& model, const std::vector<Motion>& motions);

}  // namespace limpid::bench
