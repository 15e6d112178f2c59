// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <support/maximum.hpp>

namespace limpid::stress {

/// The largest value that a quantity took, and what it must not pass.
struct Figure {
  std::string_view name;
  double worst = 0;
};

/// What came of a run.
struct Outcome {
  static constexpr std::size_t most_figures = 8;

  std::string_view broken;  ///< the first invariant that did not hold; empty: all held
  std::uint64_t tick = 0;   ///< when
  double value = 0;         ///< what was seen, where it is a number
  std::uint64_t ticks = 0;  ///< that were run
  std::array<Figure, most_figures> figures{};
  std::size_t figure_count = 0;

  [[nodiscard]] bool holds() const { return broken.empty(); }

  void note(std::string_view name, double number) {
    std::size_t i = 0;
    while (i < figure_count && figures[i].name != name) ++i;
    if (i == most_figures) return;
    if (i == figure_count) figures[figure_count++] = {name, number};
    figures[i].worst = test::maximum(figures[i].worst, number);
  }
};

/// Judges a run tick by tick; the first invariant that breaks ends it.
class Watch {
 public:
  void start(std::uint64_t tick) {
    outcome_.tick = tick;
    ++outcome_.ticks;
  }

  /// An invariant.
  void require(std::string_view what, bool holds) {
    if (!holds) breaks(what, std::numeric_limits<double>::quiet_NaN());
  }

  /// value <= most, and a figure of how near it came.
  void at_most(std::string_view what, double value, double most) {
    if (outcome_.holds()) outcome_.note(what, value / most);
    if (!(value <= most)) breaks(what, value / most);
  }

  [[nodiscard]] bool broken() const { return !outcome_.holds(); }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }

 private:
  void breaks(std::string_view what, double value) {
    if (broken()) return;
    outcome_.broken = what;
    outcome_.value = value;
  }

  Outcome outcome_;
};

}  // namespace limpid::stress
