// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

std::vector<Form> all_forms() {
  const auto empty = [](int, Time now, const auto& in) { return Eigen::Vector3d(in.F_h * in_seconds(now)); };
  return {Form::of<double>("empty", 0, empty),
          straightforward_form(),
          dynamic_form(),
          simd_form(),
          composed_form(),
          hand_written_form(),
          composed_safe_form(),
          hand_written_safe_form(),
          composed_float_form()};
}

}  // namespace limpid::bench
