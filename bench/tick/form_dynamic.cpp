// SPDX-License-Identifier: MIT
#include "tick/dynamic_tick.hpp"
#include "tick/form.hpp"

namespace limpid::bench {

Form dynamic_form() {
  return Form::of<double>("dynamic", DynamicTick(TickParts<double>::settings()),
                          [](auto& tick, Time now, const auto& in) {
                            return tick.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
                          });
}

}  // namespace limpid::bench
