// SPDX-License-Identifier: MIT
#pragma once

#include "chart.hpp"
#include "heat_map.hpp"
#include "press_force.hpp"

#include <limpid/core/status.hpp>
#include <limpid/evaluation/error_norms.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace limpid::examples {

/// A figure of the thesis beside ours.
struct Comparison {
  std::string name;
  double ours;
  std::optional<double> printed;  ///< nothing where the thesis prints no number
  std::string unit;
  std::string remark{};
};

/// One row of Table 6.5, as fractions of the error without prediction.
struct CaseComparison {
  int number;
  double bound_change, l2_change;
  double printed_bound_change, printed_l2_change;
};

/// One predictor in one case.
struct RunErrors {
  std::string predictor;      ///< hold, constant gain, scheduled gain
  Norms<> prediction, total;  ///< of (3.35)
  Status status = Status::ok;
};

/// What a table prints of a case: total error with prediction against without, (3.36) to (3.38); changes as fractions.
struct PrintedChange {
  std::optional<double> bound_difference;
  double bound_change, l2_change;
  std::string over_constant_gain{};  ///< its word for the scheduled gain against the constant one
};

/// One row of Tables 6.7, 7.3, 7.4 or 7.6.
struct RunComparison {
  std::string name;             ///< as the thesis counts its cases: A2
  double period;                ///< T_d, s
  std::vector<RunErrors> runs;  ///< hold is the first; the last is the one that `printed` is of
  std::optional<PrintedChange> printed{};
};

/// What a section of the thesis comes to here.
struct SectionReport {
  std::string title;
  std::vector<std::string> notes{};  ///< what is to be known before the numbers are read
  std::vector<RunComparison> runs{};
  std::vector<Comparison> figures{};
  std::vector<CaseComparison> cases{};
  std::vector<std::pair<std::string, Chart>> charts{};       ///< file name without folder and ending
  std::vector<std::pair<std::string, HeatMap>> heat_maps{};  ///< likewise
};

[[nodiscard]] SectionReport section_5_2_7();
[[nodiscard]] SectionReport section_6_1_1();
[[nodiscard]] SectionReport section_6_1_2();
[[nodiscard]] SectionReport section_6_1_3();

/// @param number  of the one case to run; all nine, and the one without tool spring, where absent
[[nodiscard]] SectionReport section_6_1_4(std::optional<int> number);

/// Simulations of the gain-scheduled predictor beside the constant gain and hold; gains and their stability regions.
[[nodiscard]] SectionReport section_6_2_1();
[[nodiscard]] SectionReport section_6_2_2();

/// The experiments, on the realistic simulated Omni: nothing runs on hardware. Gains and their stability regions.
/// @param press  what the operator's hand did, played back
/// @param peak   to which it is scaled, N; in the thesis 10
/// @throws std::invalid_argument  where the press has no force
[[nodiscard]] SectionReport section_7_1(const PressForce& press, double peak = 10);
[[nodiscard]] SectionReport section_7_2(const PressForce& press, double peak = 10);

}  // namespace limpid::examples
