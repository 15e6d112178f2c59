// SPDX-License-Identifier: MIT
#pragma once

#include "tick/library_tick.hpp"

#include <limpid/evaluation/latency_histogram.hpp>

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace limpid::bench {

/// One form of the tick with its own clock, behind a call that runs many of them.
class Form {
 public:
  template <typename Scalar, typename Step>
  static Form of(std::string_view name, Step step) {
    Form form;
    form.name_ = name;
    form.run_ = [step, inputs = tick_inputs<Scalar>(), now = Time{0}, next = std::size_t{0}](
                    long ticks, LatencyHistogram* histogram) mutable {
      for (long i = 0; i < ticks; ++i, now += std::chrono::milliseconds{1}, next = (next + 1) % inputs.size()) {
        if (histogram == nullptr) {
          benchmark::DoNotOptimize(step(now, inputs[next]));
          continue;
        }
        const auto start = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(step(now, inputs[next]));
        histogram->add(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start));
      }
    };
    return form;
  }

  [[nodiscard]] std::string_view name() const { return name_; }
  void run(long ticks, LatencyHistogram* histogram = nullptr) { run_(ticks, histogram); }

 private:
  std::string_view name_;
  std::function<void(long, LatencyHistogram*)> run_;
};

/// A loop as a form.
template <typename Scalar, typename Loop>
[[nodiscard]] Form form_of(std::string_view name, Loop loop) {
  return Form::of<Scalar>(name, [loop = std::move(loop)](Time now, const auto& in) mutable {
    return loop.step(now, in.F_h, in.F_h, in.tool, in.device);
  });
}

// One source each: in a larger one g++ runs into its limits of inlining and measures those.
[[nodiscard]] Form straightforward_form();
[[nodiscard]] Form dynamic_form();
[[nodiscard]] Form simd_form();
[[nodiscard]] Form composed_form();
[[nodiscard]] Form hand_written_form();
[[nodiscard]] Form composed_safe_form();
[[nodiscard]] Form hand_written_safe_form();
[[nodiscard]] Form composed_float_form();

/// All of them, an empty one first and the straightforward one second.
[[nodiscard]] std::vector<Form> all_forms();

/// Largest difference of the composed tick's torque, the SIMD one's, or the dynamic one's, over 10 s from the
/// straightforward one's, over the largest torque.
[[nodiscard]] double difference_from_straightforward();

}  // namespace limpid::bench
