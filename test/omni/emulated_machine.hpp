// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <support/run_program.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace limpid::test {

/// A file of a name that no other test has, gone with its test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_{(std::filesystem::temp_directory_path() / ("limpid_" + std::to_string(::getpid()) + "_" + name))
                  .string()} {}
  ~TemporaryFile() {
    std::error_code none;
    std::filesystem::remove(path_, none);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string text() const {
    std::ostringstream all;
    all << std::ifstream(path_).rdbuf();
    return all.str();
  }

 private:
  std::string path_;
};

/// What a program said, and what the emulated Omni saw of it.
struct EmulatedRun {
  ProgramRun program;
  nlohmann::json omni;
};

/// An example program with an emulated Omni on the machine's USB.
/// @param options  of omni_emulator
inline EmulatedRun with_omni(const std::string& options, const std::string& program, const std::string& arguments) {
  const TemporaryFile summary("omni_summary.json");
  ProgramRun run = run_command(std::string(LIMPID_OMNI_EMULATOR) + " " + options + " --summary " + summary.path() +
                               " -- " + LIMPID_EXAMPLES_DIR + "/" + program + " " + arguments);
  return {std::move(run), nlohmann::json::parse(summary.text(), nullptr, false)};
}

}  // namespace limpid::test
