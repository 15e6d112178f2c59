// SPDX-License-Identifier: MIT
#include "prediction/choice.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace limpid::bench {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& accepts, const std::string& got) {
  throw std::invalid_argument(option + ": accepts " + accepts + ", got " + got);
}

template <typename Named>
std::string names_of(const std::vector<Named>& known) {
  std::string names;
  for (const Named& each : known) names += (names.empty() ? "" : ", ") + each.name;
  return names;
}

template <typename Named>
std::vector<Named> named(const std::string& option, const std::vector<Named>& known,
                         const std::vector<std::string>& names) {
  std::vector<Named> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name, &Named::name);
    if (found == known.end()) refuse(option, names_of(known), name);
    if (std::ranges::find(chosen, name, &Named::name) != chosen.end()) refuse(option, "each name once", name);
    chosen.push_back(*found);
  }
  return chosen;
}

template <typename Named>
std::vector<Named> named_or_all(const std::string& option, std::vector<Named> known,
                                const std::vector<std::string>& names, bool with_held_out) {
  if (!names.empty()) return named(option, known, names);
  if (!with_held_out) std::erase_if(known, [](const Named& each) { return each.held_out; });
  return known;
}

std::vector<Force> forces_of(const Choice& choice) {
  std::vector<Force> known = synthetic_forces();
  if (!choice.recordings.empty()) {
    for (Force& force : recorded_forces(choice.recordings)) known.push_back(std::move(force));
  }
  return named_or_all("--forces", std::move(known), choice.forces, choice.held_out);
}

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::vector<std::size_t> ticks_of(const std::vector<double>& periods) {
  std::vector<std::size_t> ticks;
  for (const double period : periods) {
    const double count = std::round(period / tick_seconds);
    if (!(count >= 1 && count <= 400 && std::abs(period - count * tick_seconds) < 1e-9)) {
      refuse("--periods", "whole milliseconds from 0.001 to 0.4 s", text_of(period));
    }
    ticks.push_back(static_cast<std::size_t>(count));
  }
  if (ticks.empty()) refuse("--periods", "a period or more", "none");
  return ticks;
}

}  // namespace

Selection selected(const Choice& choice) {
  if (!(choice.seconds >= 12 && choice.seconds <= 1000 && std::fmod(choice.seconds, window_seconds) == 0)) {
    refuse("--seconds", "multiples of 4 from 12 to 1000", text_of(choice.seconds));
  }
  Selection selection;
  selection.tissues = named_or_all("--tissues", tissues(), choice.tissues, choice.held_out);
  selection.forces = forces_of(choice);
  selection.disturbances =
      choice.disturbances.empty() ? disturbances() : named("--disturbances", disturbances(), choice.disturbances);
  selection.periods = ticks_of(choice.periods);
  const bool all = choice.predictors.empty() || choice.predictors == std::vector<std::string>{"all"};
  selection.predictors = all ? contenders() : named("--predictors", contenders(), choice.predictors);
  selection.seconds = choice.seconds;
  return selection;
}

}  // namespace limpid::bench
