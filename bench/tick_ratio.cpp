// SPDX-License-Identifier: MIT
// The library's tick over the straightforward one, in time: both run in turns of 500 ticks, so that a busy machine
// slows both alike; the median of the turns' ratios is what counts.
#include "tick/library_tick.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace {

using namespace limpid;
using namespace limpid::bench;

constexpr int ticks = 500, turns = 2000;

/// One form of the tick with its own clock.
template <typename Step>
class Form {
 public:
  explicit Form(Step step) : step_{std::move(step)} {}

  /// Nanoseconds a tick over one turn.
  double turn(const std::vector<TickInput<double>>& inputs) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < ticks; ++i, now_ += std::chrono::milliseconds{1}) {
      benchmark::DoNotOptimize(step_(now_, inputs[next_]));
      next_ = (next_ + 1) % inputs.size();
    }
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / ticks;
  }

 private:
  Step step_;
  Time now_{0};
  std::size_t next_ = 0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main() {
  const auto inputs = tick_inputs<double>();
  auto loop = composed_tick<palpation::WantedTorque<Omni<>>, double>();
  HandWrittenTick<double> calls;
  StraightforwardTick straightforward(TickParts<double>::settings());
  Form composed([&](Time now, const auto& in) { return loop.step(now, in.F_h, in.F_h, in.tool, in.device); });
  Form by_hand([&](Time now, const auto& in) { return calls.step(now, in.F_h, in.F_h, in.tool, in.device); });
  Form reference([&](Time now, const auto& in) {
    return straightforward.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
  });

  std::vector<double> ours, hands, theirs, our_ratio, hand_ratio;
  for (int turn = 0; turn < turns; ++turn) {
    theirs.push_back(reference.turn(inputs));
    ours.push_back(composed.turn(inputs));
    hands.push_back(by_hand.turn(inputs));
    our_ratio.push_back(ours.back() / theirs.back());
    hand_ratio.push_back(hands.back() / theirs.back());
  }
  std::printf("median of %d turns of %d ticks, a fresh sample on each\n", turns, ticks);
  std::printf("%-24s %8s %8s\n", "", "ns", "ratio");
  std::printf("%-24s %8.0f %8.3f\n", "straightforward Eigen", median(theirs), 1.0);
  std::printf("%-24s %8.0f %8.3f\n", "composed", median(ours), median(our_ratio));
  std::printf("%-24s %8.0f %8.3f\n", "hand-written calls", median(hands), median(hand_ratio));
}
