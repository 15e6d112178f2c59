// SPDX-License-Identifier: MIT
#pragma once

#include "problems.hpp"

#include <ctime>
#include <functional>
#include <string>
#include <utility>

namespace limpid::bench {

/// One way to solve SdpData by somebody else's program.
struct Solver {
  std::string name;
  bool present = false;
  std::string how;  ///< in process or not; what is subtracted
  /// The largest t, and the seconds that it took.
  std::function<std::pair<double, double>(const Data&)> solve;
};

Solver csdp_library();
Solver csdp_process();
Solver sdpa_library();

/// Processor time of this process, so that others on the machine do not count.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace limpid::bench
