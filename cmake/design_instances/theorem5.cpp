// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

namespace limpid {

template ScheduledGainDesign<double> design_theorem5(const DoubleDesign&, const TissueBox<double>&,
                                                     const TissueRates<double>&);
template ScheduledGainDesign<double> verify_theorem5(const DoubleDesign&, const TissueBox<double>&,
                                                     const TissueRates<double>&, const AffineGain<double>&);

}  // namespace limpid
