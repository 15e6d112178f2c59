// SPDX-License-Identifier: MIT
#pragma once

#include <support/run_program.hpp>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace limpid::test {

/// What an example program said, and the figures that it wrote.
struct Answer {
  ProgramRun run;
  nlohmann::json json;
};

inline Answer ask_program(const std::string& program, const std::string& arguments) {
  CAPTURE(arguments);
  const auto path =
      std::filesystem::temp_directory_path() / ("limpid_" + program + "_" + std::to_string(::getpid()) + ".json");
  Answer answer{run_program(program, arguments + " --json " + path.string()), {}};
  CAPTURE(answer.run.output);
  REQUIRE(answer.run.code == 0);
  answer.json = nlohmann::json::parse(std::ifstream(path));
  std::filesystem::remove(path);
  return answer;
}

/// Checks that the program ends with an error that names the option.
inline void check_refused(const std::string& program, const std::string& arguments, const std::string& option) {
  CAPTURE(arguments);
  const ProgramRun result = run_program(program, arguments);
  CAPTURE(result.output);
  CHECK(result.code != 0);
  CHECK(result.mentions(option));
}

}  // namespace limpid::test
