// SPDX-License-Identifier: MIT
// As design_instances.hpp, for the norms of linear systems.
#pragma once

#include <limpid/design/h2_norm.hpp>
#include <limpid/design/hinf_norm.hpp>

namespace limpid {

extern template std::vector<std::complex<double>> detail::eigenvalues_of(const detail::DynamicMatrix<double>&);
extern template class detail::LyapunovSolver<double>;
extern template H2Norm<double> h2_norm(const StateSpace<double>&);
extern template HinfNorm<double> hinf_norm(const StateSpace<double>&);

}  // namespace limpid
