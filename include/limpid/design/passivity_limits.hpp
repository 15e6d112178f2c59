// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/haptic_wall.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace limpid {

namespace detail {

template <Real Scalar>
void check_passivity_period(const Scalar& period) {
  expect(is_finite(period) && period > Scalar{0}, "passivity limit: period", "finite and > 0", period);
}

template <Real Scalar>
void check_passivity_wall(const VirtualWall<Scalar>& wall) {
  expect(is_finite(wall.stiffness) && wall.stiffness >= Scalar{0}, "passivity limit: wall.stiffness", "finite and >= 0",
         wall.stiffness);
  expect(is_finite(wall.damping), "passivity limit: wall.damping", "finite", wall.damping);
}

}  // namespace detail

// The sampled wall of Colgate and Schenkel (J. Robotic Systems 14, 1997): position sampled each period T, velocity by
// backward difference, force held, H(z) = K + B (z - 1)/(T z). It is passive to a hand, whatever its stiffness or its
// damping (of either sign), where the device's own damping is
//
//     b > K T/2 - B cos(omega T)     for 0 < omega <= pi/T,     in the worst case     b > K T/2 + |B|

/// What the frequency omega asks of the device's damping, N s/m. Off line.
/// @param period  T, s
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar colgate_schenkel_damping_at(const VirtualWall<Scalar>& wall, const Scalar& period,
                                                 const Scalar& omega) {
  using std::cos;
  detail::check_passivity_wall(wall);
  detail::check_passivity_period(period);
  expect(is_finite(omega), "passivity limit: omega", "finite", omega);
  return wall.stiffness * period / Scalar{2} - wall.damping * cos(omega * period);
}

/// Damping that the device must exceed for the wall to be passive, N s/m. Off line.
/// @param period  T, s
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar colgate_schenkel_damping(const VirtualWall<Scalar>& wall, const Scalar& period) {
  using std::abs;
  detail::check_passivity_wall(wall);
  detail::check_passivity_period(period);
  return wall.stiffness * period / Scalar{2} + abs(wall.damping);
}

/// Stiffness below which a wall of this damping is passive, N/m; 0 where no stiffness is. Off line.
/// @param damping       b of the device, N s/m, >= 0
/// @param wall_damping  B, N s/m
/// @param period        T, s
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar colgate_schenkel_stiffness(const Scalar& damping, const Scalar& wall_damping,
                                                const Scalar& period) {
  using std::abs;
  expect(is_finite(damping) && damping >= Scalar{0}, "passivity limit: damping", "finite and >= 0", damping);
  expect(is_finite(wall_damping), "passivity limit: wall_damping", "finite", wall_damping);
  detail::check_passivity_period(period);
  return std::max<Scalar>(Scalar{0}, Scalar{2} * (damping - abs(wall_damping)) / period);
}

/// Sampling period below which the wall is passive, s; 0 where no period is, infinite where every one is. Off line.
/// @param damping  b of the device, N s/m, >= 0
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar colgate_schenkel_period(const Scalar& damping, const VirtualWall<Scalar>& wall) {
  using std::abs;
  expect(is_finite(damping) && damping >= Scalar{0}, "passivity limit: damping", "finite and >= 0", damping);
  detail::check_passivity_wall(wall);
  const Scalar left = damping - abs(wall.damping);
  if (!(left > Scalar{0})) return Scalar{0};
  return wall.stiffness > Scalar{0} ? Scalar(Scalar{2} * left / wall.stiffness)
                                    : std::numeric_limits<Scalar>::infinity();
}

/// What any sampled wall asks of the device's damping.
template <Real Scalar = double>
struct SampledWallDamping {
  Scalar damping{0};  ///< that the device must exceed, N s/m; infinite where H has a pole on the circle
  Scalar omega{0};    ///< the frequency that asks for it, rad/s
};

namespace detail {

// (T/2)/(1 - cos theta) Re{(1 - exp(-i theta)) H} = (T/2) (Re H - cot(theta/2) Im H), where nothing cancels.
template <Real Scalar, typename Transfer>
[[nodiscard]] Scalar sampled_wall_damping_at(const Transfer& H, const Scalar& period, const Scalar& theta) {
  using std::cos, std::sin;
  const Scalar half = theta / Scalar{2};
  const std::complex<Scalar> value = H(std::complex<Scalar>(cos(theta), sin(theta)));
  const Scalar b = period / Scalar{2} * (value.real() - cos(half) / sin(half) * value.imag());
  return is_finite(b) ? b : std::numeric_limits<Scalar>::infinity();
}

// The highest value between `low` and `high`, by golden sections of a curve with one hill there.
template <Real Scalar, typename Curve>
[[nodiscard]] SampledWallDamping<Scalar> hilltop(const Curve& curve, Scalar low, Scalar high) {
  using std::sqrt;
  const Scalar part = (sqrt(Scalar{5}) - Scalar{1}) / Scalar{2};
  const int steps = 3 * std::numeric_limits<Scalar>::digits / 4;  // part^2 is above 2^-1.4: to sqrt(epsilon)
  Scalar left = high - part * (high - low), right = low + part * (high - low);
  Scalar at_left = curve(left), at_right = curve(right);
  for (int i = 0; i < steps; ++i) {
    if (at_left > at_right) {
      high = right, right = left, at_right = at_left;
      left = high - part * (high - low), at_left = curve(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + part * (high - low), at_right = curve(right);
    }
  }
  return at_left > at_right ? SampledWallDamping<Scalar>{at_left, left} : SampledWallDamping<Scalar>{at_right, right};
}

}  // namespace detail

/// Damping that the device must exceed for a sampled wall of any transfer function H(z), force over position, real for
/// real z and stable, to be passive: Colgate and Schenkel's supremum over 0 < omega <= pi/T of
///
///     (T/2)/(1 - cos(omega T)) Re{(1 - exp(-i omega T)) H(exp(i omega T))}
///
/// Computed, not proved: a sweep whose hills are refined; one narrower than its steps is missed. Off line.
/// @param H       gives a std::complex<Scalar>, N/m, for a std::complex<Scalar> z on the unit circle
/// @param period  T, s
/// @param steps   of the sweep, evenly up to pi/T, 2 to 1e8; 100 more go down evenly in the logarithm
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar, typename Transfer>
[[nodiscard]] SampledWallDamping<Scalar> sampled_wall_damping(const Transfer& H, const Scalar& period,
                                                              int steps = 4'000) {
  using std::atan, std::pow;
  detail::check_passivity_period(period);
  expect(steps >= 2 && steps <= 100'000'000, "sampled_wall_damping: steps", "2 to 1e8", steps);
  constexpr int lower = 100;
  const Scalar pi = Scalar{4} * atan(Scalar{1}), step = pi / Scalar(steps);
  const auto curve = [&](const Scalar& theta) { return detail::sampled_wall_damping_at(H, period, theta); };
  const auto theta_of = [&](int i) {
    return i >= lower ? Scalar(std::min(i - lower + 1, steps)) * step
                      : Scalar(step * pow(Scalar(1) / Scalar(1'000), Scalar(lower - i) / Scalar(lower)));
  };
  const int last = lower + steps - 1;
  SampledWallDamping<Scalar> best{curve(theta_of(0)), theta_of(0)};
  // toward omega = 0 the values settle, as a function of omega^2, unless H has a pole at z = 1
  const Scalar nearer = curve(theta_of(0) / Scalar{4});
  if (nearer > Scalar{2} * best.damping && nearer > curve(theta_of(1))) {
    return {std::numeric_limits<Scalar>::infinity(), Scalar{0}};
  }
  Scalar before = best.damping, at = curve(theta_of(1));
  for (int i = 1; i <= last; ++i) {
    const Scalar after = i < last ? curve(theta_of(i + 1)) : at;
    if (at > best.damping) best = {at, theta_of(i)};
    if (i < last && at >= before && at >= after) {
      const auto top = detail::hilltop<Scalar>(curve, theta_of(i - 1), theta_of(i + 1));
      if (top.damping > best.damping) best = top;
    }
    before = at;
    at = after;
  }
  return {best.damping, best.omega / period};
}

/// A device with Coulomb friction whose position is read in steps.
template <Real Scalar = double>
struct FrictionalDevice {
  Scalar damping{0};     ///< b, viscous, N s/m, >= 0
  Scalar friction{0};    ///< c, Coulomb, N, >= 0
  Scalar resolution{0};  ///< Delta, of the position, m, >= 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(damping) && damping >= Scalar{0}, "FrictionalDevice: damping", "finite and >= 0", damping);
    expect(is_finite(friction) && friction >= Scalar{0}, "FrictionalDevice: friction", "finite and >= 0", friction);
    expect(is_finite(resolution) && resolution >= Scalar{0}, "FrictionalDevice: resolution", "finite and >= 0",
           resolution);
  }
};

/// Stiffness up to which a sampled and quantised spring wall is passive, N/m, after Diolaiti, Niemeyer, Barbagli and
/// Salisbury (IEEE Trans. Robotics 22, 2006):
///
///     K <= min(2 b/T, 2 c/Delta)
///
/// The damping must dissipate what holding the force generates, the friction what quantisation does. Off line.
/// @param period  T, s
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar diolaiti_stiffness(const FrictionalDevice<Scalar>& device, const Scalar& period) {
  device.check();
  detail::check_passivity_period(period);
  const Scalar held = Scalar{2} * device.damping / period;
  if (!(device.resolution > Scalar{0})) return held;
  return std::min<Scalar>(held, Scalar{2} * device.friction / device.resolution);
}

/// The least damping and friction with which a device of this resolution can show the stiffness K. Off line.
/// @param stiffness   K, N/m, >= 0
/// @param resolution  Delta, m, >= 0
/// @param period      T, s
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] FrictionalDevice<Scalar> diolaiti_device(const Scalar& stiffness, const Scalar& resolution,
                                                       const Scalar& period) {
  expect(is_finite(stiffness) && stiffness >= Scalar{0}, "diolaiti_device: stiffness", "finite and >= 0", stiffness);
  detail::check_passivity_period(period);
  const FrictionalDevice<Scalar> device{stiffness * period / Scalar{2}, stiffness * resolution / Scalar{2}, resolution};
  device.check();
  return device;
}

/// Sampling period up to which the device can show the stiffness K, s; 0 where no period is short enough, for want of
/// friction. Off line.
/// @param stiffness  K, N/m, > 0
/// @throws std::invalid_argument  where an argument cannot be used
template <Real Scalar>
[[nodiscard]] Scalar diolaiti_period(const FrictionalDevice<Scalar>& device, const Scalar& stiffness) {
  device.check();
  expect(is_finite(stiffness) && stiffness > Scalar{0}, "diolaiti_period: stiffness", "finite and > 0", stiffness);
  const bool rubs = Scalar{2} * device.friction >= stiffness * device.resolution;
  return rubs ? Scalar(Scalar{2} * device.damping / stiffness) : Scalar{0};
}

}  // namespace limpid
