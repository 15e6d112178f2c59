// SPDX-License-Identifier: MIT
// Runs one form of the tick a number of times, for callgrind; see bench/instructions.sh.
#include "tick/library_tick.hpp"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using namespace limpid;
using namespace limpid::bench;

template <typename Scalar, typename Step>
void repeat(long ticks, Step&& step) {
  const auto inputs = tick_inputs<Scalar>();
  Time now{0};
  for (long i = 0; i < ticks; ++i, now += std::chrono::milliseconds{1}) {
    benchmark::DoNotOptimize(step(now, inputs[static_cast<std::size_t>(i) % inputs.size()]));
  }
}

template <typename Wanted, typename Scalar>
void composed(long ticks) {
  auto loop = composed_tick<Wanted, Scalar>();
  repeat<Scalar>(ticks, [&](Time now, const auto& in) { return loop.step(now, in.F_h, in.F_h, in.tool, in.device); });
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view form = argc > 1 ? argv[1] : "";
  const long ticks = argc > 2 ? std::atol(argv[2]) : 0;
  if (form == "empty") {
    repeat<double>(ticks, [](Time now, const auto& in) { return in.F_h[0] + in_seconds(now); });
  } else if (form == "composed") {
    composed<palpation::WantedTorque<Omni<>>, double>(ticks);
  } else if (form == "composed_float") {
    composed<palpation::WantedTorque<Omni<float>>, float>(ticks);
  } else if (form == "composed_with_safety") {
    composed<palpation::AllowedTorque<Omni<>>, double>(ticks);
  } else if (form == "hand_written") {
    HandWrittenTick<double> calls;
    repeat<double>(ticks,
                   [&](Time now, const auto& in) { return calls.step(now, in.F_h, in.F_h, in.tool, in.device); });
  } else if (form == "straightforward") {
    StraightforwardTick reference(TickParts<double>::settings());
    repeat<double>(ticks, [&](Time now, const auto& in) {
      return reference.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
    });
  } else {
    std::fprintf(stderr,
                 "tick_once: expected empty|composed|composed_float|composed_with_safety|hand_written|straightforward "
                 "and a number of ticks\n");
    return 1;
  }
}
