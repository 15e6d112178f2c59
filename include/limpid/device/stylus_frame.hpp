// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/device/force_sensor.hpp>
#include <limpid/device/haptic_device.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace limpid {

/// Turns a force on the Omni's stylus from the sensor's frame into the base frame, by joints and gimbal:
///
///     F_base = R_link(q) R_gimbal(psi, theta, phi) R_mount F_sensor
///
///     R_link   = R_z(q1) R_y(-(q2 + q3)): x along the last link to the tip, y level, z up as far as it can be. It is
///                frame 3 of Table 3.1 with its axes x, -z, y, and the base frame where all angles are zero.
///     R_gimbal = R_z(psi) R_y(theta) R_x(phi): yaw, pitch and roll of (5.2), of the stylus against that link
///     R_mount  how the sensor sits on the stylus
///
/// That the gimbal's angles count from the last link, and in this order, is our reading of "a standard roll-pitch-yaw
/// convention"; it was not seen on hardware.
/// @realtime  no allocation, no throw; five sines and cosines and some 80 flops
template <Real Scalar_ = double>
class StylusFrame {
 public:
  using Scalar = Scalar_;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  struct Settings {
    Matrix mount = Matrix::Identity();  ///< R_mount, a rotation: its columns are the sensor's axes on the stylus
  };

  /// @throws std::invalid_argument  where `mount` is no rotation, by more than 1e-6 or a hundred roundings
  explicit StylusFrame(const Settings& settings = Settings{}) : mount_{settings.mount} {
    const Scalar tolerance = std::numeric_limits<Scalar>::epsilon() * 100 + Scalar(1) / Scalar(1'000'000);
    const Matrix error = mount_.transpose() * mount_ - Matrix::Identity();
    expect(is_finite(mount_) && error.cwiseAbs().maxCoeff() < tolerance && mount_.determinant() > Scalar(0),
           "StylusFrame: mount", "a rotation", mount_);
  }

  /// R of F_base = R F_sensor.
  /// @param q               joints, rad
  /// @param yaw_pitch_roll  psi, theta, phi of (5.2), rad; OmniDevice::yaw_pitch_roll of the device's own angles
  [[nodiscard]] Matrix rotation(const Vector& q, const Vector& yaw_pitch_roll) const noexcept {
    return turned_z_y(q[0], -(q[1] + q[2])) * turned_z_y(yaw_pitch_roll[0], yaw_pitch_roll[1]) *
           turned_x(yaw_pitch_roll[2]) * mount_;
  }

  /// The reading in the base frame, by the joints and gimbal of `state`, whose status it has beside its own. Where
  /// these are not finite the force is zero and `not_finite`.
  [[nodiscard]] ForceReading<Scalar> in_base(const ForceReading<Scalar>& reading,
                                             const DeviceState<3, Scalar>& state) const noexcept {
    ForceReading<Scalar> turned = reading;
    turned.force = rotation(state.q, state.gimbal) * reading.force;
    turned.status |= state.status;
    if (is_finite(turned)) return turned;
    turned.force.setZero();
    turned.status |= Status::not_finite;
    return turned;
  }

 private:
  // R_z(a) R_y(b)
  static Matrix turned_z_y(const Scalar& a, const Scalar& b) noexcept {
    using std::cos, std::sin;
    const Scalar ca = cos(a), sa = sin(a), cb = cos(b), sb = sin(b), o(0);
    Matrix R;
    R << ca * cb, -sa, ca * sb,  //
        sa * cb, ca, sa * sb,    //
        -sb, o, cb;
    return R;
  }

  static Matrix turned_x(const Scalar& a) noexcept {
    using std::cos, std::sin;
    const Scalar c = cos(a), s = sin(a), o(0), one(1);
    Matrix R;
    R << one, o, o,  //
        o, c, -s,    //
        o, s, c;
    return R;
  }

  Matrix mount_;
};

}  // namespace limpid
