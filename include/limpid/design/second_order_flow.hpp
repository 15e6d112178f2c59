// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <cmath>
#include <limits>

namespace limpid::detail {

/// Exact step of x'' + beta x' + kappa x = f over h seconds with constant f:
/// Phi = [phi11 g; -kappa g phi22], Gamma = (s, g).
/// @tparam Number  a scalar, or what encloses a function over a cell
template <typename Number>
struct SecondOrderFlow {
  Number trace, determinant;  // of Phi
  Number phi11, phi22, s, g;
};

/// With alpha = beta h/2 and z = alpha^2 - kappa h^2, for kappa not small and beta >= 0:
///
///     C = exp(-alpha) cosh sqrt(z), S = exp(-alpha) sinh(sqrt z)/sqrt z, phi11 = C + alpha S, g = h S,
///     s = (1 - phi11)/kappa
template <Real Scalar>
[[nodiscard]] SecondOrderFlow<Scalar> second_order_flow_by_functions(const Scalar& kappa, const Scalar& alpha,
                                                                     const Scalar& K, const Scalar& h) noexcept {
  using std::cos, std::exp, std::expm1, std::sin, std::sqrt;
  const Scalar z = alpha * alpha - K;
  Scalar C, S, determinant;
  if (z > Scalar{0}) {
    const Scalar root = sqrt(z), slow = exp(-K / (alpha + root)), gap = -expm1(Scalar{-2} * root);
    C = slow - slow * gap / Scalar{2};
    S = slow * gap / (Scalar{2} * root);
    determinant = exp(Scalar{-2} * alpha);
  } else {
    const Scalar omega = sqrt(-z), decay = exp(-alpha);
    C = decay * cos(omega);
    S = omega > Scalar{0} ? decay * sin(omega) / omega : decay;
    determinant = decay * decay;
  }
  const Scalar phi11 = C + alpha * S;
  return {Scalar{2} * C, determinant, phi11, C - alpha * S, (Scalar{1} - phi11) / kappa, h * S};
}

/// By the power series of s and g = s' over a piece of h short enough, doubled until it spans h, as SecondOrderStep
/// does, which unrolls them. NaN where there is no such piece.
template <Real Scalar>
[[nodiscard]] SecondOrderFlow<Scalar> second_order_flow_by_series(const Scalar& kappa, const Scalar& beta,
                                                                  Scalar h) noexcept {
  using std::abs, std::exp;
  constexpr int most_doublings = 2'000;
  const Scalar determinant = exp(-beta * h), longest = Scalar{1} / Scalar{2};
  int doublings = 0;
  for (; !(abs(beta * h) <= longest && abs(kappa * h * h) <= longest * longest) && doublings < most_doublings;
       ++doublings) {
    h /= Scalar{2};
  }
  if (!is_finite(beta) || !is_finite(kappa) || doublings == most_doublings)
    h = std::numeric_limits<Scalar>::quiet_NaN();
  // s/h^2 = sum s_n, (n + 1) n s_(n+1) = -n B s_n - K s_(n-1), |s_n| < 1/n!; g/h = sum n s_n
  const Scalar B = beta * h, K = kappa * h * h;
  Scalar older{0}, newer = Scalar{1} / Scalar{2}, s = newer, g{1}, bound{1};
  for (int n = 2; bound > std::numeric_limits<Scalar>::epsilon() / Scalar{8}; ++n) {
    const Scalar next = -(B * newer + K * older / Scalar(n)) / Scalar(n + 1);
    s += next;
    g += Scalar(n + 1) * next;
    older = newer;
    newer = next;
    bound /= Scalar(n + 1);
  }
  s *= h * h;
  g *= h;
  for (; doublings > 0; --doublings) {
    const Scalar phi11 = Scalar{1} - kappa * s, phi22 = phi11 - beta * g;
    s += phi11 * s + g * g;
    g *= phi11 + phi22;
  }
  const Scalar phi11 = Scalar{1} - kappa * s, phi22 = phi11 - beta * g;
  return {phi11 + phi22, determinant, phi11, phi22, s, g};
}

/// No cancellation where the poles come together, nor where kappa or beta is small or negative. Not finite where the
/// numbers are too large.
/// @realtime  no allocation, no throw
template <Real Scalar>
[[nodiscard]] SecondOrderFlow<Scalar> second_order_flow(const Scalar& kappa, const Scalar& beta,
                                                        const Scalar& h) noexcept {
  const Scalar alpha = beta * h / Scalar{2}, K = kappa * h * h;
  const bool usual =
      K > Scalar{1} / Scalar{16} && alpha >= Scalar{0} && alpha * alpha < std::numeric_limits<Scalar>::max();
  return usual ? second_order_flow_by_functions(kappa, alpha, K, h) : second_order_flow_by_series(kappa, beta, h);
}

}  // namespace limpid::detail
