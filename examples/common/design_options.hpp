// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/design_point.hpp>
#include <limpid/design/grid.hpp>

#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

/// What `design_gain` is asked to do.
enum class DesignCommand { solve, verify, map, robust };

/// What a gain is judged by: the thesis's inequalities, or the exact sampled or continuous system.
enum class DesignTheorem { two, three, five, sampled, delay };

/// Which of the feasible gains `solve` takes.
enum class DesignCriterion { first, margin, bound, radius };

struct DesignTask {
  DesignCommand command = DesignCommand::verify;
  DesignTheorem theorem = DesignTheorem::three;
  DesignCriterion criterion = DesignCriterion::margin;
  PredictorDesign<> design{};          ///< tool, T_d, a2, a3
  double delay = 0;                    ///< of the sampled system, s
  double gamma = 100;                  ///< of (4.31)
  bool over_box = false;               ///< whether the box is asked about, not the environment
  limpid::Tissue<> environment{};      ///< N/m, N s/m
  TissueBox<> box{};                   ///< N/m, N s/m
  TissueRates<> rates{};               ///< N/(m s), N/m
  std::optional<AffineGain<>> gain{};  ///< a constant one has L1 = L2 = 0
  bool scheduled = false;              ///< whether six numbers were given
  Grid<> grid{};                       ///< of `map`
  int knots = 0;                       ///< of the B-spline in the place of an affine dependence; 0: affine
  int threads = 0;                     ///< 0: as many as the machine has
};

struct DesignOptions {
  DesignTask task;
  std::string json, plot;        ///< paths; empty: not written
  std::optional<int> exit_code;  ///< set where the command line asked for help or was refused (said already)
};

/// Reads the command line of `design_gain`; says on standard error what it refuses and what it would accept.
[[nodiscard]] DesignOptions parse_design_options(int argc, const char* const* argv);

[[nodiscard]] const char* name(DesignTheorem theorem);

}  // namespace limpid::examples
