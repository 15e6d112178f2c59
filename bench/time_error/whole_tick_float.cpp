// SPDX-License-Identifier: MIT
#include "time_error/whole_tick.hpp"

namespace limpid::bench::whole_tick {

std::vector<Method> in_float(const Signals& exact) { return methods_in<float>(exact); }

}  // namespace limpid::bench::whole_tick
