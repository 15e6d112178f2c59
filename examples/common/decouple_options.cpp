// SPDX-License-Identifier: MIT
#include "decouple.hpp"
#include "number_list.hpp"
#include "output_file.hpp"
#include "words.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <system_error>

namespace limpid::examples {

namespace {

// Finite numbers of [least, most].
CLI::Validator within(double least, double most) {
  return CLI::Validator(
      [=](std::string& typed) -> std::string {
        const auto value = number_of(typed);
        if (value && *value >= least && *value <= most) return {};
        return words("accepts a number in [%g, %g], got ", least, most) + typed;
      },
      "", "within");
}

}  // namespace

void add_decouple_options(CLI::App& app, DecoupleOptions& options) {
  app.option_defaults()->always_capture_default();
  app.add_option("--frequency", options.frequency, "of the operator's force, Hz")->check(within(0.5, 100.0));
  app.add_option("--filter", options.filter, "Q of the runs")->check(CLI::IsMember({"first", "butterworth", "q31"}));
  app.add_option("--cutoff", options.cutoff, "of Q in the runs, Hz")->check(within(0.5, 1000.0));
  app.add_option("--force", options.force, "amplitude of the operator's force along x, N")->check(within(1e-4, 5.0));
  app.add_option("--json", options.json, "write the figures here")
      ->check(CLI::Validator([](std::string& typed) { return refusal_of_output(typed); }, "", "output"));
  app.add_option("--plot", options.plot, "draw decouple.svg into this directory")
      ->check(CLI::Validator(
          [](std::string& typed) -> std::string {
            std::error_code error;
            std::filesystem::create_directories(typed, error);
            if (!error && std::filesystem::is_directory(typed, error)) return {};
            return "accepts a folder that can be made, got " + typed;
          },
          "", "folder"));
}

}  // namespace limpid::examples
