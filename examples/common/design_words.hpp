// SPDX-License-Identifier: MIT
// How the answers of `design_gain` are put; included by its sources.
#pragma once

#include "design_judge.hpp"
#include "words.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace limpid::examples {

/// Two numbers, or six where it is scheduled.
[[nodiscard]] inline std::vector<double> numbers_of(const AffineGain<>& gain, bool scheduled) {
  std::vector<double> numbers{gain.L0[0], gain.L0[1]};
  if (scheduled) numbers.insert(numbers.end(), {gain.L1[0], gain.L1[1], gain.L2[0], gain.L2[1]});
  return numbers;
}

[[nodiscard]] inline std::string describe(const AffineGain<>& gain, bool scheduled) {
  if (!scheduled) return words("L = [%.6g %.6g]", gain.L0[0], gain.L0[1]);
  return words("L = [%.6g %.6g] + k_e [%.6g %.6g] + b_e [%.6g %.6g]", gain.L0[0], gain.L0[1], gain.L1[0], gain.L1[1],
               gain.L2[0], gain.L2[1]);
}

[[nodiscard]] inline std::string describe(const std::complex<double>& root) {
  if (root.imag() == 0) return words("%.6g 1/s", root.real());
  return words("%.6g +- %.6gi 1/s", root.real(), std::abs(root.imag()));
}

/// What is asked about.
[[nodiscard]] inline std::string place_of(const DesignTask& task) {
  const std::string period = words("T_d = %.6g s", task.design.T_d);
  if (!task.over_box) {
    return words("k_e = %.6g N/m, b_e = %.6g N s/m, ", task.environment.stiffness, task.environment.damping) + period;
  }
  return words("k_e in [%.6g, %.6g] N/m, b_e in [%.6g, %.6g] N s/m, ", task.box.lower.stiffness,
               task.box.upper.stiffness, task.box.lower.damping, task.box.upper.damping) +
         period;
}

[[nodiscard]] nlohmann::ordered_json settings_of(const DesignTask& task);

/// One line of the table.
[[nodiscard]] std::string row(const std::string& what, const std::string& finding);

[[nodiscard]] std::string describe(const InequalityAnswer& answer);
[[nodiscard]] std::string describe(const DesignTask& task, const SampledAnswer& answer);
[[nodiscard]] std::string describe(const DesignTask& task, const DelayAnswer& answer);

/// What one should know of an inequality and a sampled predictor that disagree; empty where they agree.
[[nodiscard]] std::string warning_of(const DesignTask& task, const InequalityAnswer& inequality,
                                     const SampledAnswer& sampled);

/// What one should know of a box where the verdict lets each tissue have its own X and the margin does not.
[[nodiscard]] std::string remark_on_margin(const DesignTask& task, const InequalityAnswer& inequality);

/// That nothing was found, and among what.
[[nodiscard]] std::string no_gain(const DesignTask& task);

}  // namespace limpid::examples
