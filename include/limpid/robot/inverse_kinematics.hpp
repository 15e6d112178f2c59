// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/robot/joint_state.hpp>

#include <Eigen/Core>

#include <concepts>

namespace limpid {

/// Joints that put the tip somewhere.
template <int Joints, Real Scalar = double>
struct InverseJoints {
  Eigen::Matrix<Scalar, Joints, 1> q;  ///< rad; always finite
  Status status;                       ///< not_finite, unreachable, singular
};

/// Joints that move the tip in a given way; usable wherever `DesiredJoints` is.
template <int Joints, Real Scalar = double>
struct InverseMotion : DesiredJoints<Joints, Scalar> {
  Status status;  ///< not_finite, unreachable, singular
};

/// How limpid sees the inverse kinematics of an arm; specialise it to adapt a foreign type. Minimal:
///
///     using Scalar;                                // a Real
///     static constexpr int joints;                 // n
///     static inverse(const K&, x, near);           // an InverseJoints
///     static inverse(const K&, x, v, a, near);     // an InverseMotion
///
/// x, v, a: tip in the base frame, m, m/s, m/s^2. near: joints that the answer should be close to, rad; where the
/// target leaves the answer open it decides, and a search starts there.
/// A type with members of these names needs no specialisation.
template <typename K>
struct InverseKinematicsTraits {};

template <typename K>
requires requires(const K k, const Eigen::Matrix<typename K::Scalar, 3, 1> point,
                  const Eigen::Matrix<typename K::Scalar, K::joints, 1> near) {
  k.inverse(point, near);
  k.inverse(point, point, point, near);
}
struct InverseKinematicsTraits<K> {
  using Scalar = typename K::Scalar;
  static constexpr int joints = K::joints;
  using Point = Eigen::Matrix<Scalar, 3, 1>;
  using Joints = Eigen::Matrix<Scalar, joints, 1>;

  static auto inverse(const K& k, const Point& x, const Joints& near) noexcept { return k.inverse(x, near); }
  static auto inverse(const K& k, const Point& x, const Point& v, const Point& a, const Joints& near) noexcept {
    return k.inverse(x, v, a, near);
  }
};

/// Laws: inside the limits the robot's tip at q is x, and q', q'' reproduce v and a by (3.7), (3.10), with status ok.
/// Singular targets, and those that the joints cannot reach within their limits, give joints within the limits near the
/// target with bounded rates, and say so; non-finite targets give `near` at rest. The answer is always finite; nothing
/// throws or allocates. Models: OmniKinematics, FiveBarKinematics.
template <typename K, typename Traits = InverseKinematicsTraits<K>>
concept InverseKinematics = Real<typename Traits::Scalar> &&
    requires(const K k, const Eigen::Matrix<typename Traits::Scalar, 3, 1> point,
             const Eigen::Matrix<typename Traits::Scalar, Traits::joints, 1> near) {
  { Traits::inverse(k, point, near) } -> std::convertible_to<InverseJoints<Traits::joints, typename Traits::Scalar>>;
  {
    Traits::inverse(k, point, point, point, near)
    } -> std::convertible_to<InverseMotion<Traits::joints, typename Traits::Scalar>>;
};

}  // namespace limpid
