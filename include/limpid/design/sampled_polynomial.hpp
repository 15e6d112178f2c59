// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/sampled_delay.hpp>
#include <limpid/design/second_order_flow.hpp>

#include <Eigen/Core>

#include <cmath>
#include <string>

namespace limpid {

/// The prediction error between samples, thesis section 4.3.2 with hold: the tool in its tissue, drawn by L e, where e
/// is sampled every `period`, each sample seen `delay` later and held until the next one is.
///
///     m e'' + (b_t + b_e) e' + (k_t + k_e) e = L e_zd
template <Real Scalar = double>
struct SampledSystem {
  static constexpr int most_periods = 32;

  Tool<1, Scalar> tool{};
  Scalar period{0};  ///< between samples, s, > 0
  Scalar delay{0};   ///< from taking a sample to seeing it, s, >= 0: a part of a period, some periods, or between

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    tool.check();
    expect(is_finite(period) && period > Scalar{0}, "SampledSystem: period", "finite and > 0", period);
    expect(is_finite(delay) && delay >= Scalar{0} && delay < period * Scalar(most_periods), "SampledSystem: delay",
           ">= 0 and below " + std::to_string(most_periods) + " periods", delay);
  }

  /// delay = periods() * period + fraction(), but for rounding.
  [[nodiscard]] Scalar fraction() const { return detail::delay_fraction(delay, period); }
  [[nodiscard]] int periods() const { return detail::delay_periods(delay, period); }
  /// Degree of the characteristic polynomial: position, velocity and the forces L e on their way.
  [[nodiscard]] int degree() const { return periods() + (fraction() > Scalar{0} ? 3 : 2); }
};

namespace detail {

inline constexpr int most_sampled_degree = SampledSystem<>::most_periods + 3;

/// Coefficients p_0 ... p_N of p(z) = sum p_i z^i, p_N = 1, on the stack.
template <typename Number>
using SampledCoefficients = Eigen::Matrix<Number, Eigen::Dynamic, 1, 0, most_sampled_degree + 1, 1>;

/// det(z I - Phi - G(z) L), G(z) = Gamma0 z^-n + Gamma1 z^-(n+1): a sample is seen `fraction` into the period, so that
/// Gamma0 is Gamma over the rest of it and Gamma0 + Gamma1 that over all of it. With L over m,
///
///     p(z) = z^(n+1) (z^2 - tr Phi z + det Phi) - L (z I - adj Phi) (Gamma0 z + Gamma1),
///
/// and L adj(Phi) (s', g') = L1 (phi22 s' - g g') + L2 (kappa g s' + phi11 g').
/// which is kappa g s + phi11 g = g for (s, g) itself.
/// @param flow  of a period
/// @param rest  of period - fraction; null where the fraction is zero
template <Real Scalar, typename Number, typename Row>
[[nodiscard]] SampledCoefficients<Number> sampled_coefficients(const SecondOrderFlow<Number>& flow,
                                                               const SecondOrderFlow<Number>* rest, int periods,
                                                               const Number& kappa, const Row& L) {
  const auto along = [&](const Number& s, const Number& g) { return L[0] * s + L[1] * g; };
  const auto across = [&](const Number& s, const Number& g) {
    return L[0] * (flow.phi22 * s - flow.g * g) + L[1] * (kappa * (flow.g * s) + flow.phi11 * g);
  };
  const Number whole = L[0] * (flow.phi22 * flow.s - flow.g * flow.g) + L[1] * flow.g;
  const int degree = periods + (rest ? 3 : 2);
  SampledCoefficients<Number> p = SampledCoefficients<Number>::Constant(degree + 1, Number(Scalar{0}));
  p[degree] = Number(Scalar{1});
  p[degree - 1] = -flow.trace;
  p[degree - 2] = flow.determinant;
  if (!rest) {
    p[1] -= along(flow.s, flow.g);
    p[0] += whole;
    return p;
  }
  const Number before = across(rest->s, rest->g);
  p[2] -= along(rest->s, rest->g);
  p[1] += before - along(flow.s - rest->s, flow.g - rest->g);
  p[0] += whole - before;
  return p;
}

/// Takes (e, then the forces u = L e of the newest sample but one back to the oldest that still acts) from one sample
/// to the next:
///
///     e[k+1] = Phi e[k] + Gamma0 u[k-n] + Gamma1 u[k-n-1]
///
/// @param rest  of period - fraction: `flow` where the fraction is zero
template <Real Scalar, typename Number>
[[nodiscard]] Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> sampled_monodromy(
    const SecondOrderFlow<Number>& flow, const SecondOrderFlow<Number>& rest, const SampledSystem<Scalar>& system,
    const Number& kappa, const Number& per_mass, const Gain<Scalar>& L) {
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Index N = system.degree(), n = system.periods();
  Matrix M = Matrix::Constant(N, N, Number(Scalar{0}));
  M(0, 0) = flow.phi11;
  M(0, 1) = flow.g;
  M(1, 0) = -(kappa * flow.g);
  M(1, 1) = flow.phi22;
  // u[k - i] is state 1 + i, but u[k] = L e[k].
  const auto act = [&](Eigen::Index age, const Number& s, const Number& g) {
    for (Eigen::Index j = 0; j < (age == 0 ? 2 : 1); ++j) {
      const Number weight = age == 0 ? Number(L[j]) * per_mass : per_mass;
      M(0, age == 0 ? j : 1 + age) += s * weight;
      M(1, age == 0 ? j : 1 + age) += g * weight;
    }
  };
  act(n, rest.s, rest.g);
  if (N == n + 3) act(n + 1, flow.s - rest.s, flow.g - rest.g);
  for (Eigen::Index j = 0; N > 2 && j < 2; ++j) M(2, j) = Number(L[j]);
  for (Eigen::Index i = 3; i < N; ++i) M(i, i - 1) = Number(Scalar{1});
  return M;
}

}  // namespace detail
}  // namespace limpid
