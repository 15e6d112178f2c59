// SPDX-License-Identifier: MIT
#pragma once

#include "design_judge.hpp"

#include <limpid/design/predictor_bounds.hpp>
#include <limpid/design/predictor_margin.hpp>

#include <cmath>

namespace limpid::examples {

/// Theorem 5 over the box, or at the environment alone.
[[nodiscard]] InequalityAnswer verify_scheduled_gain(const DesignTask& task, const AffineGain<>& gain);
[[nodiscard]] InequalityAnswer find_scheduled_gain(const DesignTask& task);

/// Adds a margin to a verdict; and decides it where it was left open.
inline void take_margin(const PredictorMargin<>& found, InequalityAnswer& answer) {
  answer.margin = std::isfinite(found.margin) ? found.margin : found.bound;
  if (answer.verdict != Verdict::undecided || found.verdict == Verdict::undecided) return;
  answer.verdict = found.verdict;
  answer.certified = true;
}

inline void take_bound(const ErrorBound<>& found, InequalityAnswer& answer) {
  if (found.verdict != Verdict::feasible) return;
  answer.by_sampling = found.by_sampling;
  answer.by_force = found.by_force;
}

}  // namespace limpid::examples
