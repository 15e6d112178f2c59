// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

namespace limpid::test {

/// A terminal for a program under test, with what its screen shows: text, line feeds, and of the control sequences
/// those of a cursor that goes up, of lines and screens that are erased, and of a cursor that is hidden.
class PseudoTerminal {
 public:
  struct Size {
    unsigned short rows = 24, columns = 80;
  };

  PseudoTerminal() : PseudoTerminal(Size{}) {}
  explicit PseudoTerminal(const Size& size) {
    winsize window{.ws_row = size.rows, .ws_col = size.columns, .ws_xpixel = 0, .ws_ypixel = 0};
    if (::openpty(&ours_, &theirs_, nullptr, nullptr, &window) != 0) throw std::runtime_error("no pseudo-terminal");
    (void)::fcntl(ours_, F_SETFL, O_NONBLOCK);
    (void)::tcgetattr(theirs_, &modes_);
    (void)::setenv("TERM", "xterm", 1);
  }
  ~PseudoTerminal() {
    ::close(theirs_);
    ::close(ours_);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return theirs_; }

  /// Takes in what was written.
  void take() {
    char letter = 0;
    while (::read(ours_, &letter, 1) == 1) add(letter);
  }

  /// Whether the screen comes to have a text in it within some seconds.
  [[nodiscard]] bool comes_to(const std::string& text) {
    for (int i = 0; i < 10'000; ++i) {
      take();
      for (const std::string& line : lines_) {
        if (line.find(text) != std::string::npos && escape_.empty() && seen_) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  /// What stands on it, without what is empty below.
  [[nodiscard]] std::vector<std::string> lines() const {
    auto text = lines_;
    while (!text.empty() && text.back().empty()) text.pop_back();
    return text;
  }

  [[nodiscard]] std::size_t row() const noexcept { return row_; }
  [[nodiscard]] std::size_t column() const noexcept { return column_; }
  [[nodiscard]] bool cursor_seen() const noexcept { return seen_; }

  [[nodiscard]] bool modes_unchanged() const noexcept {
    termios now{};
    return ::tcgetattr(theirs_, &now) == 0 && now.c_iflag == modes_.c_iflag && now.c_oflag == modes_.c_oflag &&
           now.c_cflag == modes_.c_cflag && now.c_lflag == modes_.c_lflag &&
           std::memcmp(now.c_cc, modes_.c_cc, sizeof now.c_cc) == 0;
  }

  /// As Ctrl-S and Ctrl-Q do.
  void stop_output() const noexcept { (void)::tcflow(theirs_, TCOOFF); }
  void go_on() const noexcept { (void)::tcflow(theirs_, TCOON); }

 private:
  void add(char letter) {
    if (lines_.size() <= row_) lines_.resize(row_ + 1);
    if (!escape_.empty()) {
      escape_ += letter;
      if (letter != '[' && letter != '?' && (letter < '0' || letter > '9')) obey();
    } else if (letter == '\033') {
      escape_ = letter;
    } else if (letter == '\r') {
      column_ = 0;
    } else if (letter == '\n') {
      ++row_;
    } else {
      std::string& line = lines_[row_];
      line.resize(std::max(line.size(), column_ + 1), ' ');
      line[column_++] = letter;
    }
  }

  void obey() {
    const std::string what = escape_;
    escape_.clear();
    if (what == "\033[K") {
      lines_[row_].resize(std::min(column_, lines_[row_].size()));
    } else if (what == "\033[J") {
      lines_.resize(row_ + 1);
      lines_[row_].resize(std::min(column_, lines_[row_].size()));
    } else if (what == "\033[?25l") {
      seen_ = false;
    } else if (what == "\033[?25h") {
      seen_ = true;
    } else if (what.back() == 'A') {
      row_ -= std::min<std::size_t>(row_, std::stoul(what.substr(2)));
    } else {
      throw std::runtime_error("a sequence that the terminal does not know: " + what.substr(1));
    }
  }

  int ours_ = -1, theirs_ = -1;
  termios modes_{};
  std::vector<std::string> lines_;
  std::string escape_;  // a control sequence that has begun
  std::size_t row_ = 0, column_ = 0;
  bool seen_ = true;
};

}  // namespace limpid::test
