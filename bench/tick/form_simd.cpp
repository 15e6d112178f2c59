// SPDX-License-Identifier: MIT
#include "tick/form.hpp"
#include "tick/simd_tick.hpp"

namespace limpid::bench {

Form simd_form() {
  return Form::of<double>("simd", [tick = SimdTick(TickParts<double>::settings())](Time now, const auto& in) mutable {
    return tick.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
  });
}

}  // namespace limpid::bench
