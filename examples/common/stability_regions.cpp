// SPDX-License-Identifier: MIT
#include "stability_regions.hpp"

#include "design_cell.hpp"
#include "design_instances.hpp"
#include "design_words.hpp"
#include "section_charts.hpp"

#include <limpid/design/sampled_stability.hpp>

namespace limpid::examples {

namespace {

DesignTask task_of(const PredictorDesign<>& design, const AffineGain<>& L) {
  DesignTask task;
  task.design = design;
  task.delay = design.T_d;
  task.gain = L;
  return task;
}

Region region_where(const Grid<>& grid, const std::function<bool(const limpid::Tissue<>&)>& holds) {
  return limpid::map(grid, [&](const limpid::Tissue<>& tissue) {
    return holds && holds(tissue) ? Verdict::feasible : Verdict::infeasible;
  });
}

double cells(const Region& region) {
  return static_cast<double>(region.count([](Verdict verdict) { return verdict == Verdict::feasible; }));
}

std::string of(const Region& region) { return "of " + std::to_string(region.cells.size()) + " cells"; }

std::string heading(const PrintedDesign& printed, const std::string& figure) {
  return (figure.empty() ? "Table 6.4" : "Fig. " + figure) + words(", T_d = %g s", printed.T_d);
}

void add(SectionReport& report, HeatMap& plot, const std::string& name, const std::string& title, const Region& region,
         const std::string& remark) {
  report.figures.push_back({name + ": " + title, cells(region), {}, of(region), remark});
  plot.panels.push_back(panel(title, region));
}

// What the thesis looks for: an affine gain of our own, over as much of the box as one exists for.
void add_own_schedule(SectionReport& report, const PredictorDesign<>& design, const DesignSetting& setting,
                      const std::string& name) {
  const LargestBox<> own = largest_scheduled_box(design, setting.grid.box(), setting.rates, {});
  report.figures.push_back({name + ": a gain of our own, largest box with it",
                            own.scale,
                            {},
                            "of the half widths",
                            own.scale < 1 ? words("infeasible at %.4g by a dual certificate", own.not_beyond)
                                          : std::string("the whole box, certified")});
}

PredictorDesign<> at_period(const DesignSetting& setting, const PrintedDesign& printed) {
  PredictorDesign<> design = setting.design;
  design.T_d = printed.T_d;
  return design;
}

}  // namespace

Region region_cell_by_cell(const PredictorDesign<>& design, const Gain<>& L, const Grid<>& grid) {
  const CellTest test(task_of(design, {.L0 = L}), false);
  const auto answers = limpid::map<CellAnswer>(grid, test);
  Region region{grid, {}};
  for (const CellAnswer& answer : answers.cells) region.cells.push_back(answer.verdict);
  return region;
}

Region region_of_one_certificate(const PredictorDesign<>& design, const AffineGain<>& L,
                                 const limpid::Tissue<>& nominal, const Grid<>& grid) {
  return region_where(grid, one_certificate(design, L, nominal));
}

Region region_of_largest_box(const PredictorDesign<>& design, const AffineGain<>& L, const TissueRates<>& rates,
                             const Grid<>& grid) {
  const auto box = largest_scheduled_box(design, grid.box(), rates, L).box;
  return region_where(grid, [&](const limpid::Tissue<>& tissue) {
    return box.lower.stiffness <= tissue.stiffness && tissue.stiffness <= box.upper.stiffness &&
           box.lower.damping <= tissue.damping && tissue.damping <= box.upper.damping;
  });
}

Region region_sampled(const PredictorDesign<>& design, const AffineGain<>& L, const Grid<>& grid) {
  const SampledStability<> sampled({.tool = design.tool, .period = design.T_d, .delay = design.T_d});
  return region_where(grid, [&](const limpid::Tissue<>& tissue) { return sampled.stable(tissue, L(tissue)); });
}

HeatPanel panel(const std::string& title, const Region& region) {
  HeatPanel result{title, "k_e (N/m)", "b_e (N s/m)", {}, {}, {}, region_scale};
  for (std::size_t i = 0; i < region.grid.rows(); ++i) result.x.push_back(region.grid.stiffness[i]);
  for (std::size_t j = 0; j < region.grid.columns(); ++j) result.y.push_back(region.grid.damping[j]);
  for (const Verdict verdict : region.cells) {
    result.values.push_back(verdict == Verdict::feasible ? 1 : verdict == Verdict::infeasible ? 0 : 0.5);
  }
  return result;
}

Grid<> thesis_grid(double least_damping) { return {{200, 100, 2000}, {least_damping, 1, 40}}; }

void add_constant_gain(SectionReport& report, const DesignSetting& setting, const PrintedDesign& printed,
                       const std::string& remark) {
  const PredictorDesign<> design = at_period(setting, printed);
  const std::string name = heading(printed, printed.constant_figure);
  HeatMap plot{name + ", " + describe(AffineGain<>{.L0 = printed.constant}, false), {}, 3};
  add(report, plot, name, "each cell with variables of its own",
      region_cell_by_cell(design, printed.constant, setting.grid), remark);
  add(report, plot, name, "one P, Q, R, found at rho_0",
      region_of_one_certificate(design, {.L0 = printed.constant}, setting.nominal, setting.grid), {});
  add(report, plot, name, "sampled predictor stable", region_sampled(design, {.L0 = printed.constant}, setting.grid),
      "exact, for constant tissue");
  if (!printed.constant_figure.empty()) report.heat_maps.push_back({figure_file(printed.constant_figure), plot});
}

void add_scheduled_gain(SectionReport& report, const DesignSetting& setting, const PrintedDesign& printed,
                        const std::string& remark) {
  const PredictorDesign<> design = at_period(setting, printed);
  const std::string name = heading(printed, printed.scheduled_figure);
  HeatMap plot{name + ", " + describe(printed.scheduled, true), {}, 2};
  add(report, plot, name, "one P, Q, R, found at rho_0, any rates",
      region_of_one_certificate(design, printed.scheduled, setting.nominal, setting.grid), remark);
  for (const double part : {0.0, 1.0}) {
    const TissueRates<> rates{part * setting.rates.stiffness, part * setting.rates.damping};
    add(report, plot, name, words("largest box, |k'| <= %g, |b'| <= %g", rates.stiffness, rates.damping),
        region_of_largest_box(design, printed.scheduled, rates, setting.grid), "by the corners of box and rates");
  }
  add(report, plot, name, "sampled predictor stable", region_sampled(design, printed.scheduled, setting.grid),
      "exact, for constant tissue");
  add_own_schedule(report, design, setting, name);
  report.heat_maps.push_back({figure_file(printed.scheduled_figure), plot});
}

}  // namespace limpid::examples
