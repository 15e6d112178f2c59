// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/bracketed_root.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid {

/// Spring and damper between a device and a virtual tool, Z_c(z) = B_c + K_c T z/(z - 1).
template <Real Scalar = double>
struct CouplingGains {
  Scalar stiffness{0};  ///< K_c, N/m, >= 0
  Scalar damping{0};    ///< B_c, N s/m, >= 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(stiffness) && stiffness >= Scalar{0}, "CouplingGains: stiffness", "finite and >= 0", stiffness);
    expect(is_finite(damping) && damping >= Scalar{0}, "CouplingGains: damping", "finite and >= 0", damping);
  }
};

/// What an impedance device is to a virtual coupling.
template <Real Scalar = double>
struct CoupledDevice {
  Scalar damping{0};  ///< b, N s/m, > 0
  Scalar period{0};   ///< T, s, > 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(damping) && damping > Scalar{0}, "CoupledDevice: damping", "finite and > 0", damping);
    expect(is_finite(period) && period > Scalar{0}, "CoupledDevice: period", "finite and > 0", period);
  }
};

// Adams and Hannaford (IEEE Trans. Robotics and Automation 15, 1999): a coupling makes device and virtual world stable
// for every passive hand and every passive virtual world where at all frequencies
//
//     Re(1/Z_c) >= |ZOH| (1 - cos(angle ZOH)) / (2 b),     ZOH = (z + 1)/(2 z)
//
// With x = cos(omega T/2), u = K_c T/2 and r = B_c + u this is
//
//     2 b r (1 + x) >= x (r^2 (1 - x^2) + u^2 x^2)     for 0 <= x <= 1
//
// and in units of b, its lowest point being at x = 1 or where its slope is zero inside,
//
//     u^2 <= U(r),     U = 4 r up to r = 5, then r^2 - r (r - 2)^3/27, which is zero at r = 8

/// Whether a coupling is unconditionally stable, and by how much.
template <Real Scalar = double>
struct CouplingStability {
  bool stable = false;       ///< as computed: at the limit itself a rounding decides
  Scalar needed_damping{0};  ///< least b that this coupling asks for, N s/m; b over it is the margin
  Scalar omega{0};           ///< the frequency that asks for it, rad/s; 0 for the limit toward it
};

namespace detail {

/// What the frequency with x = cos(omega T/2) and y = sin(omega T/2) asks of the device's damping.
template <Real Scalar>
[[nodiscard]] Scalar coupling_damping(const CouplingGains<Scalar>& gains, const Scalar& period, const Scalar& x,
                                      const Scalar& y) {
  const Scalar u = gains.stiffness * period / Scalar{2}, r = gains.damping + u;
  if (!(r > Scalar{0}) || !is_finite(r)) return r;
  const Scalar part = u / r;
  return x * (y * y + part * part * x * x) / (Scalar{2} * (Scalar{1} + x)) * r;
}

}  // namespace detail

/// Damping that the frequency omega asks of the device, N s/m: the coupling is unconditionally stable where b is at
/// least that at all frequencies from 0 to pi/T. Off line.
/// @param period  T, s
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar coupling_damping_at(const CouplingGains<Scalar>& gains, const Scalar& period,
                                         const Scalar& omega) {
  using std::acos, std::cos, std::sin;
  gains.check();
  CoupledDevice<Scalar>{Scalar{1}, period}.check();
  const Scalar Nyquist = acos(Scalar{-1}) / period * (Scalar{1} + Scalar{8} * std::numeric_limits<Scalar>::epsilon());
  expect(omega >= Scalar{0} && omega <= Nyquist, "coupling_damping_at: omega", "0 to pi/T", omega);
  const Scalar half = omega * period / Scalar{2};
  return detail::coupling_damping<Scalar>(gains, period, cos(half), sin(half));
}

/// Off line.
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] CouplingStability<Scalar> coupling_stability(const CouplingGains<Scalar>& gains,
                                                           const CoupledDevice<Scalar>& device) {
  using std::acos, std::sqrt;
  gains.check();
  device.check();
  const Scalar u = gains.stiffness * device.period / Scalar{2}, r = gains.damping + u;
  // the needed damping is highest where 2 x^3 + 3 x^2 = r^2/(r^2 - u^2), a left side that rises from 0 to 5
  const Scalar rest = gains.damping / r * (Scalar{1} + u / r), one{1};  // NaN without gains
  Scalar x = one;
  if (Scalar{5} * rest > one) {
    const auto slope = [&](const Scalar& at) -> Scalar { return (Scalar{2} * at + Scalar{3}) * at * at * rest - one; };
    x = std::min<Scalar>(detail::bracketed_root<Scalar>(slope, Scalar{0}, -one, one, Scalar{5} * rest - one), one);
  }
  const Scalar needed = detail::coupling_damping<Scalar>(gains, device.period, x, sqrt((one - x) * (one + x)));
  return {device.damping >= needed, needed, Scalar{2} * acos(x) / device.period};
}

/// The largest stiffness K_c that keeps a coupling of damping B_c unconditionally stable, N/m: 8 b/T for B_c = 0; NaN
/// where B_c is more than 8 b, which no stiffness suits. Off line.
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar largest_coupling_stiffness(const Scalar& damping, const CoupledDevice<Scalar>& device) {
  using std::sqrt;
  device.check();
  CouplingGains<Scalar>{Scalar{0}, damping}.check();
  const Scalar beta = damping / device.damping, per_u = Scalar{2} * device.damping / device.period;
  if (beta > Scalar{8}) return std::numeric_limits<Scalar>::quiet_NaN();
  const Scalar u = Scalar{2} + Scalar{2} * sqrt(Scalar{1} + beta);  // u^2 = 4 (beta + u)
  if (beta + u <= Scalar{5}) return u * per_u;
  // u = r - beta: 27 beta (2 r - beta) = r (r - 2)^3, the left side above the right one, then below
  const auto room = [&](const Scalar& r) -> Scalar {
    const Scalar t = r - Scalar{2};
    return Scalar{27} * beta * (Scalar{2} * r - beta) - r * t * t * t;
  };
  const Scalar low = std::max<Scalar>(Scalar{5}, beta), high{8}, at_low = room(low), at_high = room(high);
  if (!(at_low > Scalar{0})) return (low - beta) * per_u;
  if (!(at_high < Scalar{0})) return (high - beta) * per_u;
  return (detail::bracketed_root<Scalar>(room, low, at_low, high, at_high) - beta) * per_u;
}

/// The stiffest coupling that is unconditionally stable: at the highest point of U,
///
///     2 r^3 - 9 r^2 - 15 r - 4 = 0:     B_c = 1.167049 b,     K_c = 9.350561 b/T
///
/// It stands on the limit: take a little less stiffness for a margin. Off line.
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] CouplingGains<Scalar> stiffest_coupling(const CoupledDevice<Scalar>& device) {
  using std::sqrt;
  device.check();
  const auto slope = [](const Scalar& r) -> Scalar {
    return ((Scalar{2} * r - Scalar{9}) * r - Scalar{15}) * r - Scalar{4};
  };
  const Scalar r = detail::bracketed_root<Scalar>(slope, Scalar{5}, slope(Scalar{5}), Scalar{8}, slope(Scalar{8}));
  const Scalar t = r - Scalar{2}, u = sqrt(r * r - r * t * t * t / Scalar{27});
  return {Scalar{2} * u * device.damping / device.period, (r - u) * device.damping};
}

}  // namespace limpid
