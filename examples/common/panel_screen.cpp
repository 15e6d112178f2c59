// SPDX-License-Identifier: MIT
#include "panel_screen.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <poll.h>
#include <sys/ioctl.h>

namespace limpid::examples {

namespace {

bool can_draw_in_place(int descriptor) {
  const char* kind = std::getenv("TERM");
  return ::isatty(descriptor) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

struct Window {
  std::size_t rows = 24, columns = 80;
};

Window window_of(int descriptor) {
  winsize size{};
  Window window;
  if (::ioctl(descriptor, TIOCGWINSZ, &size) != 0) return window;
  if (size.ws_row > 0) window.rows = size.ws_row;
  if (size.ws_col > 0) window.columns = size.ws_col;
  return window;
}

bool takes_more(int descriptor) {
  pollfd question{.fd = descriptor, .events = POLLOUT, .revents = 0};
  return ::poll(&question, 1, 0) == 1 && (question.revents & POLLOUT) != 0;
}

}  // namespace

PanelScreen::PanelScreen(int descriptor) : descriptor_{descriptor}, in_place_{can_draw_in_place(descriptor)} {}

void PanelScreen::draw(const std::vector<std::string>& lines) {
  if (lines.empty() || !takes_more(descriptor_)) return;
  const std::size_t before = drawn_;
  const std::string text = frame(lines);
  if (::write(descriptor_, text.data(), text.size()) < 0) drawn_ = before;  // not drawn
}

// In one piece: the cursor is hidden within it alone.
std::string PanelScreen::frame(const std::vector<std::string>& lines) {
  std::string text;
  if (!in_place_) {
    for (const std::string& line : lines) text += (text.empty() ? "" : "; ") + line;
    return text + '\n';
  }
  const Window window = window_of(descriptor_);
  const std::size_t count = std::min(lines.size(), std::max<std::size_t>(window.rows, 2) - 1);
  text = "\033[?25l\r";
  if (drawn_ > 0) text += "\033[" + std::to_string(drawn_) + 'A';
  for (std::size_t i = 0; i < count; ++i) text += lines[i].substr(0, window.columns - 1) + "\033[K\r\n";
  drawn_ = count;
  return text + "\033[J\033[?25h";
}

}  // namespace limpid::examples
