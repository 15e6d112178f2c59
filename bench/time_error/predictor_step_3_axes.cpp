// SPDX-License-Identifier: MIT
#include "time_error/predictor_step.hpp"

namespace limpid::bench {

std::vector<Method> predictor_step_methods_3_axes(bool varying) { return second_order::methods<3>(varying); }

}  // namespace limpid::bench
