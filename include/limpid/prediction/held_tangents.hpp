// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

#include <limits>
#include <string>

namespace limpid::detail {

/// rho = (dF_e/dx, dF_e/dv) as a gain's design knows it: inside a box, and no faster than some rate. Beyond them
/// nothing is known of stability.
/// @realtime  update: no allocation, no throw; some 8 flops an axis
template <int Axes, Real Scalar>
class HeldTangents {
 public:
  using Rho = Tangents<Axes, Scalar>;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  [[nodiscard]] static Rho no_limit() noexcept {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    return {Vector::Constant(infinity), Vector::Constant(infinity)};
  }
  /// @param gain  whose rate it is
  /// @throws std::invalid_argument  where an entry is not positive
  static void check_rate(const std::string& gain, const Rho& rate) {
    expect((rate.stiffness > Scalar{0}).all(), gain + ": rate stiffness", "> 0", rate.stiffness);
    expect((rate.damping > Scalar{0}).all(), gain + ": rate damping", "> 0", rate.damping);
  }

  /// Follows `rho`, `dt` seconds after the last time (the first time without limit of rate).
  /// @param lower, upper  of the box: stiffness, damping; a Vector or one Scalar for all axes
  /// @return  at_bound where the box or the rate held rho back; not_finite (dt or rho) or clock_backwards (dt < 0):
  ///          nothing changed
  template <typename Side>
  Status update(const Scalar& dt, const Rho& rho, const Side& lower, const Side& upper, const Rho& rate) noexcept {
    if (!(dt >= Scalar{0}) || !are_finite(rho.stiffness, rho.damping)) [[unlikely]]
      return dt < Scalar{0} ? Status::clock_backwards : Status::not_finite;
    const bool stiffness_held = move(k_, rho.stiffness, lower.stiffness, upper.stiffness, rate.stiffness * dt);
    const bool damping_held = move(b_, rho.damping, lower.damping, upper.damping, rate.damping * dt);
    started_ = true;
    return when(stiffness_held || damping_held, Status::at_bound);
  }

  [[nodiscard]] const Vector& stiffness() const noexcept { return k_; }
  [[nodiscard]] const Vector& damping() const noexcept { return b_; }

 private:
  template <typename Bound>
  bool move(Vector& from, const Vector& to, const Bound& lower, const Bound& upper, const Vector& most) const noexcept {
    Vector target = to.max(lower).min(upper);
    if (started_) {  // by comparisons that a rate without limit over no time, NaN, does not pass
      const Vector least = from - most, largest = from + most;
      target = (target < least).select(least, target);
      target = (target > largest).select(largest, target);
    }
    from = target;
    return (target != to).any();
  }

  Vector k_ = Vector::Zero(), b_ = Vector::Zero();
  bool started_ = false;
};

}  // namespace limpid::detail
