// SPDX-License-Identifier: MIT
#pragma once

#include "design_judge.hpp"

#include <limpid/design/theorem3.hpp>

#include <complex>
#include <functional>
#include <string>

namespace limpid::examples {

/// What a map says of one tissue.
struct CellAnswer {
  Verdict verdict = Verdict::undecided;
  bool certified = false;
  std::string reason{};
  double radius = unknown;                      ///< of the sampled predictor
  std::complex<double> root{unknown, unknown};  ///< rightmost, of the continuous delay system, 1/s
  Theorem3Certificate<> certificate{};          ///< tried first in the next cell
};

/// Judges one tissue of a map as a task asks; may be called from several threads at once.
class CellTest {
 public:
  /// @param with_stability  whether radius and root are asked for too
  explicit CellTest(const DesignTask& task, bool with_stability = true);

  [[nodiscard]] CellAnswer operator()(const limpid::Tissue<>& tissue, const CellAnswer* neighbour) const;

 private:
  std::function<void(const limpid::Tissue<>&, const CellAnswer*, CellAnswer&)> verdict_, stability_;
};

/// Whether one set of variables, found at `nominal`, satisfies (4.31), or (4.51) at any rates, at other tissues too;
/// empty where none was found.
[[nodiscard]] std::function<bool(const limpid::Tissue<>&)> one_certificate(const PredictorDesign<>& design,
                                                                           const AffineGain<>& L,
                                                                           const limpid::Tissue<>& nominal);

}  // namespace limpid::examples
