// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/haptic_wall.hpp>
#include <limpid/design/root_radius.hpp>
#include <limpid/design/sampled_delay.hpp>
#include <limpid/design/second_order_flow.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <string>

namespace limpid {

/// Where a wall's controller has its velocity from.
enum class VelocitySource {
  sampled,              ///< measured itself
  backward_difference,  ///< (x[k] - x[k-1]) / T of the measured position
};

/// The loop of a device and a virtual wall as it is: the plant (7) under a force that is held for a period T, and
/// (12) computed from what was measured at the period's start.
///
///     m x'' + b x' = F_h - F_d,     F_d = K_c x[k] + B_c v[k] from `delay` after the sample on
///
/// Tustin, ZOH models and small-gain tests of this loop are approximations; this is not.
template <Real Scalar = double>
struct SampledWall {
  static constexpr int most_periods = 32;

  Scalar period{0};                                         ///< T, s, > 0
  Scalar delay{0};                                          ///< from measuring to acting, s, >= 0: any part of periods
  VelocitySource velocity = VelocitySource::sampled;        ///< v[k]
  Scalar cutoff = std::numeric_limits<Scalar>::infinity();  ///< of the first-order low-pass that v passes, Hz, > 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(period) && period > Scalar{0}, "SampledWall: period", "finite and > 0", period);
    expect(is_finite(delay) && delay >= Scalar{0} && delay < period * Scalar(most_periods), "SampledWall: delay",
           ">= 0 and below " + std::to_string(most_periods) + " periods", delay);
    expect(cutoff > Scalar{0}, "SampledWall: cutoff", "> 0", cutoff);
  }

  /// delay = periods() * period + fraction(), but for rounding.
  [[nodiscard]] Scalar fraction() const { return detail::delay_fraction(delay, period); }
  [[nodiscard]] int periods() const { return detail::delay_periods(delay, period); }
  [[nodiscard]] bool filtered() const { return is_finite(cutoff); }
  /// Of the characteristic polynomial: position and velocity, forces on their way, and the velocity's estimate.
  [[nodiscard]] int degree() const {
    const bool remembers = filtered() || velocity == VelocitySource::backward_difference;
    return 2 + periods() + (fraction() > Scalar{0} ? 1 : 0) + (remembers ? 1 : 0);
  }
};

namespace detail {

inline constexpr int most_wall_degree = SampledWall<>::most_periods + 3;

template <typename Number>
using WallCoefficients = Eigen::Matrix<Number, Eigen::Dynamic, 1, 0, most_wall_degree + 1, 1>;

/// v = (gain z + rest) / (z - pole) of what is measured: the velocity, or the position over T.
template <typename Number>
struct VelocityFilter {
  Number pole, gain, rest;
};

/// Both filters take their input as linear between samples, as LowPass and FilteredDerivative do.
/// @param decay  exp(-omega T); zero where there is no filter
/// @param angle  omega T
template <typename Number>
[[nodiscard]] VelocityFilter<Number> velocity_filter(VelocitySource source, const Number& decay, const Number& angle,
                                                     const Number& one) {
  const Number part = one - decay;
  if (source == VelocitySource::backward_difference) return {decay, part, -part};
  const Number gain = one - part / angle;
  return {decay, gain, part - gain};
}

/// Numerators over D(z) = z^2 - tr z + det of the position and the velocity that a force over mass, delayed by a
/// fraction of a period, gives: w_0 + w_1 z + w_2 z^2, where w_2 is zero without a fraction.
///
///     [s; g] z^1 + adj terms: x: s z + g^2 - e s,   v: g (z - 1)
template <typename Number>
struct WallNumerators {
  Number x0, x1, x2, v0, v1, v2;
};

/// @param rest  of period - fraction; null where the fraction is zero
template <typename Number>
[[nodiscard]] WallNumerators<Number> wall_numerators(const SecondOrderFlow<Number>& flow,
                                                     const SecondOrderFlow<Number>* rest, const Number& zero) {
  const Number& e = flow.phi22;
  if (!rest) return {flow.g * flow.g - e * flow.s, flow.s, zero, -flow.g, flow.g, zero};
  // (z I - Phi)^-1 (Gamma_0 z + Gamma_1), Gamma_0 = (s', g') of the rest, Gamma_1 = (s - s', g - g')
  const Number s1 = flow.s - rest->s, g1 = flow.g - rest->g;
  return {flow.g * g1 - e * s1,
          flow.g * rest->g - e * rest->s + s1,
          rest->s,  //
          -g1,
          g1 - rest->g,
          rest->g};
}

/// Characteristic polynomial p = p_0 ... p_N, p_N = 1, of the loop: D(z), the force's way, and K_c, B_c through both.
///
///     p(z) = (z - pole) [z^n D(z) + K_c/m X(z)] + B_c/m (gain z + rest) V(z)
///
/// with V the numerator of the velocity, or that of the position over T.
/// @param flow  of the plant over a period: kappa = 0
template <typename Number>
[[nodiscard]] WallCoefficients<Number> wall_polynomial(const SecondOrderFlow<Number>& flow,
                                                       const SecondOrderFlow<Number>* rest, int periods,
                                                       const VelocityFilter<Number>* filter, bool difference,
                                                       const Number& per_period, const Number& K_over_m,
                                                       const Number& B_over_m, const Number& zero, const Number& one) {
  const WallNumerators<Number> w = wall_numerators(flow, rest, zero);
  const Eigen::Index n = periods + (rest ? 1 : 0), N = n + 2 + (filter ? 1 : 0);
  using Coefficients = WallCoefficients<Number>;
  Coefficients inner = Coefficients::Constant(n + 3, zero);  // z^n D + K/m X
  inner[n + 2] = one;
  inner[n + 1] = -flow.trace;
  inner[n] = flow.determinant;
  inner[0] += K_over_m * w.x0;
  inner[1] += K_over_m * w.x1;
  if (rest) inner[2] += K_over_m * w.x2;
  const Number B = difference ? Number(B_over_m * per_period) : B_over_m;
  const Number b0 = B * (difference ? w.x0 : w.v0), b1 = B * (difference ? w.x1 : w.v1),
               b2 = B * (difference ? w.x2 : w.v2);
  if (!filter) {
    inner[0] += b0;
    inner[1] += b1;
    if (rest) inner[2] += b2;
    return inner;
  }
  Coefficients p = Coefficients::Constant(N + 1, zero);
  p[N] = one;
  for (Eigen::Index i = N - 1; i >= 0; --i) p[i] = (i > 0 ? inner[i - 1] : zero) - filter->pole * inner[i];
  p[0] += filter->rest * b0;
  p[1] += filter->gain * b0 + filter->rest * b1;
  p[2] += filter->gain * b1;
  if (rest) {
    p[2] += filter->rest * b2;
    p[3] += filter->gain * b2;
  }
  return p;
}

/// The same of a loop, a plant and gains that were checked.
template <Real Scalar>
[[nodiscard]] WallCoefficients<Scalar> wall_polynomial_of(const SampledWall<Scalar>& loop,
                                                          const HapticPlant<Scalar>& plant,
                                                          const WallFeedback<Scalar>& feedback) {
  using std::atan, std::exp;
  const Scalar zero{0}, one{1}, beta = plant.damping / plant.mass;
  const auto flow = second_order_flow(zero, beta, loop.period);
  const Scalar fraction = loop.fraction();
  const auto rest = second_order_flow<Scalar>(zero, beta, loop.period - fraction);
  const bool difference = loop.velocity == VelocitySource::backward_difference;
  const Scalar angle = Scalar{8} * atan(one) * loop.cutoff * loop.period;
  const auto filter = velocity_filter<Scalar>(loop.velocity, exp(-angle), angle, one);
  return wall_polynomial<Scalar>(flow, fraction > zero ? &rest : nullptr, loop.periods(),
                                 loop.filtered() || difference ? &filter : nullptr, difference, one / loop.period,
                                 feedback.K_c / plant.mass, feedback.B_c / plant.mass, zero, one);
}

}  // namespace detail

/// Coefficients p_0 ... p_N = 1 of the characteristic polynomial of the sampled loop; not finite where the numbers are
/// too large.
/// @throws std::invalid_argument  where a field cannot be used
template <Real Scalar>
[[nodiscard]] detail::WallCoefficients<Scalar> sampled_wall_polynomial(const SampledWall<Scalar>& loop,
                                                                       const HapticPlant<Scalar>& plant,
                                                                       const WallFeedback<Scalar>& feedback) {
  loop.check();
  plant.check();
  feedback.check();
  return detail::wall_polynomial_of(loop, plant, feedback);
}

/// Spectral radius of the sampled loop: the factor by which a motion grows from tick to tick in the long run; below 1
/// the loop is stable. Infinite where the numbers are too large to tell. Rounded; `prove_sampled_wall` proves.
///
/// Off line: some microseconds.
/// @throws std::invalid_argument  where a field cannot be used
template <Real Scalar>
[[nodiscard]] Scalar sampled_wall_radius(const SampledWall<Scalar>& loop, const HapticPlant<Scalar>& plant,
                                         const WallFeedback<Scalar>& feedback) {
  const auto p = sampled_wall_polynomial(loop, plant, feedback);
  return is_finite(p) ? detail::root_radius(p) : std::numeric_limits<Scalar>::infinity();
}

}  // namespace limpid
