// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/device_study.hpp"
#include "prediction/verdict.hpp"

#include <cstddef>
#include <vector>

namespace limpid::bench {

/// A scenario in one tissue and period, over all forces that leave the arm in its reach.
struct DeviceCell {
  bool held_out = false;
  std::size_t scenario = 0, tissue = 0, period = 0;
  double late = 0, hold_late = 0;                   ///< after 8 s, over the true signal's; geometric means
  double l2 = 0, ideal_l2 = 0, l2_as_followed = 0;  ///< over hold's; the true signal's; over `hold_as_judged`; likewise
  double chatter = 0;                               ///< mean over hold's mean
  double worst_chatter = 0, peak = 0;               ///< over hold's, the largest
  double limited = 0;                               ///< share of the ticks with less torque than asked for, mean
  double motion = 0;                                ///< in the last 4 s, the largest, rad
  std::size_t runs = 0;
};

/// What came of the arm.
struct DeviceStudy {
  std::vector<DeviceScenario> scenarios;
  std::vector<DeviceRow> rows;
  std::vector<DeviceCell> cells;  ///< in the order of the fields
};

/// @throws  what a run throws
[[nodiscard]] DeviceStudy study_device(const Selection& selection, unsigned threads);

[[nodiscard]] bool held_out(const Selection& selection, const DeviceStudy& study, const DeviceRow& row);

/// What is asked of the judged predictor with an arm behind it.
[[nodiscard]] std::vector<Finding> device_verdict(const Selection& selection, const DeviceStudy& study);

}  // namespace limpid::bench
