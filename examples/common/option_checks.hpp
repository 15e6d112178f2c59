// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace limpid::examples {

/// Finite numbers of [least, most]; `open` leaves `least` itself out.
[[nodiscard]] CLI::Validator within(double least, double most, bool open = false);

/// Whole numbers of [0, most].
[[nodiscard]] CLI::Validator whole(double most);

/// A path to write to.
[[nodiscard]] CLI::Validator output();

/// As it is best read.
[[nodiscard]] std::string text(double value);

}  // namespace limpid::examples
