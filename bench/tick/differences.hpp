// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace limpid::bench {

/// How far a form was at most from the straightforward one (with safety: from that one before the limiter) over 10 s.
/// NaN where something was NaN.
struct FormDifference {
  std::string_view form;
  double torque = 0;  ///< over the largest torque
  double theta = 0;   ///< of (k, b), over the width of the box
  double Gamma = 0;   ///< of an entry, over the geometric mean of its diagonal ones
  double most_torque = 0, most_law = 0;

  [[nodiscard]] bool agrees() const { return torque <= most_torque && theta <= most_law && Gamma <= most_law; }
};

/// Of every form of `all_forms` but the empty one and the straightforward one.
[[nodiscard]] std::vector<FormDifference> differences_from_straightforward();

}  // namespace limpid::bench
