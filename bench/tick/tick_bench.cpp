// SPDX-License-Identifier: MIT
// One whole tick, three axes, a fresh sample on each: composed, written by hand, and straightforward.
#include "tick/library_tick.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace limpid;
using namespace limpid::bench;

constexpr Duration tick = std::chrono::milliseconds{1};

template <typename Scalar>
using Torque = palpation::WantedTorque<Omni<Scalar>>;

// Calls `step(now, input)` on each iteration.
template <typename Scalar, typename Step>
void run(benchmark::State& state, Step&& step) {
  const auto inputs = tick_inputs<Scalar>();
  std::size_t i = 0;
  Time now{0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(step(now, inputs[i]));
    now += tick;
    i = (i + 1) % inputs.size();
  }
}

void tick_empty(benchmark::State& state) {
  run<double>(state, [](Time now, const auto& input) { return input.F_h[0] + in_seconds(now); });
}
BENCHMARK(tick_empty);

template <typename Scalar>
void tick_composed(benchmark::State& state) {
  auto loop = composed_tick<Torque<Scalar>, Scalar>();
  run<Scalar>(state, [&](Time now, const auto& in) { return loop.step(now, in.F_h, in.F_h, in.tool, in.device); });
}
BENCHMARK_TEMPLATE(tick_composed, double);
BENCHMARK_TEMPLATE(tick_composed, float);

template <typename Scalar>
void tick_hand_written(benchmark::State& state) {
  HandWrittenTick<Scalar> calls;
  run<Scalar>(state, [&](Time now, const auto& in) { return calls.step(now, in.F_h, in.F_h, in.tool, in.device); });
}
BENCHMARK_TEMPLATE(tick_hand_written, double);
BENCHMARK_TEMPLATE(tick_hand_written, float);

// With the limiter, as a device gets it.
template <typename Scalar>
void tick_composed_with_safety(benchmark::State& state) {
  auto loop = composed_tick<palpation::AllowedTorque<Omni<Scalar>>, Scalar>();
  run<Scalar>(state, [&](Time now, const auto& in) { return loop.step(now, in.F_h, in.F_h, in.tool, in.device); });
}
BENCHMARK_TEMPLATE(tick_composed_with_safety, double);
BENCHMARK_TEMPLATE(tick_composed_with_safety, float);

// Largest difference of a torque over 10 s from the library's, relative to the largest torque.
double difference_from_library() {
  StraightforwardTick reference(TickParts<double>::settings());
  auto loop = composed_tick<Torque<double>, double>();
  const auto inputs = tick_inputs<double>();
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < 10'000; ++i) {
    const auto& in = inputs[i % inputs.size()];
    const Time now = static_cast<Time::rep>(i) * tick;
    const Eigen::Vector3d ours = loop.step(now, in.F_h, in.F_h, in.tool, in.device).get<Torque<double>>();
    const Eigen::Vector3d theirs = reference.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
    difference = std::max(difference, (ours - theirs).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, theirs.lpNorm<Eigen::Infinity>());
  }
  return difference / largest;
}

void tick_straightforward_eigen(benchmark::State& state) {
  const double difference = difference_from_library();
  if (!(difference < 1e-12)) state.SkipWithError("outputs differ");
  state.counters["difference"] = difference;
  StraightforwardTick reference(TickParts<double>::settings());
  run<double>(state, [&](Time now, const auto& in) {
    return reference.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
  });
}
BENCHMARK(tick_straightforward_eigen);

}  // namespace
