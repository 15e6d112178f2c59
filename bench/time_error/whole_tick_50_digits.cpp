// SPDX-License-Identifier: MIT
#include "time_error/whole_tick.hpp"

namespace limpid::bench::whole_tick {

Signals in_50_digits() { return Runner<ByHand<Fifty>, Fifty>().trajectory(); }

}  // namespace limpid::bench::whole_tick
