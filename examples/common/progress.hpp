// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace limpid::examples {

/// A line on standard error that says how far a long run is; silent for runs under a second and where nobody looks.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Takes the fraction done; valid while this object lives.
  [[nodiscard]] std::function<void(double)> callback();

 private:
  void show(double fraction);

  std::string what_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_ = start_;
  bool watched_;
  bool shown_ = false;
};

}  // namespace limpid::examples
