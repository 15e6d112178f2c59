// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safe_torque.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/robot/joint_state.hpp>

#include <Eigen/Core>

#include <concepts>
#include <cstdint>

namespace limpid {

/// What a haptic device knows of itself.
template <int Joints = 3, Real Scalar = double>
struct DeviceState {
  Eigen::Matrix<Scalar, Joints, 1> q = Eigen::Matrix<Scalar, Joints, 1>::Zero();     ///< driven joints, rad
  Eigen::Matrix<Scalar, Joints, 1> qdot = Eigen::Matrix<Scalar, Joints, 1>::Zero();  ///< rad/s
  Eigen::Matrix<Scalar, 3, 1> gimbal =
      Eigen::Matrix<Scalar, 3, 1>::Zero();  ///< yaw, pitch, roll, rad; zero without one
  std::uint32_t buttons = 0;                ///< a bit each, 1 = pressed
  Time stamp{};                             ///< when it was so
  Status status = Status::ok;               ///< no_sample, stale, disconnected: the last state known

  [[nodiscard]] JointState<Joints, Scalar> joint_state() const noexcept { return {q, qdot}; }
};

/// @realtime  no allocation for built-in scalars
template <int Joints, Real Scalar>
[[nodiscard]] bool is_finite(const DeviceState<Joints, Scalar>& state) noexcept {
  return is_finite(state.q) && is_finite(state.qdot) && is_finite(state.gimbal);
}

/// How limpid sees a device of type D; specialise it to adapt a foreign type. Minimal:
///
///     using Scalar;                                                            // a Real
///     static constexpr int joints;                                             // driven ones
///     static DeviceState<joints, Scalar> read(D&, Time now) noexcept;
///     static Status write(D&, const SafeTorque<joints, Scalar>&) noexcept;
///
/// A type with members of these names needs no specialisation.
template <typename D>
struct HapticDeviceTraits {};

template <typename D>
requires requires(D& device, Time now, const SafeTorque<D::joints, typename D::Scalar>& torque) {
  device.read(now);
  device.write(torque);
}
struct HapticDeviceTraits<D> {
  using Scalar = typename D::Scalar;
  static constexpr int joints = D::joints;

  static auto read(D& device, Time now) noexcept(noexcept(device.read(now))) { return device.read(now); }
  static auto write(D& device, const SafeTorque<joints, Scalar>& torque) noexcept(noexcept(device.write(torque))) {
    return device.write(torque);
  }
};

/// An impedance-type haptic device: tells where its joints are and takes torques for them.
///
/// Laws: `read` always gives finite values, the last ones known where there are no newer ones, and its status says so;
/// reading does not move the device; `stamp` never goes back; `write` takes nothing but a SafeTorque, which holds until
/// the next one; a device that does not answer gives `disconnected` from both calls, once it knows.
/// test/conformance/haptic_device_suite.hpp checks them for any type. Model: SimulatedOmni.
template <typename D>
concept HapticDevice =
    Real<typename HapticDeviceTraits<D>::Scalar> &&(HapticDeviceTraits<D>::joints > 0) &&
    requires(D& device, Time now,
             const SafeTorque<HapticDeviceTraits<D>::joints, typename HapticDeviceTraits<D>::Scalar>& torque) {
  { HapticDeviceTraits<D>::read(device, now) }
  noexcept->std::same_as<DeviceState<HapticDeviceTraits<D>::joints, typename HapticDeviceTraits<D>::Scalar>>;
  { HapticDeviceTraits<D>::write(device, torque) }
  noexcept->std::same_as<Status>;
}
&&!requires(D & device,
            const Eigen::Matrix<typename HapticDeviceTraits<D>::Scalar, HapticDeviceTraits<D>::joints, 1>& bare) {
  HapticDeviceTraits<D>::write(device, bare);  // a torque that no limiter has seen
};

}  // namespace limpid
