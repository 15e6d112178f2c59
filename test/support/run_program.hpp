// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <string>

#include <sys/wait.h>

namespace limpid::test {

/// What an example program said and how it ended.
struct ProgramRun {
  int code;
  std::string output;  // both streams

  [[nodiscard]] bool mentions(const std::string& text) const { return output.find(text) != std::string::npos; }
};

inline ProgramRun run_command(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  ProgramRun result{0, {}};
  std::array<char, 256> piece;
  while (std::fgets(piece.data(), piece.size(), pipe) != nullptr) result.output += piece.data();
  const int status = ::pclose(pipe);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

inline ProgramRun run_program(const std::string& program, const std::string& arguments) {
  return run_command(std::string(LIMPID_EXAMPLES_DIR) + "/" + program + " " + arguments);
}

}  // namespace limpid::test
