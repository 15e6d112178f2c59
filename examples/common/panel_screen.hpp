// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <unistd.h>

namespace limpid::examples {

/// A few lines in a terminal, drawn again and again in place; where there is no terminal, or a dumb one, one plain line
/// a time. Between two drawings the terminal is as it was found, with the cursor on the line below: whatever ends the
/// program, there is nothing to put right. Lines are of ASCII, and cut where the window ends.
class PanelScreen {
 public:
  explicit PanelScreen(int descriptor = STDOUT_FILENO);

  /// Whether lines are drawn in place.
  [[nodiscard]] bool in_place() const noexcept { return in_place_; }

  /// Never waits: where the terminal is stopped (Ctrl-S), or a pipe full or closed, these lines are not drawn.
  void draw(const std::vector<std::string>& lines);

 private:
  [[nodiscard]] std::string frame(const std::vector<std::string>& lines);

  int descriptor_;
  bool in_place_;
  std::size_t drawn_ = 0;  // lines above the cursor that are the panel's
};

}  // namespace limpid::examples
