// SPDX-License-Identifier: MIT
#pragma once

namespace limpid {

/// Law of the operator's force between two ticks. A step is exact only for the law it states, so plant and predictor of
/// one simulation must share it.
enum class Intersample {
  hold,    ///< the value of the earlier tick
  linear,  ///< the straight line from the earlier tick's value to the later one's
};

}  // namespace limpid
