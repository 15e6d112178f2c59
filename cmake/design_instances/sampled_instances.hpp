// SPDX-License-Identifier: MIT
// As design_instances.hpp, for the gains and proofs of the sampled and of the delayed error.
#pragma once

#include <limpid/design/delay_collocation.hpp>
#include <limpid/design/delay_stability.hpp>
#include <limpid/design/sampled_gain.hpp>
#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_varying.hpp>

namespace limpid {

extern template SampledGain<double> smallest_sampled_radius(const SampledSystem<double>&, const Tissue<double>&);
extern template RobustSampledGain<double> robust_sampled_gain(const SampledSystem<double>&, const TissueBox<double>&);
extern template SampledProof<double> prove_sampled_stability(const SampledSystem<double>&, const TissueBox<double>&,
                                                             const Gain<double>&, const double&, int);
extern template VaryingProof<double> prove_varying_stability(const SampledSystem<double>&, const TissueBox<double>&,
                                                             const Gain<double>&, const double&, int);

extern template std::complex<double> rightmost_delay_root(const DelaySystem<double>&, const Tissue<double>&,
                                                          const Gain<double>&);
extern template std::vector<std::complex<double>> collocated_delay_roots(const DelaySystem<double>&,
                                                                         const Tissue<double>&, const Gain<double>&,
                                                                         int);

}  // namespace limpid
