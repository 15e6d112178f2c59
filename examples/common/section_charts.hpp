// SPDX-License-Identifier: MIT
// The charts that the thesis draws of a run.
#pragma once

#include "chart.hpp"
#include "scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace limpid::examples {

/// "fig_7_28" of the thesis's number "7.28".
[[nodiscard]] std::string figure_file(const std::string& figure);

/// A run under the name that its curves bear; the result outlives it.
struct NamedRun {
  std::string name;
  const PalpationResult& result;
};

/// An error's magnitude, and its running L2 norm.
[[nodiscard]] Chart error_chart(const std::string& title, const std::vector<NamedRun>& runs, double TracePoint::*error);

/// Where the tip is and where it was to be, and the difference.
[[nodiscard]] Chart tracking_chart(const std::string& title, const PalpationResult& result);

/// A tissue's two parameters as estimated and as they are.
struct ParameterCurves {
  std::string title, label;                         ///< of the panel and its axis
  std::function<double(const TracePoint&)> actual;  ///< of the true tissue
};
[[nodiscard]] Chart parameter_chart(const std::string& title, const PalpationResult& result,
                                    const std::vector<ParameterCurves>& parameters);

}  // namespace limpid::examples
