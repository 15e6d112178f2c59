// SPDX-License-Identifier: MIT
#pragma once

#include "section.hpp"

namespace limpid::examples {

/// Fig. 6.1: the mean position error by a2 and a3, where the gain is the one of largest margin of Theorem 2.
void add_figure_6_1(SectionReport& report);

}  // namespace limpid::examples
