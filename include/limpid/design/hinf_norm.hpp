// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/gain_peak.hpp>
#include <limpid/design/hamiltonian.hpp>
#include <limpid/design/norm_verdict.hpp>
#include <limpid/design/state_space.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace limpid {

/// ||G||_inf, the largest singular value over all frequencies.
template <Real Scalar = double>
struct HinfNorm {
  Scalar norm{0};       ///< the value at the peak, to rounding; infinite unless the verdict is `finite`; never NaN
  Scalar frequency{0};  ///< of the peak, rad/s; infinite where the norm is the limit at high frequency
  Scalar lower{0};      ///< attained
  Scalar upper{0};      ///< not exceeded anywhere, as far as the method below tells
  NormVerdict verdict = NormVerdict::undecided;
};

namespace detail {

template <Real Scalar>
[[nodiscard]] HinfNorm<Scalar> no_hinf_norm(NormVerdict verdict) {
  const Scalar infinity = infinity_of<Scalar>();
  return {infinity, infinity, infinity, infinity, verdict};
}

/// The search on a continuous stable system.
template <Real Scalar>
class HinfSearch {
 public:
  explicit HinfSearch(const StateSpace<Scalar>& G) : G_{balanced_states(G)}, gain_{G_} {}

  [[nodiscard]] HinfNorm<Scalar> run() {
    peak_ = gain_.sweep();
    if (!is_finite(peak_.value)) return no_hinf_norm<Scalar>(NormVerdict::undecided);
    if (peak_.value == Scalar{0}) return {peak_.value, peak_.frequency, peak_.value, peak_.value, NormVerdict::finite};
    // Close to the peak the crossings of a level are as the root of the distance to it: 2^-33 leaves them 2^-16 apart.
    for (Scalar gap = first_gap(); gap < Scalar(1000); gap *= Scalar{8}) {
      for (int round = 0; round < most_rounds; ++round) {
        const Scalar level = peak_.value * (Scalar{1} + gap);
        const auto crossings = crossings_of(level);
        if (crossings.known && crossings.frequencies.empty()) {
          return {peak_.value, peak_.frequency, peak_.value, level, NormVerdict::finite};
        }
        if (!rises_above(level, crossings.frequencies)) break;
      }
    }
    const Scalar infinity = infinity_of<Scalar>();
    return {infinity, peak_.frequency, peak_.value, infinity, NormVerdict::undecided};
  }

 private:
  static constexpr int most_rounds = 60;

  static Scalar first_gap() {
    using std::ldexp;
    return ldexp(Scalar{1}, -std::min(33, std::numeric_limits<Scalar>::digits * 5 / 8));
  }

  // Where the norm is the limit at infinity, the Hamiltonian of G(1/p) has the better numbers.
  [[nodiscard]] Crossings<Scalar> crossings_of(const Scalar& level) const {
    if (is_finite(peak_.frequency)) return level_crossings(G_, level);
    auto crossings = level_crossings(inverted_frequency(G_), level);
    for (Scalar& omega : crossings.frequencies) omega = omega > Scalar{0} ? Scalar{1} / omega : infinity_of<Scalar>();
    std::sort(crossings.frequencies.begin(), crossings.frequencies.end());
    return crossings;
  }

  // Above a level the gain has its peaks between crossings.
  [[nodiscard]] bool rises_above(const Scalar& level, const std::vector<Scalar>& crossings) {
    Scalar before{0};
    for (const Scalar& omega : crossings) {
      if (!is_finite(omega)) break;
      const GainPeak<Scalar> found = gain_.between(before, omega);
      if (found.value > peak_.value) peak_ = found;
      before = omega;
    }
    return peak_.value > level;
  }

  StateSpace<Scalar> G_;
  GainCurve<Scalar> gain_;
  GainPeak<Scalar> peak_;
};

}  // namespace detail

/// The norm by level sets (Boyd, Balakrishnan and Kabamba; Bruinsma and Steinbuch): a frequency sweep about the poles
/// gives a first peak; a level just above it is refuted or confirmed by the Hamiltonian matrix, whose imaginary
/// eigenvalues are all frequencies at which the gain crosses it; where there are any, the peaks between them raise the
/// level. So the result cannot be a local peak or the value at one end. The peak itself is polished on the slope of the
/// gain: value and frequency are good to rounding. The upper bound is 1e-10 above where the numbers allow; it is not
/// proved against rounding. A discrete system is taken to the continuous one by the bilinear map, which keeps gains.
///
/// Off line: some milliseconds for ten states.
/// @throws std::invalid_argument  where the system is refused
template <Real Scalar>
[[nodiscard]] HinfNorm<Scalar> hinf_norm(const StateSpace<Scalar>& G) {
  if (!is_stable(G)) {
    const bool known = is_finite(stability_excess(G));
    return detail::no_hinf_norm<Scalar>(known ? NormVerdict::unstable : NormVerdict::undecided);
  }
  if (!G.is_discrete()) return detail::HinfSearch<Scalar>(G).run();
  HinfNorm<Scalar> result = detail::HinfSearch<Scalar>(detail::bilinear(G)).run();
  result.frequency = detail::discrete_frequency(result.frequency, G.period);
  return result;
}

}  // namespace limpid
