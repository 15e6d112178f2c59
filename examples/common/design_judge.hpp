// SPDX-License-Identifier: MIT
#pragma once

#include "design_options.hpp"

#include <limpid/design/design_point.hpp>
#include <limpid/design/largest_box.hpp>

#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A gain at one knot of a B-spline.
struct GainAtKnot {
  limpid::Tissue<> knot;
  Gain<> gain;
};

/// What an inequality says of a gain, given or sought.
struct InequalityAnswer {
  Verdict verdict = Verdict::undecided;
  bool certified = false;  ///< whether an independent check accepted the certificate of the verdict
  std::string reason{};
  double margin = unknown;
  double by_sampling = unknown;        ///< bound of |e| over |Delta_T|, (4.32) with gamma B; NaN where not asked for
  double by_force = unknown;           ///< the same over |Delta_theta|, per N
  std::optional<AffineGain<>> gain{};  ///< where one was sought and found
  std::vector<GainAtKnot> at_knots{};  ///< where a B-spline was sought and found
};

/// What is known of the sampled predictor.
struct SampledAnswer {
  double radius = unknown;               ///< spectral radius; over a box its proved upper bound
  Verdict stable = Verdict::undecided;   ///< feasible: proved
  Verdict varying = Verdict::undecided;  ///< feasible: also for parameters that vary between samples; of a box
  bool on_grid = false;                  ///< whether the radius is the worst of a grid, and nothing proved
};

/// What is known of the continuous delay system.
struct DelayAnswer {
  std::complex<double> root{unknown, unknown};  ///< rightmost, 1/s; over a box, of its worst grid point
  bool stable = false;
};

/// The gain of smallest worst radius over a box, or one that was given.
struct RobustAnswer {
  AffineGain<> gain{};
  double worst_radius = unknown;  ///< where proved no tissue of the box has a larger one
  limpid::Tissue<> worst{};
  bool proved = false;
  Verdict varying = Verdict::undecided;
  std::string reason{};
};

/// What `verify` asks for.
[[nodiscard]] InequalityAnswer ask_inequality(const DesignTask& task);
[[nodiscard]] inline bool is_inequality(DesignTheorem theorem) {
  return theorem == DesignTheorem::two || theorem == DesignTheorem::three || theorem == DesignTheorem::five;
}

/// Whether a gain depends on the tissue.
[[nodiscard]] inline bool is_scheduled(const AffineGain<>& gain) { return !gain.L1.isZero(0) || !gain.L2.isZero(0); }

/// Newton's method leaves a real root an imaginary part of some rounding.
[[nodiscard]] inline std::complex<double> without_rounding(const std::complex<double>& root) {
  return std::abs(root.imag()) <= 1e-12 * std::abs(root) ? root.real() : root;
}

/// 19 by 21 points over a box, as the thesis takes them; one along a side without length.
[[nodiscard]] Grid<> grid_over(const TissueBox<>& box);

/// Least factor that (4.32) proves of |e| over |Delta_T|, as printed or, tighter, with gamma B; NaN where none.
[[nodiscard]] double error_bound(const PredictorDesign<>& design, const limpid::Tissue<>& tissue, const Gain<>& L,
                                 bool printed);

/// The largest box about the centre of `whole` on which (4.51) holds for L or, where none is given, for some affine
/// one.
[[nodiscard]] LargestBox<> largest_scheduled_box(const PredictorDesign<>& design, const TissueBox<>& whole,
                                                 const TissueRates<>& rates, const std::optional<AffineGain<>>& L);

/// What `solve` asks for.
[[nodiscard]] InequalityAnswer ask_for_gain(const DesignTask& task);
[[nodiscard]] InequalityAnswer ask_for_sampled_gain(const DesignTask& task);
[[nodiscard]] SampledAnswer ask_sampled(const DesignTask& task, const AffineGain<>& gain);
[[nodiscard]] DelayAnswer ask_delay(const DesignTask& task, const AffineGain<>& gain);
[[nodiscard]] RobustAnswer ask_robust(const DesignTask& task);

}  // namespace limpid::examples
