// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace limpid {

/// Refuses a setting at construction: "Deadband: width: expected finite and >= 0, got 0.1 -2 0". Never used
/// in a hot path.
/// @throws std::invalid_argument  where `holds` is false
template <typename Value>
void expect(bool holds, std::string_view field, std::string_view expected, const Value& actual) {
  if (holds) return;
  std::ostringstream text;
  text << field << ": expected " << expected << ", got";
  if constexpr (requires { actual.reshaped(); }) {
    for (const auto& entry : actual.reshaped()) text << ' ' << entry;
  } else if constexpr (requires { typename Value::period; }) {
    text << ' ' << std::chrono::duration<double>(actual).count() << " s";
  } else {
    text << ' ' << actual;
  }
  throw std::invalid_argument(text.str());
}

}  // namespace limpid
