// SPDX-License-Identifier: MIT
// Any text as numbers: refused, or as many finite numbers as the separators say. The first byte chooses these.
#include "common/number_list.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace limpid::examples;
  if (size == 0) return 0;
  static const std::array<std::string, 6> kinds{"", ",", ",,", ":,:", "::,::", ",,,,,"};
  const std::string& separators = kinds[data[0] % kinds.size()];
  const std::string typed(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto numbers = numbers_of(typed, separators);
  if (!numbers) return 0;
  if (numbers->size() != separators.size() + 1) __builtin_trap();
  for (const double number : *numbers) {
    if (!std::isfinite(number)) __builtin_trap();
  }
  return 0;
}
