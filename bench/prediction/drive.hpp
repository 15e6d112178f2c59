// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/trace.hpp"

#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/signal/sample.hpp>

#include <chrono>
#include <cstddef>

namespace limpid::bench {

[[nodiscard]] inline Time time_of(std::size_t ticks) {
  return std::chrono::milliseconds{static_cast<std::chrono::milliseconds::rep>(ticks)};
}

/// As the environment sends it; of the acceleration it says nothing.
[[nodiscard]] inline ToolSample<1> tool_sample(const SensedSample& sample) {
  ToolSample<1> sent;
  sent.taken = time_of(sample.taken);
  sent.arrived = time_of(sample.arrived);
  sent.value.x[0] = sample.x;
  sent.value.v[0] = sample.v;
  sent.value.force[0] = sample.F_e;
  return sent;
}

/// Runs a predictor through a course.
/// @param inform  called with each tick's instant and what it sees held, before the predictor's samples
template <Predictor P, typename Inform>
[[nodiscard]] Trace drive(P& predictor, const Course& course, Inform&& inform) {
  using Traits = PredictorTraits<P>;
  Trace trace;
  trace.reserve(course.truth.ticks.size());
  Held<ToolState<1>> held{.value = {}, .taken = {}, .arrived = {}, .fresh = false, .status = Status::no_sample};
  auto next = course.samples.begin();
  for (std::size_t k = 0; k < course.truth.ticks.size(); ++k) {
    const auto first = next;
    while (next != course.samples.end() && next->arrived <= k) ++next;
    held.fresh = next != first;
    if (held.fresh) {
      const ToolSample<1> newest = tool_sample(*std::prev(next));
      held = {newest.value, newest.taken, newest.arrived, true, Status::ok};
    }
    inform(time_of(k), held);
    for (auto sample = first; sample != next; ++sample) (void)Traits::observe(predictor, tool_sample(*sample));
    const auto [motion, status] =
        Traits::advance(predictor, time_of(k), Eigen::Array<double, 1, 1>(course.truth.ticks[k].F_h));
    trace.push_back({motion.x[0], motion.v[0], motion.a[0]});
  }
  return trace;
}

template <Predictor P>
[[nodiscard]] Trace drive(P& predictor, const Course& course) {
  return drive(predictor, course, [](Time, const Held<ToolState<1>>&) {});
}

}  // namespace limpid::bench
