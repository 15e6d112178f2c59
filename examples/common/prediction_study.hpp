// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace limpid::examples {

/// A predictor beside a linear tissue, without a robot: sections 6.1.1 to 6.1.3.
struct PredictionStudy {
  struct Start {
    double stiffness, damping;  ///< N/m, N s/m
  };
  double stiffness = 2000, damping = 45;  ///< of the tissue, N/m, N s/m
  Tool<1> tool{.mass = 0.1, .damping = 0.1, .stiffness = 1};
  double gain_position = 0, gain_velocity = 0;  ///< L, N/m, N s/m
  std::optional<Start> start{};                 ///< of the estimate; nothing: the tissue is known
  Duration period{}, delay{};
  Duration tick = std::chrono::milliseconds{1};
  Duration duration = std::chrono::seconds{1};
  double x0 = 0, x0_predicted = 0;  ///< m
  bool error_in_history = false;    ///< whether the first error stood before time zero too
  std::function<double(double)> force = [](double) { return 0.0; };  ///< F_h at t (s), N
};

struct StudyPoint {
  double time;
  double x, v;                      ///< true, m, m/s
  double x_predicted, v_predicted;  ///< m, m/s
  double x_held, v_held;            ///< sampled, delayed, held: m, m/s
  double stiffness, damping;        ///< as the predictor takes them

  [[nodiscard]] double prediction_error() const;  ///< norm of e, section 4.3.1
  [[nodiscard]] double hold_error() const;        ///< norm of e_Delta, (6.1)
};

[[nodiscard]] std::vector<StudyPoint> run(const PredictionStudy& study);

/// Largest value of one error of a study, from a time on.
[[nodiscard]] double largest(const std::vector<StudyPoint>& points, double (StudyPoint::*error)() const,
                             double from_time = 0);

/// First time from which `value` stays within `fraction` of `target`; the end where it never does.
[[nodiscard]] double settling_time(const std::vector<StudyPoint>& points, double StudyPoint::*value, double target,
                                   double fraction);

}  // namespace limpid::examples
