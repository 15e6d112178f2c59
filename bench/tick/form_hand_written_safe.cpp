// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form hand_written_safe_form() {
  return Form::of<double>(
      "hand_written_with_safety", HandWrittenTick<double>(),
      [](auto& tick, Time now, const auto& in) { return tick.safe_step(now, in.F_h, in.F_h, in.tool, in.device); });
}

}  // namespace limpid::bench
