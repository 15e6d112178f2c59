// SPDX-License-Identifier: MIT
// The scenarios of test/stress, compiled in parts.
#pragma once

#include <stress/trial.hpp>

#include <cstdint>
#include <vector>

namespace limpid::stress {

[[nodiscard]] std::vector<Scenario> estimation_part();
[[nodiscard]] std::vector<Scenario> prediction_part();
[[nodiscard]] std::vector<Scenario> control_part();

/// Runs the law on (k, b, c) in float and in double, and prints its errors against 50 digits.
/// @returns whether Gamma stayed definite
[[nodiscard]] bool print_law_errors(std::uint64_t ticks);

}  // namespace limpid::stress
