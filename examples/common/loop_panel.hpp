// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace limpid::examples {

/// Of a running loop, for a TextPanel.
struct LoopValues {
  Duration time{};                                     ///< since its begin
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the tip, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< N
  double error = 0;                                    ///< m
  std::uint64_t ticks = 0, missed = 0;                 ///< instants of the grid with and without a tick
  Status status = Status::ok;
};

/// For people: a line each, of less than 80 characters where the status is short.
[[nodiscard]] std::vector<std::string> lines_of(const LoopValues& values);

}  // namespace limpid::examples
