// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

namespace limpid {

template Theorem3Verdict<double, 1> verify_theorem3(const DoubleDesign&, const Tissue<double>&, const Gain<double>&,
                                                    const Theorem3Certificate<double, 1>*);
template Theorem3Verdict<double, 4> verify_theorem3(const DoubleDesign&, const TissueBox<double>&, const Gain<double>&,
                                                    const Theorem3Certificate<double, 4>*);
template Theorem3Verdict<double, any_number> verify_theorem3(DoubleDesign const&, DoubleTissues, const Gain<double>&,
                                                             const Theorem3Certificate<double, any_number>*);

}  // namespace limpid
