// SPDX-License-Identifier: MIT
#include "sampled_instances.hpp"

namespace limpid {

template SampledGain<double> smallest_sampled_radius(const SampledSystem<double>&, const Tissue<double>&);
template RobustSampledGain<double> robust_sampled_gain(const SampledSystem<double>&, const TissueBox<double>&);
template SampledProof<double> prove_sampled_stability(const SampledSystem<double>&, const TissueBox<double>&,
                                                      const Gain<double>&, const double&, int);
template VaryingProof<double> prove_varying_stability(const SampledSystem<double>&, const TissueBox<double>&,
                                                      const Gain<double>&, const double&, int);

template std::complex<double> rightmost_delay_root(const DelaySystem<double>&, const Tissue<double>&,
                                                   const Gain<double>&);
template std::vector<std::complex<double>> collocated_delay_roots(const DelaySystem<double>&, const Tissue<double>&,
                                                                  const Gain<double>&, int);

}  // namespace limpid
