// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/device/usb/omni_bridge.hpp>
#include <limpid/robot/omni_device.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

namespace limpid {

/// Between an Omni's counts and converters and the joints and torques of the model.
///
/// What is public of its scales stands here as a default and was not seen on hardware. Of its torque nothing is public:
/// `full_scale` must be measured.
struct OmniCalibration {
  using Vector = Eigen::Vector3d;

  /// Torque command (5.5) at the end of the converters' range, N m, > 0.
  Vector full_scale = Vector::Constant(std::numeric_limits<double>::quiet_NaN());
  Vector home{0, 0.23, -0.37};               ///< the device's joint angles where it docks, before (5.1), rad
  Vector counts_sign{1, -1, 1};              ///< 1 or -1
  double counts_per_turn = 15'000;           ///< > 0
  Vector gimbal_slope{5.48, -5.28, 4.76};    ///< of the gimbal's angles by A/(A + B), rad
  Vector gimbal_offset{-2.74, 2.64, -2.38};  ///< rad

  /// @throws std::invalid_argument  where a field cannot serve
  void check() const {
    expect(is_finite(full_scale) && (full_scale.array() > 0).all(), "OmniCalibration: full_scale",
           "the torques at full scale, measured, finite and > 0 N m", full_scale);
    expect(is_finite(home), "OmniCalibration: home", "finite", home);
    expect((counts_sign.array().abs() == 1).all(), "OmniCalibration: counts_sign", "1 or -1 for each", counts_sign);
    expect(is_finite(counts_per_turn) && counts_per_turn > 0, "OmniCalibration: counts_per_turn", "finite and > 0",
           counts_per_turn);
    expect(is_finite(gimbal_slope), "OmniCalibration: gimbal_slope", "finite", gimbal_slope);
    expect(is_finite(gimbal_offset), "OmniCalibration: gimbal_offset", "finite", gimbal_offset);
  }

  /// q, rad, from the counts and those where it was docked. Eq. (5.1).
  /// @realtime  no allocation, no throw
  [[nodiscard]] Vector joints(const std::array<std::int16_t, 3>& counts,
                              const std::array<std::int16_t, 3>& docked) const noexcept {
    Vector counted;
    for (std::size_t i = 0; i < 3; ++i) counted[static_cast<Eigen::Index>(i)] = turned(docked[i], counts[i]);
    return OmniDevice<>::joints(home + counts_sign.cwiseProduct(counted) * count());
  }

  /// Yaw, pitch and roll of the stylus, rad. Eq. (5.2). A potentiometer that says nothing counts as in its middle.
  /// @realtime  no allocation, no throw
  [[nodiscard]] Vector gimbal(const std::array<std::uint16_t, 3>& a,
                              const std::array<std::uint16_t, 3>& b) const noexcept {
    Vector part;
    for (std::size_t i = 0; i < 3; ++i) {
      const int sum = a[i] + b[i];
      part[static_cast<Eigen::Index>(i)] = sum > 0 ? static_cast<double>(a[i]) / sum : 0.5;
    }
    return OmniDevice<>::yaw_pitch_roll(gimbal_slope.cwiseProduct(part) + gimbal_offset);
  }

  /// What the converters are told for a torque at the joints, N m; where it is more than they have, all of it is
  /// shortened alike, so that it keeps its direction. Eq. (5.5).
  /// @return  the part of the torque that they give, of [0, 1]; 0 where it is beyond all numbers: no torque
  /// @realtime  no allocation, no throw
  double convert(const Vector& torque, std::array<std::uint16_t, 3>& converter) const noexcept {
    const Vector wanted = OmniDevice<>::device_torque(torque).cwiseQuotient(full_scale);
    const double part = 1 / std::max(1.0, wanted.cwiseAbs().maxCoeff());
    converter = OmniBridge::safe().converter;
    if (!(part > 0)) return part;  // beyond all numbers
    for (std::size_t i = 0; i < 3; ++i) {
      const double u = wanted[static_cast<Eigen::Index>(i)] * part;
      // zero is 7ff, which lies half a step below the middle
      const double level = std::floor((u + 1) / 2 * OmniBridge::highest + 0.4999);
      converter[i] = static_cast<std::uint16_t>(std::clamp(level, 0.0, static_cast<double>(OmniBridge::highest)));
    }
    return part;
  }

  /// From one count to another, which wrap: right as long as they are less than 2^15 apart.
  [[nodiscard]] static int turned(std::int16_t from, std::int16_t to) noexcept {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(to) - static_cast<std::uint16_t>(from));
  }

  /// Of a joint, rad.
  [[nodiscard]] double count() const noexcept { return 2 * std::numbers::pi / counts_per_turn; }
};

}  // namespace limpid
