// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form hand_written_form() {
  return Form::of<double>("hand_written", [calls = HandWrittenTick<double>()](Time now, const auto& in) mutable {
    return calls.step(now, in.F_h, in.F_h, in.tool, in.device);
  });
}

}  // namespace limpid::bench
