// SPDX-License-Identifier: MIT
#include "time_error/whole_tick.hpp"

namespace limpid::bench::whole_tick {

std::vector<Method> in_long_double(const Signals& exact) { return methods_in<long double>(exact); }

}  // namespace limpid::bench::whole_tick
