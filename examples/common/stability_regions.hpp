// SPDX-License-Identifier: MIT
#pragma once

#include "heat_map.hpp"
#include "section.hpp"

#include <limpid/design/design_point.hpp>
#include <limpid/design/grid.hpp>
#include <limpid/design/map.hpp>

#include <string>
#include <vector>

namespace limpid::examples {

using Region = GridMap<Verdict>;

/// Where each tissue has variables of its own that satisfy (4.31): what "there is a solution for each parameter set"
/// of section 6.2.1 means.
[[nodiscard]] Region region_cell_by_cell(const PredictorDesign<>& design, const Gain<>& L, const Grid<>& grid);

/// Where the one set of variables found at `nominal` satisfies (4.31), section 6.2.2, or (4.51), section 4.4.1.
[[nodiscard]] Region region_of_one_certificate(const PredictorDesign<>& design, const AffineGain<>& L,
                                               const limpid::Tissue<>& nominal, const Grid<>& grid);

/// The cells of the largest box about the grid's centre on which (4.51) holds for L, by the corners of box and rates.
[[nodiscard]] Region region_of_largest_box(const PredictorDesign<>& design, const AffineGain<>& L,
                                           const TissueRates<>& rates, const Grid<>& grid);

/// Where the sampled predictor is stable for constant tissue, period and delay T_d.
[[nodiscard]] Region region_sampled(const PredictorDesign<>& design, const AffineGain<>& L, const Grid<>& grid);

[[nodiscard]] HeatPanel panel(const std::string& title, const Region& region);

/// What a section designs: one period, with what the thesis prints for it.
struct PrintedDesign {
  double T_d;                                     ///< s
  Gain<> constant;                                ///< L_const
  AffineGain<> scheduled;                         ///< L0, L1, L2
  std::string constant_figure, scheduled_figure;  ///< numbers in the thesis: "6.36"
};

/// What the designs of a section have in common.
struct DesignSetting {
  PredictorDesign<> design;  ///< T_d comes from each printed design
  limpid::Tissue<> nominal;  ///< rho_0
  TissueRates<> rates;       ///< rho'_0
  Grid<> grid;
};

/// A grid's corner to corner, 1 N s/m and 100 N/m apart.
[[nodiscard]] Grid<> thesis_grid(double least_damping);

/// Adds the figures and plots of the constant gain; `remark` is what the text says of it.
void add_constant_gain(SectionReport& report, const DesignSetting& setting, const PrintedDesign& printed,
                       const std::string& remark);

/// Adds those of the gain-scheduled predictor, by the thesis's procedure and by the vertices of the box.
void add_scheduled_gain(SectionReport& report, const DesignSetting& setting, const PrintedDesign& printed,
                        const std::string& remark);

}  // namespace limpid::examples
