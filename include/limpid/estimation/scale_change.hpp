// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/cholesky_3.hpp>
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
[[nodiscard]] Scalar log_likelihood(const Eigen::Matrix<Scalar, 3, 3>& S,
                                    const Eigen::Matrix<Scalar, 3, 1>& y) noexcept {
  const Cholesky3<Scalar> factor(S);
  const Scalar distance = factor.whitened(y).squaredNorm(), far(60);
  const Scalar counted = distance < far ? distance : far + distance / Scalar(50);
  return -(counted + factor.log_determinant()) / Scalar{2};
}

/// Whether a tissue as a whole has become stiffer or softer, by a common factor: as a drift, learnt over `memory`, or
/// at once. Of the hypotheses the most probable one is taken, so that where nothing speaks for a change there is none.
/// @realtime  no allocation, no throw for built-in scalars; six determinants of 3 x 3
template <Real Scalar = double>
class ScaleChange {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  struct Settings {
    Scalar memory{4};                            ///< of the evidence for a drift, s
    Scalar jump_probability = Scalar(1) / 1000;  ///< of a jump at a sample, before it is seen
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
    const Scalar least = drifts_[0] * drifts_[0] * T, none = judge(least), keep = exp(-T / settings_.memory);
    Scalar best = log(probability_[0]), variance = least, likelihood = none;
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
  std::array<Scalar, 4> drifts_{Scalar(4) / 1000, Scalar(1) / 100, Scalar(3) / 100, Scalar(1) / 10};
  std::array<Scalar, 4> probability_{Scalar(9) / 10, Scalar(5) / 100, Scalar(3) / 100, Scalar(2) / 100};
  std::array<Scalar, 2> jumps_{Scalar(5) / 100, Scalar(3) / 10};
  std::array<Scalar, 4> evidence_{};
};

}  // namespace limpid
