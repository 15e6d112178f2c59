// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form hand_written_safe_form() {
  return Form::of<double>("hand_written_with_safety",
                          [calls = HandWrittenTick<double>()](Time now, const auto& in) mutable {
                            return calls.safe_step(now, in.F_h, in.F_h, in.tool, in.device);
                          });
}

}  // namespace limpid::bench
