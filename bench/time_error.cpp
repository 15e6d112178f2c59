// SPDX-License-Identifier: MIT
// Time against error wherever the library had a choice: every method in every scalar, against the exact solution in 50
// digits from identical inputs; fails where a default is worse than another method in both.
#include "time_error/method.hpp"
#include "time_error/row.hpp"

#include <CLI/CLI.hpp>
#include <common/output_file.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace {

using namespace limpid::bench;

struct Options {
  std::string csv, json, plot, only = ".*";
  int repeats = 400;
};

std::vector<Case> chosen(const std::string& only) {
  const std::regex pattern(only);
  std::vector<Case> cases;
  for (const auto& of_place : {predictor_step_cases, nonlinear_step_cases, least_squares_cases, velocity_cases,
                               observer_cases, trigonometry_cases, exponential_cases, omni_cases, whole_tick_cases}) {
    for (Case& each : of_place()) {
      if (std::regex_search(each.place + ", " + each.name, pattern)) cases.push_back(std::move(each));
    }
  }
  return cases;
}

int run(const Options& options) {
  std::vector<Row> rows;
  std::printf("relative errors; median of %d turns, ratio to the default; *: on the front of time against error\n",
              options.repeats);
  for (const Case& each : chosen(options.only)) {
    const std::vector<Row> of_case = rows_of(each, options.repeats);
    print_table(of_case);
    std::fflush(stdout);
    rows.insert(rows.end(), of_case.begin(), of_case.end());
  }
  const std::vector<std::string> broken = broken_rules(rows);
  if (!options.csv.empty()) limpid::examples::write_file(options.csv, as_csv(rows));
  if (!options.json.empty()) limpid::examples::write_file(options.json, as_json(rows, options.repeats, broken));
  if (!options.plot.empty()) {
    std::filesystem::create_directories(options.plot);
    for (const std::string& file : draw_work_precision(rows, options.plot)) std::printf("%s\n", file.c_str());
  }
  std::printf("\n%s\n", broken.empty() ? "no default is worse than another method in both time and error" : "broken:");
  for (const std::string& rule : broken) std::printf("  %s\n", rule.c_str());
  return broken.empty() ? 0 : 1;
}

std::string refusal_of_regex(const std::string& text) {
  try {
    const std::regex ignored(text);
  } catch (const std::regex_error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Time against error of every method that the library chose or did not choose");
  app.add_option("--only", options.only, "regular expression of \"place, case\"")->check(refusal_of_regex);
  app.add_option("--repeats", options.repeats, "turns of each method")->check(CLI::Range(1, 1'000'000));
  app.add_option("--csv", options.csv, "file for the rows")->check(limpid::examples::refusal_of_output);
  app.add_option("--json", options.json, "file for the rows and what they break")
      ->check(limpid::examples::refusal_of_output);
  app.add_option("--plot", options.plot, "folder for work-precision diagrams");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "time_error: %s\n", error.what());
    return 1;
  }
}
