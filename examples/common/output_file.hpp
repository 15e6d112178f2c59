// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace limpid::examples {

/// Why `path` cannot be an output; empty where it can. Opens it, so that a long run is not made for nothing.
[[nodiscard]] inline std::string refusal_of_output(const std::string& path) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (path.empty() || std::any_of(path.begin(), path.end(), control)) {
    return "accepts a path without control characters, got one that is empty or has some";
  }
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    return "accepts a file, got " + path;
  }
  if (!std::ofstream(path, std::ios::app)) return "accepts a path that can be written, got " + path;
  return {};
}

/// Whether two paths lead to one file, which need not be there yet.
[[nodiscard]] inline bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code none, error;
  if (std::filesystem::equivalent(a, b, none)) return true;
  const auto canonical = [&](const std::string& path) { return std::filesystem::weakly_canonical(path, error); };
  const auto first = canonical(a), second = canonical(b);
  return error ? a == b : first == second;
}

/// @throws std::runtime_error  where not all of `text` could be written
inline void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();  // what is left in the buffer may be refused too
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace limpid::examples
