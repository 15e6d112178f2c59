// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

namespace limpid {

/// One axis of a haptic device, P(s) = 1/(m s + b), eq. (7) of Eom, Suh and Yi.
template <Real Scalar = double>
struct HapticPlant {
  Scalar mass{0};     ///< m, kg, > 0
  Scalar damping{0};  ///< b, N s/m, >= 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(mass) && mass > Scalar{0}, "HapticPlant: mass", "finite and > 0", mass);
    expect(is_finite(damping) && damping >= Scalar{0}, "HapticPlant: damping", "finite and >= 0", damping);
  }
};

/// The wall to be felt, V(s) = K/s + B, eq. (8); its admittance is s/(K + B s).
template <Real Scalar = double>
struct VirtualWall {
  Scalar stiffness{0};  ///< K, N/m, > 0
  Scalar damping{0};    ///< B, N s/m, >= 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(stiffness) && stiffness > Scalar{0}, "VirtualWall: stiffness", "finite and > 0", stiffness);
    expect(is_finite(damping) && damping >= Scalar{0}, "VirtualWall: damping", "finite and >= 0", damping);
  }
};

/// Gains of the feedback controller C(s) = B_c + K_c/s, eq. (12).
template <Real Scalar = double>
struct WallFeedback {
  Scalar K_c{0};  ///< N/m
  Scalar B_c{0};  ///< N s/m

  /// @throws std::invalid_argument  where a gain is not finite
  void check() const {
    expect(is_finite(K_c), "WallFeedback: K_c", "finite", K_c);
    expect(is_finite(B_c), "WallFeedback: B_c", "finite", B_c);
  }
};

/// How far mass and damping may be from their nominal values, eq. (13): m (1 +- alpha), b (1 +- beta).
template <Real Scalar = double>
struct PlantUncertainty {
  Scalar alpha{0};  ///< of the mass, 0 <= alpha < 1
  Scalar beta{0};   ///< of the damping, 0 <= beta <= 1

  /// @throws std::invalid_argument  where a part is out of its range
  void check() const {
    expect(alpha >= Scalar{0} && alpha < Scalar{1}, "PlantUncertainty: alpha", "0 <= alpha < 1", alpha);
    expect(beta >= Scalar{0} && beta <= Scalar{1}, "PlantUncertainty: beta", "0 <= beta <= 1", beta);
  }
};

/// The plants with `lower` <= (mass, damping) <= `upper`, each for itself.
template <Real Scalar = double>
struct PlantBox {
  HapticPlant<Scalar> lower{}, upper{};

  /// Eq. (13), mass and damping each for itself.
  /// @throws std::invalid_argument  where a part is out of its range
  [[nodiscard]] static PlantBox around(const HapticPlant<Scalar>& nominal, const PlantUncertainty<Scalar>& part) {
    part.check();
    const Scalar one{1};
    return {{nominal.mass * (one - part.alpha), nominal.damping * (one - part.beta)},
            {nominal.mass * (one + part.alpha), nominal.damping * (one + part.beta)}};
  }

  /// @throws std::invalid_argument  where a plant cannot be used or a bound is above its upper one
  void check() const {
    lower.check();
    upper.check();
    expect(lower.mass <= upper.mass, "PlantBox: mass", "lower <= upper", lower.mass);
    expect(lower.damping <= upper.damping, "PlantBox: damping", "lower <= upper", lower.damping);
  }
};

/// Gains B_c between two ends, N s/m; none where `empty`.
template <Real Scalar = double>
struct GainInterval {
  Scalar lower{0};
  Scalar upper{0};  ///< infinite where there is no end

  [[nodiscard]] bool empty() const { return !(lower < upper); }
  [[nodiscard]] bool contains(const Scalar& gain) const { return lower <= gain && gain <= upper; }
};

}  // namespace limpid
