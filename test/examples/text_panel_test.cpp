// SPDX-License-Identifier: MIT
#include "common/text_panel.hpp"
#include "common/loop_panel.hpp"

#include <limpid/loop/realtime/stop_on_signal.hpp>

#include <doctest/doctest.h>
#include <support/pseudo_terminal.hpp>

#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>

using namespace limpid;
using namespace limpid::examples;
using namespace std::chrono_literals;
using limpid::test::PseudoTerminal;

namespace {

using Lines = std::vector<std::string>;

Lines two_lines(const int& value) {
  return {"value " + std::to_string(value), "square " + std::to_string(value * value)};
}

TextPanelSettings on(const PseudoTerminal& terminal) {
  return {.period = 1ms, .plain_period = 1ms, .descriptor = terminal.descriptor()};
}

// As it was found: the cursor is seen, at the begin of the line below the panel, and no mode has changed.
void check_clean(PseudoTerminal& terminal, const Lines& panel) {
  terminal.take();
  CHECK(terminal.cursor_seen());
  CHECK(terminal.column() == 0);
  CHECK(terminal.row() == panel.size());
  CHECK(terminal.modes_unchanged());
  CHECK(terminal.lines() == panel);
}

}  // namespace

TEST_CASE("a panel is drawn in place: of many values the last one stays") {
  PseudoTerminal terminal;
  {
    TextPanel<int> panel(two_lines, on(terminal));
    for (int i = 100; i >= 3; --i) {
      panel.show(i);
      if (i % 20 == 0) REQUIRE(terminal.comes_to("value " + std::to_string(i)));
    }
  }
  check_clean(terminal, {"value 3", "square 9"});
}

TEST_CASE("an exception leaves the terminal clean") {
  PseudoTerminal terminal;
  const auto thrown = [&] {
    TextPanel<int> panel(two_lines, on(terminal));
    panel.show(4);
    throw std::runtime_error("of the loop");
  };
  CHECK_THROWS_AS(thrown(), std::runtime_error);
  check_clean(terminal, {"value 4", "square 16"});
}

TEST_CASE("a signal that stops the loop leaves the terminal clean") {
  PseudoTerminal terminal;
  {
    std::stop_source stop;
    const StopOnSignal on_signal(stop);
    TextPanel<int> panel(two_lines, on(terminal));
    for (int i = 0; !stop.stop_requested(); ++i) {
      panel.show(5);
      if (i == 3) REQUIRE(std::raise(SIGINT) == 0);
      std::this_thread::yield();
    }
  }
  check_clean(terminal, {"value 5", "square 25"});
}

TEST_CASE("a program that is killed leaves the terminal clean") {
  PseudoTerminal terminal;
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    TextPanel<int> panel(two_lines, on(terminal));
    panel.show(6);
    for (;;) ::pause();
  }
  const bool drawn = terminal.comes_to("square 36");
  REQUIRE(::kill(child, SIGKILL) == 0);
  int ended = 0;
  REQUIRE(::waitpid(child, &ended, 0) == child);
  CHECK(drawn);
  check_clean(terminal, {"value 6", "square 36"});
}

TEST_CASE("lines that are wider than the window are cut, and stay in place") {
  PseudoTerminal terminal({.rows = 10, .columns = 8});
  PanelScreen screen(terminal.descriptor());
  screen.draw({"0123456789", "abc"});
  screen.draw({"9876543210", "d"});
  check_clean(terminal, {"9876543", "d"});
}

TEST_CASE("a panel that has fewer lines now leaves none behind") {
  PseudoTerminal terminal;
  PanelScreen screen(terminal.descriptor());
  screen.draw({"a", "b", "c"});
  screen.draw({"d"});
  check_clean(terminal, {"d"});
}

TEST_CASE("a terminal that is stopped holds nobody up") {
  PseudoTerminal terminal;
  terminal.stop_output();
  { TextPanel<int>(two_lines, on(terminal)).show(1); }
  terminal.go_on();
  check_clean(terminal, {});
}

TEST_CASE("without a terminal the values are plain lines, and the last ones are among them") {
  std::array<int, 2> pipe{};
  REQUIRE(::pipe(pipe.data()) == 0);
  {
    TextPanel<int> panel(two_lines, {.plain_period = 1h, .descriptor = pipe[1]});
    panel.show(7);
  }
  std::array<char, 256> text{};
  REQUIRE(::read(pipe[0], text.data(), text.size() - 1) > 0);
  CHECK(std::string(text.data()) == "value 7; square 49\n");
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST_CASE("a pipe whose reader has gone does not end the program") {
  std::array<int, 2> pipe{};
  REQUIRE(::pipe(pipe.data()) == 0);
  ::close(pipe[0]);
  { TextPanel<int>(two_lines, {.descriptor = pipe[1]}).show(1); }
  ::close(pipe[1]);
}

TEST_CASE("a loop's values come to the terminal") {
  PseudoTerminal terminal;
  const LoopValues values{.time = 2s, .position = {0.1, 0, 0}, .ticks = 2000};
  {
    TextPanel<LoopValues>([](const LoopValues& of) { return lines_of(of); }, on(terminal)).show(values);
  }
  check_clean(terminal, lines_of(values));
}

TEST_CASE("a loop's position, force, error and misses are shown in units that can be read") {
  const Lines lines = lines_of({.time = 1500ms,
                                .position = {0.1, -0.02, 0.003},
                                .force = {3, 0, 4},
                                .error = 0.00025,
                                .ticks = 1498,
                                .missed = 2,
                                .status = Status::limited});
  const auto holds = [&](std::size_t line, const std::string& text) {
    CAPTURE(lines.at(line));
    CHECK(lines.at(line).find(text) != std::string::npos);
  };
  holds(0, "1.5 s");
  holds(1, "100.00    -20.00      3.00 mm");
  holds(2, "5.000 N");
  holds(3, "0.2500 mm");
  holds(4, "1498, 2 missed");
  holds(5, describe(Status::limited));
}
