// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

namespace limpid {

template GainDesign<double, 1> design_theorem3(const DoubleDesign&, const Tissue<double>&,
                                               const GainCertificate<double, 1>*);
template GainDesign<double, 4> design_theorem3(const DoubleDesign&, const TissueBox<double>&,
                                               const GainCertificate<double, 4>*);
template GainDesign<double, any_number> design_theorem3(const DoubleDesign&, DoubleTissues,
                                                        const GainCertificate<double, any_number>*);

}  // namespace limpid
