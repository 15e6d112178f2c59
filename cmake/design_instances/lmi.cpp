// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

namespace limpid {

template LmiResult<double> detail::solve_lmi(const LmiProblem<double>&, LmiGoal, const LmiSettings<double>&);

}  // namespace limpid
