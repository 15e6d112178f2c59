// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// Where the joints are and how fast they move.
template <int Joints, Real Scalar = double>
struct JointState {
  using Vector = Eigen::Matrix<Scalar, Joints, 1>;
  Vector q = Vector::Zero();     ///< rad
  Vector qdot = Vector::Zero();  ///< rad/s
};

/// Where the joints should be: q_e and its derivatives, section 4.2.
template <int Joints, Real Scalar = double>
struct DesiredJoints {
  using Vector = Eigen::Matrix<Scalar, Joints, 1>;
  Vector q = Vector::Zero();      ///< rad
  Vector qdot = Vector::Zero();   ///< rad/s
  Vector qddot = Vector::Zero();  ///< rad/s^2
};

/// @realtime  no allocation for built-in scalars
template <int Joints, Real Scalar>
[[nodiscard]] bool is_finite(const JointState<Joints, Scalar>& state) noexcept {
  return is_finite(state.q) && is_finite(state.qdot);
}

/// @realtime  no allocation for built-in scalars
template <int Joints, Real Scalar>
[[nodiscard]] bool is_finite(const DesiredJoints<Joints, Scalar>& desired) noexcept {
  return is_finite(desired.q) && is_finite(desired.qdot) && is_finite(desired.qddot);
}

}  // namespace limpid
