// SPDX-License-Identifier: MIT
#pragma once

#include "transparency_step.hpp"
#include "transparency_task.hpp"

#include <limpid/design/design_point.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

/// What (11) and (17) say of a gain; infinite where the loop is not stable.
struct GainFigures {
  WallFeedback<> gain{};
  double index = 0;  ///< J
  double norm = 0;   ///< ||L||
  double peak = 0;   ///< where, rad/s; infinite too where it is the limit at high frequency
};

/// What the sampled loop says of a gain, for every mass and damping of the box.
struct SampledVerdict {
  double gain = 0;                       ///< B_c
  Verdict verdict = Verdict::undecided;  ///< feasible: the radius is proved to be below the bound for all
  HapticPlant<> plant{};                 ///< of the largest radius of a grid of plants
  double radius = 0;                     ///< there
};

/// The gain of smallest index of those that are robustly stable, sampled and by (17).
struct OfferedGain {
  GainFigures figures{};
  SampledVerdict sampled{};
};

struct SampledFindings {
  VelocitySource velocity = VelocitySource::sampled;
  GainInterval<> nominal{};  ///< stable for the nominal plant
  GainInterval<> found{};    ///< stable for every plant of a grid over the box
  GainInterval<> robust{};   ///< proved for every plant of the box
  std::optional<SampledVerdict> optimum{};
  std::vector<SampledVerdict> gains{};
  std::optional<OfferedGain> offered{};
};

struct TransparencyFindings {
  std::optional<GainFigures> optimum{};
  double K_c = 0;                          ///< of all that follows, N/m
  GainInterval<> robust{};                 ///< ||L|| <= 1
  std::vector<GainFigures> table{};        ///< of the task's gains
  std::vector<SampledFindings> sampled{};  ///< of the task's velocities
  std::vector<StepResponse> steps{};       ///< of the wall's damping, the task's gains, the optimum and those offered
};

/// The optimum, the interval of (17) and the table.
void judge_model(const TransparencyTask& task, TransparencyFindings& findings);

/// What (11) and (17) say of one gain.
[[nodiscard]] GainFigures figures_of(const TransparencyTask& task, const WallFeedback<>& gain);

/// The sampled loops.
void judge_sampled(const TransparencyTask& task, TransparencyFindings& findings);

/// The responses to the step.
void take_steps(const TransparencyTask& task, TransparencyFindings& findings);

/// The gain of smallest index in an interval, rounded to six digits where these are inside.
[[nodiscard]] GainFigures best_gain(const TransparencyTask& task, double K_c, const GainInterval<>& interval);

[[nodiscard]] std::string words_of(const TransparencyTask& task, const TransparencyFindings& findings);
[[nodiscard]] nlohmann::ordered_json as_json(const TransparencyTask& task, const TransparencyFindings& findings);

/// Draws the paper's figures 4, 8, 9 and, of steps, 7 and 10.
/// @returns the paths of the files that were written
std::vector<std::string> draw_figures(const TransparencyTask& task, const TransparencyFindings& findings,
                                      const std::string& folder);

}  // namespace limpid::examples
