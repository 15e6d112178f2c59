// SPDX-License-Identifier: MIT
#include "time_error/predictor_step.hpp"

namespace limpid::bench {

std::vector<Method> predictor_step_methods_1_axis(bool varying) { return second_order::methods<1>(varying); }

std::vector<Case> predictor_step_cases() {
  return {{"predictor step", "constant parameters, 1 axis", [] { return predictor_step_methods_1_axis(false); }},
          {"predictor step", "constant parameters, 3 axes", [] { return predictor_step_methods_3_axes(false); }},
          {"predictor step", "varying parameters, 1 axis", [] { return predictor_step_methods_1_axis(true); }},
          {"predictor step", "varying parameters, 3 axes", [] { return predictor_step_methods_3_axes(true); }}};
}

}  // namespace limpid::bench
