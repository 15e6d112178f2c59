// SPDX-License-Identifier: MIT
#include <limpid/design/h2_norm.hpp>
#include <limpid/design/hinf_norm.hpp>

namespace limpid {

template std::vector<std::complex<double>> detail::eigenvalues_of(const detail::DynamicMatrix<double>&);
template class detail::LyapunovSolver<double>;
template H2Norm<double> h2_norm(const StateSpace<double>&);
template HinfNorm<double> hinf_norm(const StateSpace<double>&);

}  // namespace limpid
