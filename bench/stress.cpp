// SPDX-License-Identifier: MIT
// stress [--ticks N] [--seed S] [--only REGEX]: every scenario of test/stress for N >= 1 ticks in all, 1e8 by default.
// Ends at the first invariant that breaks, with the smallest case found that breaks it.
#include "stress/parts.hpp"

#include <stress/shrink.hpp>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <regex>
#include <string>
#include <string_view>

namespace {

using namespace limpid::stress;

struct Options {
  std::uint64_t ticks = 100'000'000, seed = 1;
  std::string only;
};

std::optional<std::uint64_t> count_of(std::string_view typed) {
  double value = 0;
  const auto [end, error] = std::from_chars(typed.data(), typed.data() + typed.size(), value);
  const bool whole = error == std::errc{} && end == typed.data() + typed.size() && std::floor(value) == value;
  if (!whole || !(value >= 0 && value <= 1e15)) return {};
  return static_cast<std::uint64_t>(value);
}

std::optional<Options> options_of(int argc, const char* const* argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view option = argv[i];
    if (i + 1 == argc) return {};
    const auto count = count_of(argv[i + 1]);
    if (option == "--only") {
      options.only = argv[i + 1];
    } else if (option == "--ticks" && count && *count > 0) {
      options.ticks = *count;
    } else if (option == "--seed" && count) {
      options.seed = *count;
    } else {
      return {};
    }
  }
  return options;
}

/// Whether all invariants held.
bool run_and_print(const Scenario& scenario, std::uint64_t ticks, std::uint64_t seed) {
  const auto start = std::chrono::steady_clock::now();
  const Campaign campaign = run(scenario, ticks, seed);
  const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - start;
  const Outcome& outcome = campaign.outcome;
  std::printf("%-46s %9.3g ticks %6.1f s  %s\n", scenario.name.c_str(), double(outcome.ticks), lasted.count(),
              outcome.holds() ? "holds" : "BROKEN");
  for (std::size_t i = 0; i < outcome.figure_count; ++i) {
    std::printf("    %s: at most %.3g of what it may be\n", std::string(outcome.figures[i].name).c_str(),
                outcome.figures[i].worst);
  }
  std::fflush(stdout);
  if (outcome.holds()) return true;
  const Trial trial = shrunk(scenario, campaign.trial);
  const Outcome smallest = scenario.play(trial);
  std::printf("seed %llu, tick %llu: %s (%.6g of what it may be)\n\n%s",
              static_cast<unsigned long long>(campaign.trial.seed), static_cast<unsigned long long>(outcome.tick),
              std::string(outcome.broken).c_str(), outcome.value, test_case_of(scenario, trial, smallest).c_str());
  return false;
}

int run_all(const Options& options) {
  const std::regex wanted(options.only);
  std::vector<Scenario> scenarios;
  for (const auto& part : {estimation_part(), prediction_part(), control_part()}) {
    for (const Scenario& scenario : part) {
      if (std::regex_search(scenario.name, wanted)) scenarios.push_back(scenario);
    }
  }
  double shares = 0;
  for (const Scenario& scenario : scenarios) shares += scenario.share;
  for (const Scenario& scenario : scenarios) {
    const double part = std::ceil(double(options.ticks) * scenario.share / shares);
    if (!run_and_print(scenario, static_cast<std::uint64_t>(part), options.seed)) return 1;
  }
  if (!options.only.empty()) return 0;
  return print_law_errors(options.ticks / 10) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto options = options_of(argc, argv);
  if (!options) {
    std::fputs("stress [--ticks N] [--seed S] [--only REGEX], N >= 1\n", stderr);
    return 2;
  }
  try {
    return run_all(*options);
  } catch (const std::regex_error& error) {
    std::fprintf(stderr, "--only: %s\n", error.what());
    return 2;
  }
}
