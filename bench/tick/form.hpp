// SPDX-License-Identifier: MIT
#pragma once

#include "tick/form_state.hpp"
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
  /// @param step  `step(tick, now, input)` is a tick
  template <typename Scalar, typename Tick, typename Step>
  static Form of(std::string_view name, Tick tick, Step step) {
    Form form;
    form.name_ = name;
    form.run_ = [tick, step, inputs = tick_inputs<Scalar>(), now = Time{0}, next = std::size_t{0}](
                    long ticks, LatencyHistogram* histogram) mutable {
      for (long i = 0; i < ticks; ++i, now += std::chrono::milliseconds{1}, next = (next + 1) % inputs.size()) {
        if (histogram == nullptr) {
          benchmark::DoNotOptimize(step(tick, now, inputs[next]));
          continue;
        }
        const auto start = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(step(tick, now, inputs[next]));
        histogram->add(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start));
      }
    };
    form.look_ = [tick, step, inputs = tick_inputs<Scalar>(), i = std::size_t{0}]() mutable {
      const Time now = static_cast<Time::rep>(i) * std::chrono::milliseconds{1};
      FormState state;
      state.torque = torque_of(step(tick, now, inputs[i++ % inputs.size()]));
      see_law<Scalar>(tick, state);
      return state;
    };
    return form;
  }

  [[nodiscard]] std::string_view name() const { return name_; }
  void run(long ticks, LatencyHistogram* histogram = nullptr) { run_(ticks, histogram); }

  /// The next tick of a run of its own, which begins with the first call.
  [[nodiscard]] FormState look() { return look_(); }

 private:
  std::string_view name_;
  std::function<void(long, LatencyHistogram*)> run_;
  std::function<FormState()> look_;
};

/// A loop as a form.
template <typename Scalar, typename Loop>
[[nodiscard]] Form form_of(std::string_view name, Loop loop) {
  return Form::of<Scalar>(name, std::move(loop), [](Loop& tick, Time now, const auto& in) {
    return tick.step(now, in.F_h, in.F_h, in.tool, in.device);
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

/// Not among `all_forms`: what the forms with safety are compared with.
[[nodiscard]] Form straightforward_safe_form();

/// All of them, an empty one first and the straightforward one second.
[[nodiscard]] std::vector<Form> all_forms();

}  // namespace limpid::bench
