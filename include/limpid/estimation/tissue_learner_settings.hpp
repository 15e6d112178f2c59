// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

namespace limpid {

/// What a TissueLearner is told of the tool, and what it believes before it has seen anything.
template <typename Law>
struct TissueLearnerSettings {
  using Scalar = typename Law::Scalar;

  Scalar mass{};                                     ///< of the tool, kg
  Scalar tool_damping{0};                            ///< N s/m
  Scalar knot_spacing = Scalar(5) / 100000;          ///< at first; doubled where the range needs it, m
  Scalar damper_spacing = Scalar(1) / 1000;          ///< m
  Scalar slope{1000}, slope_deviation{700};          ///< of the tissue before anything is seen, N/m
  Scalar curvature{30000};                           ///< deviation of the slope's change over depth, (N/m)/sqrt(m)
  Scalar damping{25}, damping_deviation{12};         ///< N s/m
  Scalar damping_change{3};                          ///< deviation from one damper to the next, N s/m
  bool relaxation = true, dry_friction = false;      ///< whether they are learnt
  bool contact = false;                              ///< whether it may begin at an edge, and not pull
  Scalar branch_deviation{50};                       ///< of each K_i, N/m
  Scalar friction_deviation = Scalar(1) / 10;        ///< of F_c, N
  typename Law::Branch::Lags lags = default_lags();  ///< of the branches, s
  Scalar presliding = Scalar(3) / 1000000;           ///< m
  Scalar residual_time = Scalar(3) / 10;             ///< s
  Scalar residual_deviation = Scalar(1) / 10000;     ///< N
  Scalar process_deviation = Scalar(1) / 10000;      ///< of a force that the law lacks over an interval, N
  Scalar least_slope{150};                           ///< of the prediction beyond the visited depths, N/m
  Scalar most_slope{6000}, most_damping{200};        ///< N/m, N s/m
  bool scale_changes = true;                         ///< whether the tissue may change as a whole
  int iterations = 6;                                ///< at most

  /// @throws std::invalid_argument  where a field is refused
  void check() const {
    const auto positive = [](const Scalar& value, const char* field) {
      expect(is_finite(value) && value > Scalar{0}, field, "finite and > 0", value);
    };
    positive(mass, "TissueLearner: mass");
    expect(is_finite(tool_damping) && tool_damping >= Scalar{0}, "TissueLearner: tool_damping", "finite and >= 0",
           tool_damping);
    positive(knot_spacing, "TissueLearner: knot_spacing");
    positive(damper_spacing, "TissueLearner: damper_spacing");
    positive(slope, "TissueLearner: slope");
    positive(slope_deviation, "TissueLearner: slope_deviation");
    positive(curvature, "TissueLearner: curvature");
    positive(damping, "TissueLearner: damping");
    positive(damping_deviation, "TissueLearner: damping_deviation");
    positive(damping_change, "TissueLearner: damping_change");
    positive(branch_deviation, "TissueLearner: branch_deviation");
    positive(friction_deviation, "TissueLearner: friction_deviation");
    for (const Scalar& lag : lags) positive(lag, "TissueLearner: lags");
    positive(presliding, "TissueLearner: presliding");
    positive(residual_time, "TissueLearner: residual_time");
    positive(residual_deviation, "TissueLearner: residual_deviation");
    positive(process_deviation, "TissueLearner: process_deviation");
    positive(least_slope, "TissueLearner: least_slope");
    positive(most_slope, "TissueLearner: most_slope");
    positive(most_damping, "TissueLearner: most_damping");
    expect(iterations >= 1 && iterations <= 20, "TissueLearner: iterations", "1 to 20", iterations);
  }

  [[nodiscard]] typename Law::Settings law() const noexcept {
    return {.mass = mass,
            .tool_damping = tool_damping,
            .knot_spacing = knot_spacing,
            .damper_spacing = damper_spacing,
            .lags = lags,
            .presliding = presliding,
            .residual_time = residual_time,
            .least_slope = least_slope,
            .most_damping = most_damping,
            .relaxation = relaxation,
            .dry_friction = dry_friction};
  }

  [[nodiscard]] static typename Law::Branch::Lags default_lags() noexcept {
    typename Law::Branch::Lags lags{};
    Scalar lag = Scalar(8) / 100;
    for (auto& each : lags) {
      each = lag;
      lag *= Scalar(2);
    }
    return lags;
  }
};

}  // namespace limpid
