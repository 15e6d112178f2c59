// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/trace.hpp"

#include <functional>
#include <string>
#include <vector>

namespace limpid::bench {

/// A predictor as it is set up here, for any period.
struct Contender {
  std::string name;
  std::function<Trace(const Course&)> run;
};

/// All that are known; hold first, ideal (the truth itself) last.
[[nodiscard]] const std::vector<Contender>& contenders();

[[nodiscard]] std::vector<Contender> signal_contenders();  ///< extrapolate the samples
[[nodiscard]] std::vector<Contender> model_contenders();   ///< with the thesis's model, estimated
[[nodiscard]] std::vector<Contender> curve_contenders();   ///< learn a whole force law

/// What each tick of the contender `chosen` took, us.
[[nodiscard]] std::vector<double> microseconds_of_chosen(const Course& course);

}  // namespace limpid::bench
