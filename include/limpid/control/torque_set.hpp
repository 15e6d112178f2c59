// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>

namespace limpid {

/// The torques that are allowed at one pose: an interval around zero for each joint, and half-spaces through zero.
///
///     lower <= tau <= upper, lower <= 0 <= upper            normal' tau >= 0
///
/// The set is convex and contains zero, so that scaling an allowed torque down, or moving straight from one allowed
/// torque to another, never leaves it.
/// @tparam HalfSpaces  how many half-spaces there may be
/// @realtime           no allocation, no throw
template <int Joints, Real Scalar, int HalfSpaces = 0>
class TorqueSet {
 public:
  using Vector = Eigen::Matrix<Scalar, Joints, 1>;

  struct Fitted {
    Vector torque;  ///< N m, in the set
    Status status;  ///< the rules that took something away
  };

  /// @param most  largest magnitude of each joint's torque, N m, not negative
  explicit TorqueSet(const Vector& most) noexcept : lower_{-most}, upper_{most} {
    below_.fill(Status::limited);
    above_.fill(Status::limited);
  }

  void forbid_positive(Eigen::Index joint, Status rule) noexcept {
    upper_[joint] = Scalar(0);
    add(above_[static_cast<std::size_t>(joint)], rule);
  }

  void forbid_negative(Eigen::Index joint, Status rule) noexcept {
    lower_[joint] = Scalar(0);
    add(below_[static_cast<std::size_t>(joint)], rule);
  }

  /// Demands normal' tau >= 0; at most `HalfSpaces` times.
  void demand(const Vector& normal, Status rule) noexcept {
    half_spaces_[count_] = {normal, rule};
    ++count_;
  }

  /// Brings a finite torque into the set by moving entries toward zero only: each is clamped, then those that oppose a
  /// half-space are scaled down together until the others balance them.
  [[nodiscard]] Fitted fit(const Vector& torque) const noexcept {
    Fitted fitted{torque, Status::ok};
    Vector& tau = fitted.torque;
    for (Eigen::Index i = 0; i < Joints; ++i) {
      if (tau[i] > upper_[i]) fitted.status |= above_[static_cast<std::size_t>(i)];
      if (tau[i] < lower_[i]) fitted.status |= below_[static_cast<std::size_t>(i)];
      tau[i] = std::min(std::max(tau[i], lower_[i]), upper_[i]);
    }
    if constexpr (HalfSpaces > 0) {
      for (std::size_t pass = 0; pass < count_; ++pass) {  // balancing one half-space may tip another
        for (std::size_t k = 0; k < count_; ++k) fitted.status |= balance(half_spaces_[k], tau);
      }
      for (std::size_t k = 0; k < count_; ++k) {
        if (!(half_spaces_[k].normal.dot(tau) >= Scalar(0))) tau.setZero();
      }
    }
    return fitted;
  }

 private:
  struct HalfSpace {
    Vector normal;
    Status rule;
  };

  static void add(Status& rules, Status rule) noexcept { rules = rules == Status::limited ? rule : rules | rule; }

  static Status balance(const HalfSpace& half_space, Vector& tau) noexcept {
    const auto parts = half_space.normal.cwiseProduct(tau).eval();
    const Scalar for_it = parts.cwiseMax(Scalar(0)).sum(), against = -parts.cwiseMin(Scalar(0)).sum();
    if (!(against > for_it)) return Status::ok;
    // a few roundings less than balance, so that the sum is not negative however it is rounded
    const Scalar down = for_it / against * (Scalar(1) - Scalar(4 * Joints) * std::numeric_limits<Scalar>::epsilon());
    for (Eigen::Index i = 0; i < Joints; ++i) tau[i] = parts[i] < Scalar(0) ? tau[i] * down : tau[i];
    return half_space.rule;
  }

  Vector lower_, upper_;                                   // N m
  std::array<Status, std::size_t{Joints}> below_, above_;  // the rule behind each bound
  std::array<HalfSpace, std::size_t{HalfSpaces}> half_spaces_;
  std::size_t count_ = 0;
};

}  // namespace limpid
