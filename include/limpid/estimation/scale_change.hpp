// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace limpid {

/// Logarithm of the density of N(0, S) at y, but for a constant; beyond a distance of 60 hardly any less, so that one
/// outlier is not taken for proof. S is 3 x 3, symmetric, positive definite; y has three entries.
/// @realtime  no allocation
template <Real Scalar>
[[nodiscard]] Scalar log_likelihood(const Eigen::Matrix<Scalar, 3, 3>& S, const Eigen::Matrix<Scalar, 3, 1>& y) noexcept {
  using std::log;
  const Scalar d0 = S(0, 0), l10 = S(1, 0) / d0, l20 = S(2, 0) / d0;
  const Scalar d1 = S(1, 1) - l10 * S(1, 0), l21 = (S(2, 1) - l20 * S(1, 0)) / d1;
  const Scalar d2 = S(2, 2) - l20 * S(2, 0) - l21 * (S(2, 1) - l20 * S(1, 0));
  const Scalar y1 = y[1] - l10 * y[0], y2 = y[2] - l20 * y[0] - l21 * y1;
  const Scalar distance = y[0] * y[0] / d0 + y1 * y1 / d1 + y2 * y2 / d2, far(60);
  const Scalar counted = distance < far ? distance : far + distance / Scalar(50);
  return -(counted + log(d0) + log(d1) + log(d2)) / Scalar{2};
}

/// Whether a tissue as a whole has become stiffer or softer, by a common factor: as a drift, learnt over `memory`, or at
/// once. Of the hypotheses the most probable one is taken, so that where nothing speaks for a change there is none.
/// @realtime  no allocation, no throw for built-in scalars; six determinants of 3 x 3
template <Real Scalar = double>
class ScaleChange {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  struct Settings {
    Scalar memory{1};                               ///< of the evidence for a drift, s
    Scalar jump_probability = Scalar(1) / 1000;     ///< of a jump at a sample, before it is seen
  };

  explicit ScaleChange(const Settings& settings) noexcept : settings_{settings} {}

  /// Variance of the factor that is added at this sample.
  /// @param S       covariance of the innovation y without a change
  /// @param effect  of a factor of 1 on the three measurements
  /// @param T       since the sample before, s
  [[nodiscard]] Scalar variance(const Matrix& S, const Vector& y, const Vector& effect, const Scalar& T) noexcept {
    using std::exp;
    using std::log;
    const Matrix square = effect * effect.transpose();
    const auto judge = [&](const Scalar& variance) { return log_likelihood<Scalar>(S + variance * square, y); };
    const Scalar none = judge(Scalar{0}), keep = exp(-T / settings_.memory);
    Scalar best = log(probability_[0]), variance{0}, likelihood = none;
    for (std::size_t i = 1; i < drifts_.size(); ++i) {
      const Scalar added = drifts_[i] * drifts_[i] * T, here = judge(added);
      evidence_[i] = keep * evidence_[i] + here - none;
      if (evidence_[i] + log(probability_[i]) <= best) continue;
      best = evidence_[i] + log(probability_[i]);
      variance = added;
      likelihood = here;
    }
    for (const Scalar& jump : jumps_) {
      const Scalar here = judge(jump * jump) + log(settings_.jump_probability);
      if (here <= likelihood) continue;
      likelihood = here;
      variance = jump * jump;
    }
    return variance;
  }

 private:
  Settings settings_;
  // 1/sqrt(s), and how probable each is before anything is seen
  std::array<Scalar, 4> drifts_{Scalar{0}, Scalar(3) / 1000, Scalar(15) / 1000, Scalar(6) / 100};
  std::array<Scalar, 4> probability_{Scalar(9) / 10, Scalar(5) / 100, Scalar(3) / 100, Scalar(2) / 100};
  std::array<Scalar, 2> jumps_{Scalar(5) / 100, Scalar(3) / 10};
  std::array<Scalar, 4> evidence_{};
};

}  // namespace limpid
