// SPDX-License-Identifier: MIT
#include "tick/form.hpp"
#include "tick/simd_tick.hpp"

namespace limpid::bench {

Form simd_form() {
  return Form::of<double>("simd", SimdTick(TickParts<double>::settings()), [](auto& tick, Time now, const auto& in) {
    return tick.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
  });
}

}  // namespace limpid::bench
