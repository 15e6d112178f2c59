// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/lane_math.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/robot/omni_pose.hpp>
#include <limpid/robot/robot.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace limpid {

/// The Phantom Omni, section 3.3: three joints, base frame at the shoulder, x to the front, z up.
///
/// @realtime  at: no allocation, no throw; three sines and cosines
template <Real Scalar_ = double>
class Omni {
 public:
  using Scalar = Scalar_;
  static constexpr int joints = 3;
  static constexpr int parameters = 9;
  using Vector = Eigen::Matrix<Scalar, joints, 1>;
  using Parameters = Eigen::Matrix<Scalar, parameters, 1>;

  struct Settings {
    Scalar link2 = Scalar(135) / Scalar(1000);   ///< l2, m; Table 5.2
    Scalar link3 = Scalar(130) / Scalar(1000);   ///< l3, m; Table 5.2
    Scalar gravity = Scalar(981) / Scalar(100);  ///< g, m/s^2
  };

  /// @throws std::invalid_argument  where a link is not positive, gravity is negative, or one is not finite; where a
  ///                                square of a length leaves the scalar's range
  explicit Omni(const Settings& settings = Settings{})
      : links_{.l2 = settings.link2, .l3 = settings.link3, .g = settings.gravity} {
    expect(is_finite(links_.l2) && links_.l2 > Scalar(0), "Omni: link2", "finite and > 0", links_.l2);
    expect(is_finite(links_.l3) && links_.l3 > Scalar(0), "Omni: link3", "finite and > 0", links_.l3);
    check_square("Omni: link2", links_.l2);
    check_square("Omni: link3", links_.l3);
    expect(is_finite(links_.g) && links_.g >= Scalar(0), "Omni: gravity", "finite and >= 0", links_.g);
  }

  /// The arm with its joints at q, rad.
  [[nodiscard]] OmniPose<Scalar> at(const Vector& q) const noexcept {
    const auto [s, c] = sine_cosine(to_lanes<joints>(Vector(q[0], q[1], q[1] + q[2]).array()));
    return {links_, {c[0], s[0], c[1], s[1], c[2], s[2]}};
  }

  [[nodiscard]] const Scalar& link2() const noexcept { return links_.l2; }   ///< l2, m
  [[nodiscard]] const Scalar& link3() const noexcept { return links_.l3; }   ///< l3, m
  [[nodiscard]] const Scalar& gravity() const noexcept { return links_.g; }  ///< g, m/s^2

  /// Table 5.1; joint 1's static friction, which it does not print, is taken as joint 2's.
  [[nodiscard]] JointLimits<joints, Scalar> limits() const noexcept {
    using std::acos;
    const Scalar third = acos(Scalar(-1)) / Scalar(3);
    return {.lower = Vector(-third, Scalar(0), milli(-2450)),
            .upper = Vector(third, milli(1790), milli(-250)),
            .torque = Vector(milli(300), milli(290), milli(200)),
            .static_friction = Vector(milli(65), milli(65), milli(28))};
  }

  /// Largest q2 + q3 that the cables of joint 3 allow, rad. Eq. (5.4).
  [[nodiscard]] static Scalar elbow_sum_limit() noexcept { return milli(214); }
  /// Smallest distance of the tip from the vertical axis, clear of the base, m. Section 5.2.3.
  [[nodiscard]] static Scalar radius_min() noexcept { return milli(120); }
  /// Largest distance of the tip from the shoulder, m. Section 5.2.3.
  [[nodiscard]] static Scalar reach_max() noexcept { return milli(260); }

  /// theta of the measured device, ordered as (3.25), kg m^2, kg m, N m s/rad. Table 5.2.
  [[nodiscard]] static Parameters table_5_2() noexcept {
    Parameters theta;
    theta << 37, 70, 80, 4, 91, 52, 960, 1450, 550;
    return theta / Scalar(10'000);
  }

 private:
  static void check_square(const char* name, const Scalar& length) {
    expect(is_finite(Scalar(Scalar(4) * length * length)) && length * length >= std::numeric_limits<Scalar>::min(),
           name, "a length whose square is in range", length);
  }

  [[nodiscard]] static Scalar milli(int thousandths) noexcept { return Scalar(thousandths) / Scalar(1000); }

  typename OmniPose<Scalar>::Links links_;
};

}  // namespace limpid
