// SPDX-License-Identifier: MIT
#pragma once

#include "section.hpp"

#include <nlohmann/json.hpp>

#include <iosfwd>
#include <vector>

namespace limpid::examples {

/// A line for every predictor of every case, printed changes beside ours. Errors mix m and m/s, as (3.35) does.
void print_runs(std::ostream& out, const std::vector<RunComparison>& runs);

/// The same with all digits.
[[nodiscard]] nlohmann::ordered_json runs_as_json(const std::vector<RunComparison>& runs);

}  // namespace limpid::examples
