// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/design/design_point.hpp>

#include <algorithm>
#include <cmath>

namespace limpid {

/// What bounds the speed of the estimate in (4.44) to (4.46).
template <Real Scalar = double>
struct AdaptationLimits {
  Scalar rho_M{0};    ///< of lambda_max(Gamma), > 0
  Scalar nu{0};       ///< of (4.46), > 0
  Scalar phi_max{0};  ///< of ||phi||, m and m/s, > 0; may be infinite

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(rho_M) && rho_M > Scalar{0}, "AdaptationLimits: rho_M", "finite and > 0", rho_M);
    expect(is_finite(nu) && nu > Scalar{0}, "AdaptationLimits: nu", "finite and > 0", nu);
    expect(phi_max > Scalar{0}, "AdaptationLimits: phi_max", "> 0", phi_max);
  }
};

/// |rho'|_max of (6.2) as printed: (theta_max - theta_min)/(1/(rho_M ||phi||^2) + nu).
///
/// It takes phi phi' for ||phi||^2 I, entry by entry, and Gamma for rho_M I: an estimate, which the damping may exceed
/// while the stiffness is wrong. `sure_adaptation_rates` may not be exceeded.
/// @throws std::invalid_argument  where the limits or the box cannot be used
template <Real Scalar>
[[nodiscard]] TissueRates<Scalar> adaptation_rates(const AdaptationLimits<Scalar>& limits,
                                                   const TissueBox<Scalar>& box) {
  limits.check();
  box.check();
  const Scalar rate = Scalar{1} / (Scalar{1} / (limits.rho_M * limits.phi_max * limits.phi_max) + limits.nu);
  return {rate * (box.upper.stiffness - box.lower.stiffness), rate * (box.upper.damping - box.lower.damping)};
}

/// A bound of |rho'| for every Gamma <= rho_M I and every phi: with z = Gamma^(1/2) phi,
///
///     |theta^'| = |Gamma^(1/2) z| |phi' theta~| / (1 + nu z'z) <= sqrt(rho_M) ||phi|| ||theta~|| max z/(1 + nu z^2)
///
/// for 0 <= z <= sqrt(rho_M) ||phi||. Infinite where phi_max is; zero where the box is a point.
/// @throws std::invalid_argument  where the limits or the box cannot be used
template <Real Scalar>
[[nodiscard]] TissueRates<Scalar> sure_adaptation_rates(const AdaptationLimits<Scalar>& limits,
                                                        const TissueBox<Scalar>& box) {
  using std::sqrt;
  limits.check();
  box.check();
  const Scalar k = box.upper.stiffness - box.lower.stiffness, b = box.upper.damping - box.lower.damping;
  if (k == Scalar{0} && b == Scalar{0}) return {};  // theta~ = 0, whatever phi is
  const Scalar longest = sqrt(limits.rho_M) * limits.phi_max;
  const Scalar z = std::min<Scalar>(longest, Scalar{1} / sqrt(limits.nu));
  const Scalar rate = longest * sqrt(k * k + b * b) * z / (Scalar{1} + limits.nu * z * z);
  return {rate, rate};
}

}  // namespace limpid
