// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

/// A finite number as typed, also as a fraction: `1/60`.
[[nodiscard]] std::optional<double> number_of(const std::string& typed);

/// Numbers with exactly these separators between them: `numbers_of("1:2,3:4", ":,:")`.
[[nodiscard]] std::optional<std::vector<double>> numbers_of(const std::string& typed, const std::string& separators);

}  // namespace limpid::examples
