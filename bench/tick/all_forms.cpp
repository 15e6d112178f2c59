// SPDX-License-Identifier: MIT
#include "tick/dynamic_tick.hpp"
#include "tick/form.hpp"
#include "tick/simd_tick.hpp"

#include <algorithm>

namespace limpid::bench {

std::vector<Form> all_forms() {
  return {Form::of<double>("empty", [](Time now, const auto& in) { return in.F_h[0] + in_seconds(now); }),
          straightforward_form(),
          dynamic_form(),
          simd_form(),
          composed_form(),
          hand_written_form(),
          composed_safe_form(),
          hand_written_safe_form(),
          composed_float_form()};
}

double difference_from_straightforward() {
  StraightforwardTick reference(TickParts<double>::settings());
  auto loop = composed_tick<double>();
  SimdTick by_hand(TickParts<double>::settings());
  DynamicTick dynamic(TickParts<double>::settings());
  const auto inputs = tick_inputs<double>();
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < 10'000; ++i) {
    const auto& in = inputs[i % inputs.size()];
    const Time now = static_cast<Time::rep>(i) * std::chrono::milliseconds{1};
    const auto [ours, status] = loop.step(now, in.F_h, in.F_h, in.tool, in.device);
    const Eigen::Vector3d theirs = reference.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
    const Eigen::Vector3d hands = by_hand.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
    difference = std::max(difference, (ours - theirs).lpNorm<Eigen::Infinity>());
    const Eigen::Vector3d any_size = dynamic.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
    difference = std::max(difference, (any_size - theirs).lpNorm<Eigen::Infinity>());
    difference = std::max(difference, (hands - theirs).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, theirs.lpNorm<Eigen::Infinity>());
  }
  return difference / largest;
}

}  // namespace limpid::bench
