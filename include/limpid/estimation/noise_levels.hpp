// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace limpid {

/// How noisy a measurement is, learnt from its innovations: the posterior over a few levels of standard deviation, each
/// less probable than the one below it at first. An innovation e of a measurement whose prediction has variance s has
/// the density of N(0, s + level^2) at each level; older ones are forgotten. The variance to use is the posterior's
/// mean.
/// @tparam Levels  how many
/// @realtime       no allocation, no throw for built-in scalars; two logarithms or exponentials a level
template <std::size_t Levels, Real Scalar = double>
class NoiseLevels {
 public:
  /// @param deviations  standard deviations, > 0, in the measurement's unit
  /// @param keep        of the log posterior from sample to sample, 0 to 1
  /// @param doubt       log of how much less probable each level is than the one before it, before anything is seen
  NoiseLevels(const std::array<Scalar, Levels>& deviations, const Scalar& keep,
              const Scalar& doubt = Scalar{0}) noexcept
      : keep_{keep} {
    for (std::size_t i = 0; i < Levels; ++i) {
      squares_[i] = deviations[i] * deviations[i];
      log_[i] = -doubt * static_cast<Scalar>(i);
    }
    average();
  }

  /// Posterior mean of the variance.
  [[nodiscard]] const Scalar& variance() const noexcept { return variance_; }

  /// @param innovation  measured less predicted
  /// @param predicted   variance of the prediction itself, without the measurement's noise
  void observe(const Scalar& innovation, const Scalar& predicted) noexcept {
    using std::log;
    const Scalar most(30), least(-14);  // one outlier does not outweigh a memory; what is improbable may come back
    Scalar best = std::numeric_limits<Scalar>::lowest();
    for (std::size_t i = 0; i < Levels; ++i) {
      const Scalar whole = predicted + squares_[i];
      const Scalar surprise = std::min(innovation * innovation / whole, most);
      log_[i] = keep_ * log_[i] - (log(whole) + surprise) / Scalar{2};
      best = std::max(best, log_[i]);
    }
    for (Scalar& each : log_) each = std::max(each - best, least);
    average();
  }

 private:
  void average() noexcept {
    using std::exp;
    Scalar whole{0}, sum{0};
    for (std::size_t i = 0; i < Levels; ++i) {
      const Scalar weight = exp(log_[i]);
      whole += weight;
      sum += weight * squares_[i];
    }
    variance_ = sum / whole;
  }

  Scalar keep_, variance_{};
  std::array<Scalar, Levels> squares_{}, log_{};  // log of the posterior, the most probable at 0
};

}  // namespace limpid
