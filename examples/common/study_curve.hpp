// SPDX-License-Identifier: MIT
#pragma once

#include "chart.hpp"
#include "prediction_study.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace limpid::examples {

inline constexpr std::size_t drawn_points = 2000;

template <typename Signal>
[[nodiscard]] Curve curve(std::string name, const std::vector<StudyPoint>& points, Signal signal) {
  Curve result{std::move(name), {}, {}};
  const std::size_t stride = points.size() / drawn_points + 1;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    result.x.push_back(points[i].time);
    result.y.push_back(std::invoke(signal, points[i]));
  }
  return result;
}

/// L2 norm of an error up to each instant, by the trapezoidal rule.
template <typename Signal>
[[nodiscard]] Curve running_l2(std::string name, const std::vector<StudyPoint>& points, Signal error) {
  Curve result{std::move(name), {}, {}};
  const std::size_t stride = points.size() / drawn_points + 1;
  double integral = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double now = std::invoke(error, points[i]);
    if (i > 0) {
      const double before = std::invoke(error, points[i - 1]);
      integral += (points[i].time - points[i - 1].time) * (before * before + now * now) / 2;
    }
    if (i % stride != 0) continue;
    result.x.push_back(points[i].time);
    result.y.push_back(std::sqrt(integral));
  }
  return result;
}

/// The figures that the thesis draws of an error: its magnitude, and its running L2 norm, beside hold's.
[[nodiscard]] inline std::vector<Panel> error_panels(const std::vector<StudyPoint>& points) {
  return {{"error magnitude",
           "time (s)",
           "|e|",
           {curve("predicted", points, &StudyPoint::prediction_error),
            curve("delayed and sampled", points, &StudyPoint::hold_error)}},
          {"L2 norm of the error",
           "time (s)",
           "|e|_L2",
           {running_l2("predicted", points, &StudyPoint::prediction_error),
            running_l2("delayed and sampled", points, &StudyPoint::hold_error)}}};
}

/// The tool's states, true and predicted.
[[nodiscard]] inline std::vector<Panel> state_panels(const std::vector<StudyPoint>& points) {
  return {{"position",
           "time (s)",
           "x (m)",
           {curve("true", points, &StudyPoint::x), curve("predicted", points, &StudyPoint::x_predicted),
            curve("delayed and sampled", points, &StudyPoint::x_held)}},
          {"velocity",
           "time (s)",
           "v (m/s)",
           {curve("true", points, &StudyPoint::v), curve("predicted", points, &StudyPoint::v_predicted),
            curve("delayed and sampled", points, &StudyPoint::v_held)}}};
}

}  // namespace limpid::examples
