// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <cstdio>
#include <utility>

#include <unistd.h>

namespace limpid::examples {

Progress::Progress(std::string what) : what_{std::move(what)}, watched_{::isatty(STDERR_FILENO) == 1} {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

std::function<void(double)> Progress::callback() {
  return [this](double fraction) { show(fraction); };
}

void Progress::show(double fraction) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (!watched_ || now - start_ < 1s || now - last_ < 200ms) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r\033[K%s: %.0f %%", what_.c_str(), 100 * fraction);
  std::fflush(stderr);
}

}  // namespace limpid::examples
