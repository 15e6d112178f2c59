// SPDX-License-Identifier: MIT
#include "number_list.hpp"

#include <cmath>
#include <cstdlib>

namespace limpid::examples {

namespace {

std::optional<double> decimal_of(const std::string& typed) {
  if (typed.empty() || typed.find_first_not_of("0123456789.eE+-") != std::string::npos) return {};
  char* end = nullptr;
  const double value = std::strtod(typed.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) return {};
  return value;
}

}  // namespace

std::optional<double> number_of(const std::string& typed) {
  const std::size_t bar = typed.find('/');
  if (bar == std::string::npos) return decimal_of(typed);
  const auto above = decimal_of(typed.substr(0, bar)), below = decimal_of(typed.substr(bar + 1));
  if (!above || !below || !std::isfinite(*above / *below)) return {};
  return *above / *below;
}

std::optional<std::vector<double>> numbers_of(const std::string& typed, const std::string& separators) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= separators.size(); ++i) {
    const std::size_t end = i < separators.size() ? typed.find(separators[i], begin) : typed.size();
    if (end == std::string::npos) return {};
    const auto number = number_of(typed.substr(begin, end - begin));
    if (!number) return {};
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

}  // namespace limpid::examples
