// SPDX-License-Identifier: MIT
// A case of the thesis: the same scene with hold, with the constant gain and with the scheduled one.
#pragma once

#include "scene.hpp"
#include "section.hpp"
#include "section_charts.hpp"
#include "stability_regions.hpp"

#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

/// A case of Tables 6.7, 7.3, 7.4 or 7.6.
struct RunCase {
  std::string name;           ///< as the thesis counts: A2
  Scene scene;                ///< its gain is not read
  PredictorGain constant;     ///< L_const
  PredictorGain scheduled{};  ///< L0, L1, L2; empty: not run
  std::optional<PrintedChange> printed{};
  std::string prediction_figure{}, total_figure{};  ///< numbers in the thesis: "7.28"; empty: not drawn
};

/// The runs of a case.
struct CaseResult {
  PalpationResult hold, constant;
  std::optional<PalpationResult> scheduled;  ///< nothing where the case has no such gain
};

/// As a scene takes them.
[[nodiscard]] PredictorGain constant_gain(const PrintedDesign& design);
[[nodiscard]] PredictorGain scheduled_gain(const PrintedDesign& design);

/// Runs a case; adds its row and its charts.
CaseResult add_case(SectionReport& report, const RunCase& which);

/// A press of the same shape whose largest force, of all milliseconds, is `peak`, N.
/// @throws std::invalid_argument  where the press has no force
[[nodiscard]] PressForce scaled_to_peak(const PressForce& press, double peak);

/// Tissue A or B of 6.2.2.
[[nodiscard]] Tissue bilinear_tissue(bool a);

/// k and c of (3.33) as a smooth bilinear tissue has them where the ideal tool is: the tangent to (3.34).
[[nodiscard]] std::vector<ParameterCurves> tangent_curves(const Tissue& tissue);

/// k = K |x|^(n-1) and b of a tissue without the Hunt-Crossley model's product term, 7.1.2.
[[nodiscard]] std::vector<ParameterCurves> secant_curves(const Tissue& tissue);

}  // namespace limpid::examples
