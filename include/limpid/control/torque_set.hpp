// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace limpid {

/// The torques that are allowed at one pose: an interval around zero for each joint, and half-spaces around zero.
///
///     lower <= tau <= upper, lower <= 0 <= upper            normal' tau >= -slack, slack >= 0
///
/// The set is convex and contains zero, so that scaling an allowed torque down, or moving straight from one allowed
/// torque to another, never leaves it. Rules come with a share: 1 lets everything pass, 0 nothing, and between them
/// what passes is proportional to it, so that a share that is continuous in the pose makes a set that is.
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
  explicit TorqueSet(const Vector& most) noexcept : most_{most}, lower_{-most}, upper_{most} {
    below_.fill(Status::limited);
    above_.fill(Status::limited);
  }

  /// Leaves a joint the share, 0 to 1, of its positive torques.
  void narrow_positive(Eigen::Index joint, const Scalar& share, Status rule) noexcept {
    if (!(share < Scalar(1))) return;
    const Scalar bound = share * most_[joint];
    if (bound <= upper_[joint]) add(above_[static_cast<std::size_t>(joint)], rule, bound == upper_[joint]);
    upper_[joint] = std::min(upper_[joint], bound);
  }

  /// Leaves a joint the share, 0 to 1, of its negative torques.
  void narrow_negative(Eigen::Index joint, const Scalar& share, Status rule) noexcept {
    if (!(share < Scalar(1))) return;
    const Scalar bound = -share * most_[joint];
    if (bound >= lower_[joint]) add(below_[static_cast<std::size_t>(joint)], rule, bound == lower_[joint]);
    lower_[joint] = std::max(lower_[joint], bound);
  }

  /// Demands -normal' tau <= share times its largest value over the largest torques; `share` as above. At most
  /// `HalfSpaces` times: one rule too many leaves no torque but zero.
  void demand(const Vector& normal, const Scalar& share, Status rule) noexcept {
    if (!(share < Scalar(1))) return;
    if constexpr (HalfSpaces > 0) {
      if (count_ < half_spaces_.size()) {
        half_spaces_[count_++] = {normal, share * normal.cwiseAbs().dot(most_), rule};
        return;
      }
    }
    for (Eigen::Index i = 0; i < Joints; ++i) {
      narrow_positive(i, Scalar(0), rule);
      narrow_negative(i, Scalar(0), rule);
    }
  }

  /// Brings a finite torque into the set: each entry is clamped, and what then violates a half-space goes to the
  /// nearest torque, in the 2-norm, that does not and keeps the intervals. So the answer is continuous in the torque
  /// and, as far as the set is, in the pose, and is no longer than the clamped torque; an entry may turn its sign where
  /// that is the nearest. With several half-spaces that are violated at once it is scaled down until all are kept.
  [[nodiscard]] Fitted fit(const Vector& torque) const noexcept {
    Fitted fitted{torque.cwiseMin(upper_).cwiseMax(lower_), Status::ok};
    for (Eigen::Index i = 0; i < Joints; ++i) {
      if (torque[i] > upper_[i]) fitted.status |= above_[static_cast<std::size_t>(i)];
      if (torque[i] < lower_[i]) fitted.status |= below_[static_cast<std::size_t>(i)];
    }
    if constexpr (HalfSpaces > 0) {
      for (std::size_t pass = 0; pass < count_; ++pass) {  // keeping one half-space may break another
        for (std::size_t k = 0; k < count_; ++k) fitted.status |= keep(half_spaces_[k], fitted.torque);
      }
      for (std::size_t k = 0; k < count_; ++k) scale_into(half_spaces_[k], fitted.torque);
    }
    return fitted;
  }

 private:
  struct HalfSpace {
    Vector normal;
    Scalar slack;
    Status rule;
  };

  static void add(Status& rules, Status rule, bool same_bound) noexcept {
    rules = same_bound && rules != Status::limited ? rules | rule : rule;
  }

  // The nearest torque is tau + lambda normal, clamped: entries that meet a bound stay there, the others share the
  // rest.
  Status keep(const HalfSpace& half_space, Vector& tau) const noexcept {
    const Vector& normal = half_space.normal;
    Scalar kept = normal.dot(tau);
    if (kept >= -half_space.slack) return Status::ok;
    // a few roundings inside, so that it is kept however the sum is rounded
    const Scalar inside = Scalar(4 * Joints) * std::numeric_limits<Scalar>::epsilon() * normal.cwiseAbs().dot(most_);
    for (int pass = 0; pass < Joints && kept < inside - half_space.slack; ++pass) {
      Scalar square(0);
      for (Eigen::Index i = 0; i < Joints; ++i) square += can_help(normal, tau, i) ? normal[i] * normal[i] : Scalar(0);
      if (!(square > Scalar(0))) break;
      const Scalar lambda = (inside - half_space.slack - kept) / square;
      for (Eigen::Index i = 0; i < Joints; ++i) {
        tau[i] = std::min(std::max(tau[i] + lambda * normal[i], lower_[i]), upper_[i]);
      }
      kept = normal.dot(tau);
    }
    return half_space.rule;
  }

  [[nodiscard]] bool can_help(const Vector& normal, const Vector& tau, Eigen::Index i) const noexcept {
    return normal[i] > Scalar(0) ? tau[i] < upper_[i] : tau[i] > lower_[i];
  }

  static void scale_into(const HalfSpace& half_space, Vector& tau) noexcept {
    const Scalar kept = half_space.normal.dot(tau);
    if (kept >= -half_space.slack) return;
    const Scalar down = half_space.slack / -kept;
    tau *= down * (Scalar(1) - Scalar(4 * Joints) * std::numeric_limits<Scalar>::epsilon());
    if (!(half_space.normal.dot(tau) >= -half_space.slack)) tau.setZero();
  }

  Vector most_, lower_, upper_;                            // N m
  std::array<Status, std::size_t{Joints}> below_, above_;  // the rule behind each bound
  std::array<HalfSpace, std::size_t{HalfSpaces}> half_spaces_;
  std::size_t count_ = 0;
};

}  // namespace limpid
