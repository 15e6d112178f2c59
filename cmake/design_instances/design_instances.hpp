// SPDX-License-Identifier: MIT
// The solvers of design/ take a compiler long: tests and examples that include this leave the ones for double to
// design_instances/*.cpp, where they are compiled once. A program of one's own needs none of it.
#pragma once

#include <limpid/design/lmi.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/design/theorem3_design.hpp>
#include <limpid/design/theorem5.hpp>

namespace limpid {

using DoubleDesign = PredictorDesign<double>;
using DoubleTissues = std::span<const Tissue<double>>;
constexpr int any_number = Eigen::Dynamic;

extern template LmiResult<double> detail::solve_lmi(const LmiProblem<double>&, LmiGoal, const LmiSettings<double>&);

extern template Theorem3Verdict<double, 1> verify_theorem3(const DoubleDesign&, const Tissue<double>&,
                                                           const Gain<double>&, const Theorem3Certificate<double, 1>*);
extern template Theorem3Verdict<double, 4> verify_theorem3(const DoubleDesign&, const TissueBox<double>&,
                                                           const Gain<double>&, const Theorem3Certificate<double, 4>*);
extern template Theorem3Verdict<double, any_number> verify_theorem3(DoubleDesign const&, DoubleTissues,
                                                                    const Gain<double>&,
                                                                    const Theorem3Certificate<double, any_number>*);

extern template GainDesign<double, 1> design_theorem3(const DoubleDesign&, const Tissue<double>&,
                                                      const GainCertificate<double, 1>*);
extern template GainDesign<double, 4> design_theorem3(const DoubleDesign&, const TissueBox<double>&,
                                                      const GainCertificate<double, 4>*);
extern template GainDesign<double, any_number> design_theorem3(const DoubleDesign&, DoubleTissues,
                                                               const GainCertificate<double, any_number>*);

extern template ScheduledGainDesign<double> design_theorem5(const DoubleDesign&, const TissueBox<double>&,
                                                            const TissueRates<double>&);
extern template ScheduledGainDesign<double> verify_theorem5(const DoubleDesign&, const TissueBox<double>&,
                                                            const TissueRates<double>&, const AffineGain<double>&);

}  // namespace limpid
