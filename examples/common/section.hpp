// SPDX-License-Identifier: MIT
#pragma once

#include "chart.hpp"
#include "heat_map.hpp"

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

/// What a section of the thesis comes to here.
struct SectionReport {
  std::string title;
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

/// Of these the gains and their stability regions; the runs are not among them.
[[nodiscard]] SectionReport section_6_2_1();
[[nodiscard]] SectionReport section_6_2_2();
[[nodiscard]] SectionReport section_7_1();
[[nodiscard]] SectionReport section_7_2();

}  // namespace limpid::examples
