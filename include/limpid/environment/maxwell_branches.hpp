// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace limpid {

/// The stretches of springs in series with dampers, side by side: relaxation as a generalised Maxwell solid has it,
///
///     chi_i' = v - chi_i / tau_i,     F = sum_i K_i chi_i
///
/// chi_i in m, K_i in N/m. A velocity that is constant over a step is taken exactly.
/// @tparam Branches  how many; 0: none
template <int Branches, Real Scalar = double>
class MaxwellBranches {
 public:
  using Stretch = std::array<Scalar, std::size_t(Branches)>;
  using Lags = std::array<Scalar, std::size_t(Branches)>;  // tau_i, s, > 0

  /// What a step of one length does to every branch.
  struct Step {
    Stretch decay{};  ///< exp(-h / tau)
    Stretch gain{};   ///< tau (1 - exp(-h / tau)), s
  };

  /// @realtime  no allocation for built-in scalars; an exponential a branch
  [[nodiscard]] static Step step_of(const Lags& lags, const Scalar& h) noexcept {
    using std::expm1;
    Step step;
    for (std::size_t i = 0; i < lags.size(); ++i) {
      const Scalar lost = -expm1(-h / lags[i]);
      step.decay[i] = Scalar{1} - lost;
      step.gain[i] = lags[i] * lost;
    }
    return step;
  }

  /// @param v  m/s, over the whole step
  static void advance(Stretch& chi, const Step& step, const Scalar& v) noexcept {
    for (std::size_t i = 0; i < chi.size(); ++i) chi[i] = chi[i] * step.decay[i] + v * step.gain[i];
  }
};

}  // namespace limpid
