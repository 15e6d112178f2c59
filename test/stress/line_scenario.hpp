// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "trial.hpp"

#include <limpid/signal/delayed_sampled.hpp>
#include <limpid/signal/history.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace limpid::stress {

/// DelayedSampled, by its own sampling or by `offer`, and History, on a signal whose value is its instant.
class LineStress {
 public:
  static std::vector<Choice> choices() {
    return {clock_choice(), line_choice(), corruption_choice(), {"samples", {"own", "offered"}}};
  }

  static Outcome play(const Trial& trial) {
    LineStress line(trial);
    return play_ticks(trial, line.watch_, [&](bool seen, Random& random) { line.tick(seen, random); });
  }

 private:
  explicit LineStress(const Trial& trial)
      : clock_{trial.choices[0]},
        line_{trial.choices[1]},
        corruption_{trial.choices[2], 0.01},
        offered_{trial.choices[3] == 1},
        sampled_({.period = std::chrono::milliseconds(7), .delay = std::chrono::milliseconds(31)}) {}

  void tick(bool seen, Random& random) {
    const Time now = clock_.next(random);
    const Stamps stamps = line_.carry(now, std::chrono::milliseconds(16), random);
    const bool sample = random.chance(0.3) && !stamps.lost;
    const double sent = double((offered_ ? stamps.taken : now).count()), value = corruption_(sent, random);
    const bool true_value = value == sent || !std::isfinite(value);
    const Time asked = now - Duration{static_cast<Duration::rep>(random.uniform(-1e8, 1e9))};
    true_values_ = true_values_ && true_value;
    if (!seen) return;
    if (offered_ && sample) (void)sampled_.offer({value, stamps.taken, stamps.arrived});
    judge(now, offered_ ? sampled_.update(now) : sampled_.update(now, value));
    judge_history(now, value, asked);
  }

  void judge(Time now, const Held<double>& held) {
    watch_.require("what is held is finite", std::isfinite(held.value));
    const bool late = started_ && now <= last_;
    watch_.require("time that does not advance is refused", late == has(held.status, Status::clock_backwards));
    if (!late) last_ = now;
    started_ = true;
    if (has(held.status, Status::no_sample)) {
      watch_.require("what has arrived stays", !arrived_);
      return;
    }
    watch_.require("nothing is seen before it arrives", held.arrived <= last_);
    watch_.require("what is held grows no older", !arrived_ || held.taken >= taken_);
    watch_.require("fresh is what is newer", !arrived_ || held.fresh == (held.taken > taken_));
    if (true_values_) watch_.require("a value keeps its stamp", held.value == double(held.taken.count()));
    arrived_ = true;
    taken_ = held.taken;
  }

  // A straight line through its own instants is kept, to the roundings of a product and two sums.
  void judge_history(Time now, double value, Time asked) {
    const Status pushed = history_.push(now, value);
    const auto [found, status] = history_.at(asked);
    watch_.require("history is finite", std::isfinite(found));
    if (pushed == Status::ok) {
      judged_ = judged_ && value == double(now.count());
      largest_ = std::max(largest_, std::abs(double(now.count())));
    }
    if (status != Status::ok || !judged_ || offered_) return;
    const double rounding = std::numeric_limits<double>::epsilon() * largest_;  // of the entries between which it lies
    watch_.at_most("error of a straight line, roundings", std::abs(found - double(asked.count())) / rounding, 8);
  }

  Clock clock_;
  Line line_;
  Corruption corruption_;
  bool offered_;
  DelayedSampled<double> sampled_;
  History<double, 64> history_;
  bool started_ = false, arrived_ = false, true_values_ = true, judged_ = true;
  double largest_ = 1;  // entry of the history, ns
  Time last_{}, taken_{};
  Watch watch_;
};

inline std::vector<Scenario> line_scenarios() {
  return {{"DelayedSampled and History", LineStress::choices(), &LineStress::play, 10}};
}

}  // namespace limpid::stress
