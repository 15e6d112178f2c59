// SPDX-License-Identifier: MIT
#pragma once

#include "usb/faults.hpp"
#include "usb/stream.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace limpid::bench {

/// All seconds, or those in which the machine did not hold the emulator up.
[[nodiscard]] inline std::pair<StreamSecond, std::size_t> sum_of(const StreamFigures& stream, bool with_pauses) {
  StreamSecond sum;
  std::size_t count = 0;
  for (const StreamSecond& each : stream.seconds) {
    if (!with_pauses && each.pauses > 0) continue;
    sum += each;
    ++count;
  }
  return {sum, count};
}

/// Median and worst of what a run took, ms; NaN where no run has it.
struct Spread {
  double median = std::numeric_limits<double>::quiet_NaN(), worst = median;
  std::size_t count = 0;  ///< that have it
};

[[nodiscard]] inline Spread spread_of(const FaultRow& row, std::optional<Duration> FaultRun::*took, bool with_held_up) {
  std::vector<double> ms;
  for (const FaultRun& run : row.runs) {
    if (run.began && run.*took && (with_held_up || !run.held_up)) ms.push_back(1e3 * in_seconds(*(run.*took)));
  }
  if (ms.empty()) return {};
  std::sort(ms.begin(), ms.end());
  return {.median = ms[ms.size() / 2], .worst = ms.back(), .count = ms.size()};
}

template <typename Holds>
[[nodiscard]] std::size_t count_of(const FaultRow& row, Holds&& holds) {
  return static_cast<std::size_t>(std::count_if(row.runs.begin(), row.runs.end(), holds));
}

/// Whether what was stated, and whether anything was, is as expected.
[[nodiscard]] inline bool is_expected(const FaultRow& row, const FaultRun& run) {
  if (!run.began) return false;
  if (!row.stated) return run.to_zero.has_value();
  if (row.borne()) return run.stated == UsbFault::none && !run.to_zero;
  return run.to_zero && std::find(row.expected.begin(), row.expected.end(), run.stated) != row.expected.end();
}

}  // namespace limpid::bench
