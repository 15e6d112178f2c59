// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <string>

namespace limpid {

/// What lies between the equations of an arm and the arm that is built:
///
///  - motors that give no more than so much torque, of which a D/A converter may make steps: with n bits one of 2^n
///    levels from -torque to torque less a step, the nearest;
///  - static friction at each joint after Dahl: z' = q' - |q'| z/z_s, torque f_s z/z_s. A joint bends by about z_s
///    before it slips, and is then braked by f_s against its motion: Coulomb's friction, without its jump at rest;
///  - angles that are read in steps, and rates from them through a filtered derivative (5.3).
template <int Joints, Real Scalar = double>
struct ArmHardware {
  using Vector = Eigen::Matrix<Scalar, Joints, 1>;

  Vector torque = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());        ///< largest magnitude, N m, > 0
  int converter_bits = 0;                                                            ///< at most 24; 0: no steps
  Vector static_friction = Vector::Zero();                                           ///< f_s, N m, >= 0
  Scalar presliding = Scalar(5) / Scalar(10'000);                                    ///< z_s, rad, > 0
  Vector encoder_step = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< rad, > 0
  Scalar rate_filter = Scalar(398) / Scalar(10'000);                                 ///< tau of (5.3), s, > 0

  /// Between two levels of the converter, N m; 0 without one.
  [[nodiscard]] Vector converter_step() const noexcept {
    using std::ldexp;
    if (converter_bits <= 0) return Vector::Zero();
    return torque / Scalar(ldexp(Scalar(1), converter_bits - 1));
  }

  /// The most that the motors give in the positive sense, N m.
  [[nodiscard]] Vector highest_torque() const noexcept { return torque - converter_step(); }

  /// @throws std::invalid_argument  "NAME: ..." where a field cannot be
  void check(const std::string& name) const {
    const auto all_positive = [](const Vector& v) { return is_finite(v) && (v.array() > Scalar(0)).all(); };
    expect(all_positive(torque), name + ": torque", "finite and > 0", torque);
    expect(0 <= converter_bits && converter_bits <= 24, name + ": converter_bits", "of [0, 24]", converter_bits);
    expect(is_finite(static_friction) && (static_friction.array() >= Scalar(0)).all(), name + ": static_friction",
           "finite and >= 0", static_friction);
    expect(is_finite(presliding) && presliding > Scalar(0), name + ": presliding", "finite and > 0", presliding);
    expect(all_positive(encoder_step), name + ": encoder_step", "finite and > 0", encoder_step);
    expect(is_finite(rate_filter) && rate_filter > Scalar(0), name + ": rate_filter", "finite and > 0", rate_filter);
  }
};

}  // namespace limpid
