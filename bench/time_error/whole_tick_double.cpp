// SPDX-License-Identifier: MIT
#include "time_error/whole_tick.hpp"

namespace limpid::bench::whole_tick {

namespace {

struct Straightforward {
  StraightforwardTick tick{settings()};
  auto operator()(Time now, const TickInput<3>& in) {
    return tick.step(now, in.F_h, in.tool, in.device.q, in.device.qdot);
  }
};

}  // namespace

std::vector<Method> in_double(const Signals& exact) {
  std::vector<Method> methods = methods_in<double>(exact);
  methods.push_back(method_of<Straightforward, double>("straightforward", false, exact));
  return methods;
}

}  // namespace limpid::bench::whole_tick
