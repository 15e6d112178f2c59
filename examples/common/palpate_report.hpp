// SPDX-License-Identifier: MIT
#pragma once

#include "palpate_options.hpp"
#include "scene.hpp"

#include <iosfwd>
#include <vector>

namespace limpid::examples {

struct PalpationRun {
  PredictorKind predictor;
  PalpationResult result;
};

/// Null where hold was not asked for.
[[nodiscard]] const PalpationResult* hold_of(const std::vector<PalpationRun>& runs);

/// Errors and tick times of each predictor, with the change against hold where hold was run.
void print_table(std::ostream& out, const Scene& scene, const std::vector<PalpationRun>& runs);

/// Says which runs ended in a fault of the limiter: their arm hung without torque from then on.
/// @returns whether any did
[[nodiscard]] bool report_faults(std::ostream& out, const std::vector<PalpationRun>& runs);

/// Writes what the options ask for and says where.
/// @param hold  whose errors the windows of the JSON are judged by; read for that only, null in a live run
/// @throws std::runtime_error  where a file cannot be written
void write_outputs(std::ostream& out, const PalpateOptions& options, const std::vector<PalpationRun>& runs,
                   const PalpationResult* hold);

}  // namespace limpid::examples
