// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/robot/body_inertia.hpp>
#include <limpid/robot/denavit_hartenberg.hpp>
#include <limpid/robot/robot.hpp>
#include <limpid/robot/serial_chain_pose.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace limpid {

/// Any serial arm of N revolute or prismatic joints, by a table of Denavit-Hartenberg parameters (modified convention).
/// Where a joint is prismatic read m for rad and N for N m. Models Robot with 11 N parameters: see SerialChainPose.
///
/// @realtime  at: no allocation, no throw; N sines and cosines
template <int N, Real Scalar_ = double>
requires(N >= 1) class SerialChain {
 public:
  using Scalar = Scalar_;
  static constexpr int joints = N;
  static constexpr int parameters = 11 * N;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Joints = Eigen::Matrix<Scalar, N, 1>;
  using Parameters = Eigen::Matrix<Scalar, parameters, 1>;
  using Pose = SerialChainPose<N, Scalar>;
  template <typename T>
  using PerLink = std::array<T, static_cast<std::size_t>(N)>;

  struct Settings {
    PerLink<DenavitHartenberg<Scalar>> links;                                   ///< from the base to the tip
    Vector tip = Vector::Zero();                                                ///< in the last frame, m
    Vector gravity = Vector(Scalar(0), Scalar(0), -Scalar(981) / Scalar(100));  ///< in the base frame, m/s^2
    JointLimits<N, Scalar> limits = one_turn();                                 ///< of the joints
  };

  /// @throws std::invalid_argument  where an entry is not finite or a limit cannot be
  explicit SerialChain(const Settings& settings)
      : fixed_{.turns = Joints::Ones(), .tip = settings.tip, .gravity = settings.gravity}, limits_{settings.limits} {
    for (int i = 0; i < N; ++i) {
      const auto& row = settings.links[static_cast<std::size_t>(i)];
      const Eigen::Matrix<Scalar, 4, 1> entries(row.alpha, row.a, row.d, row.theta);
      expect(is_finite(entries), "SerialChain: links[" + std::to_string(i) + "]", "finite", entries);
      rows_[static_cast<std::size_t>(i)] = DenavitHartenbergRow<Scalar>(row);
      fixed_.turns[i] = rows_[static_cast<std::size_t>(i)].turns();
    }
    expect(is_finite(settings.tip), "SerialChain: tip", "finite", settings.tip);
    expect(is_finite(settings.gravity), "SerialChain: gravity", "finite", settings.gravity);
    expect((limits_.lower.array() < limits_.upper.array()).all(), "SerialChain: limits.lower", "< upper",
           limits_.lower);
    expect((limits_.torque.array() > Scalar(0)).all(), "SerialChain: limits.torque", "> 0", limits_.torque);
    expect(is_finite(limits_.static_friction) && (limits_.static_friction.array() >= Scalar(0)).all(),
           "SerialChain: limits.static_friction", "finite and >= 0", limits_.static_friction);
  }

  /// The arm with its joints at q, rad.
  [[nodiscard]] Pose at(const Joints& q) const noexcept {
    typename Pose::Frames frames;
    for (int i = 0; i < N; ++i) {
      const auto link = static_cast<std::size_t>(i);
      frames[link] = rows_[link].at(q[i]);
    }
    return {fixed_, frames};
  }

  [[nodiscard]] const JointLimits<N, Scalar>& limits() const noexcept { return limits_; }
  [[nodiscard]] const Vector& tip() const noexcept { return fixed_.tip; }          ///< in the last frame, m
  [[nodiscard]] const Vector& gravity() const noexcept { return fixed_.gravity; }  ///< in the base frame, m/s^2

  /// theta of links that rest in their frames, with viscous friction in the joints, N m s/rad.
  [[nodiscard]] static Parameters theta(const PerLink<BodyParameters<Scalar>>& links,
                                        const Joints& friction = Joints::Zero()) noexcept {
    Parameters theta;
    for (int i = 0; i < N; ++i) theta.template segment<10>(10 * i) = links[static_cast<std::size_t>(i)];
    theta.template tail<N>() = friction;
    return theta;
  }

  /// A bound of the tip's distance from the base frame's origin, m; infinite with a sliding joint that has no limits.
  [[nodiscard]] Scalar reach() const noexcept {
    Scalar reach = fixed_.tip.norm();
    for (int i = 0; i < N; ++i) {
      const auto& row = rows_[static_cast<std::size_t>(i)];
      using std::max;
      if (!(row.turns() > Scalar(0)) && !(is_finite(limits_.lower[i]) && is_finite(limits_.upper[i]))) {
        return std::numeric_limits<Scalar>::infinity();
      }
      reach += row.turns() > Scalar(0) ? row.at(Scalar(0)).p.norm()
                                       : max(row.at(limits_.lower[i]).p.norm(), row.at(limits_.upper[i]).p.norm());
    }
    return reach;
  }

 private:
  [[nodiscard]] static JointLimits<N, Scalar> one_turn() {
    using std::acos;
    const Scalar pi = acos(Scalar(-1));
    return {.lower = Joints::Constant(-pi),
            .upper = Joints::Constant(pi),
            .torque = Joints::Constant(std::numeric_limits<Scalar>::infinity()),
            .static_friction = Joints::Zero()};
  }

  typename Pose::Fixed fixed_;
  JointLimits<N, Scalar> limits_;
  PerLink<DenavitHartenbergRow<Scalar>> rows_;
};

}  // namespace limpid
