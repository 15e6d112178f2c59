// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form straightforward_form() {
  return Form::of<double>(
      "straightforward", [tick = StraightforwardTick(TickParts<double>::settings())](Time now, const auto& in) mutable {
        return tick.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
      });
}

}  // namespace limpid::bench
