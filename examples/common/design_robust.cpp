// SPDX-License-Identifier: MIT
#include "design_report.hpp"
#include "design_words.hpp"

namespace limpid::examples {

DesignReport robust(const DesignTask& task) {
  const RobustAnswer answer = ask_robust(task);
  DesignReport report{.gain = answer.gain};
  report.json = {{"gain", numbers_of(answer.gain, false)},
                 {"worst_radius", number_or_null(answer.worst_radius)},
                 {"proved", answer.proved},
                 {"worst_environment", {answer.worst.stiffness, answer.worst.damping}},
                 {"proved_varying", answer.varying == Verdict::feasible},
                 {"settings", settings_of(task)}};
  const std::string varying = answer.varying == Verdict::feasible
                                  ? "stable, proved by a common quadratic function"
                                  : "not proved: there may be no common quadratic function";
  report.words = describe(answer.gain, false) + " for " + place_of(task) + "\n" +
                 row("worst spectral radius", words("%.6g at k_e = %.6g N/m, b_e = %.6g N s/m", answer.worst_radius,
                                                    answer.worst.stiffness, answer.worst.damping)) +
                 row("over the whole box", answer.proved ? "proved" : "not proved: " + answer.reason) +
                 row("varying between samples", varying);
  return report;
}

}  // namespace limpid::examples
