// SPDX-License-Identifier: MIT
#include "option_checks.hpp"

#include "output_file.hpp"

#include <cmath>
#include <sstream>

namespace limpid::examples {

CLI::Validator within(double least, double most, bool open) {
  std::ostringstream words;
  words << "a number in " << (open ? "(" : "[") << least << ", " << most << "]";
  return CLI::Validator(
      [=, text = words.str()](std::string& typed) -> std::string {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(typed, value) && std::isfinite(value);
        const bool inside = number && value <= most && (open ? value > least : value >= least);
        return inside ? std::string{} : "accepts " + text + ", got " + typed;
      },
      "", "within");
}

CLI::Validator whole(double most) {
  return CLI::Validator(
      [=](std::string& typed) -> std::string {
        const bool digits = !typed.empty() && typed.find_first_not_of("0123456789") == std::string::npos;
        double value = 0;
        const bool inside = digits && CLI::detail::lexical_cast(typed, value) && value <= most;
        return inside ? std::string{}
                      : "accepts a whole number of [0, " + std::to_string(std::llround(most)) + "], got " + typed;
      },
      "", "whole");
}

CLI::Validator output() {
  return CLI::Validator([](std::string& typed) { return refusal_of_output(typed); }, "", "output");
}

std::string text(double value) {
  std::ostringstream words;
  words << value;
  return words.str();
}

}  // namespace limpid::examples
