// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form hand_written_form() {
  return Form::of<double>("hand_written", HandWrittenTick<double>(), [](auto& tick, Time now, const auto& in) {
    return tick.step(now, in.F_h, in.F_h, in.tool, in.device);
  });
}

}  // namespace limpid::bench
