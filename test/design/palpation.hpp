// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/design_point.hpp>

/// What the thesis palpates, sections 6.1 and 6.2: its tool, its tissues and how fast they may change.
namespace limpid::test {

inline const Tool<1> tool{.mass = 0.1, .damping = 0.1, .stiffness = 1};
inline const TissueBox<> box{{200, 20}, {2000, 40}};
inline const TissueRates<> rates{1.8e5, 2000};  // section 6.2.1

inline PredictorDesign<> design_at(double T_d, double k_t = 1) {
  return {.tool = {.mass = tool.mass, .damping = tool.damping, .stiffness = k_t}, .T_d = T_d};
}

}  // namespace limpid::test
