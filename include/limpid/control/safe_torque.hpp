// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/robot/robot.hpp>

#include <Eigen/Core>

namespace limpid {

template <Robot R>
class SafetyLimiter;

/// Joint torques that have passed a SafetyLimiter, the only thing a device accepts. Anyone can make zero torque;
/// nothing but a SafetyLimiter can make another.
template <int Joints, Real Scalar = double>
class SafeTorque {
 public:
  using Vector = Eigen::Matrix<Scalar, Joints, 1>;

  SafeTorque() = default;

  [[nodiscard]] const Vector& value() const noexcept { return value_; }  ///< N m; always finite

 private:
  template <Robot R>
  friend class SafetyLimiter;

  explicit SafeTorque(const Vector& value) noexcept : value_{value} {}

  Vector value_ = Vector::Zero();
};

}  // namespace limpid
