// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form straightforward_form() {
  return Form::of<double>("straightforward", StraightforwardTick(TickParts<double>::settings()),
                          [](auto& tick, Time now, const auto& in) {
                            return tick.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
                          });
}

}  // namespace limpid::bench
