// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <limits>

namespace limpid {

/// Virtual coupling after Colgate, Stanley and Brown, and Adams and Hannaford: a spring and a damper between the device
/// and a virtual tool, which pull both with equal and opposite forces.
///
///     F = K_c (x_device - x_tool) + B_c (v_device - v_tool)     on the tool; -F on the device
///
/// It parts the stability of what the hand feels from the virtual world, which need only be passive. Design K_c and B_c
/// with `stiffest_coupling` and `largest_coupling_stiffness` of design/virtual_coupling_design.hpp, for the damping b
/// that the device has for certain; a little below K_c of the design, since that stands on the limit. Their
/// Z_c(z) = B_c + K_c T z/(z - 1) is the coupling of positions alone, whose velocity is the backward difference.
/// @tparam Axes  number of independent axes
/// @realtime     no allocation, no throw; 4 flops an axis
template <int Axes = 1, Real Scalar = double>
class VirtualCoupling {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    Vector stiffness = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< K_c, N/m, >= 0
    Vector damping = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());    ///< B_c, N s/m, >= 0
  };

  /// Where an end of the coupling is.
  struct End {
    Vector x = Vector::Zero();  ///< m
    Vector v = Vector::Zero();  ///< m/s
  };

  struct Output {
    Vector on_tool;    ///< N; always finite
    Vector on_device;  ///< N: -on_tool
    Status status;     ///< `not_finite` or `clock_backwards`: the forces are the last ones
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit VirtualCoupling(const Settings& settings) : K_c_{settings.stiffness}, B_c_{settings.damping} {
    expect(is_finite(K_c_) && (K_c_ >= Scalar{0}).all(), "VirtualCoupling: stiffness", "finite and >= 0", K_c_);
    expect(is_finite(B_c_) && (B_c_ >= Scalar{0}).all(), "VirtualCoupling: damping", "finite and >= 0", B_c_);
  }

  /// With the velocities as they are known, such as those of a filter or of the virtual tool's own motion.
  [[nodiscard]] Output update(Time now, const End& device, const End& tool) noexcept {
    const Vector stretch = device.x - tool.x;
    return pull(now, stretch, device.v - tool.v);
  }

  /// With the velocity by backward difference over the tick as long as it was; the first call takes it as zero.
  [[nodiscard]] Output update_positions(Time now, const Vector& x_device, const Vector& x_tool) noexcept {
    const Vector stretch = x_device - x_tool;
    if (!started_) return pull(now, stretch, stretch * Scalar{0});
    if (now <= now_) return answer(Status::clock_backwards);
    return pull(now, stretch, (stretch - stretch_) / in_seconds<Scalar>(elapsed(now, now_)));
  }

  /// Forgets the past: the next call is a first one, and until then there is no force to keep.
  void reset() noexcept {
    started_ = false;
    force_.setZero();
  }

 private:
  Output pull(Time now, const Vector& stretch, const Vector& rate) noexcept {
    if (started_ && now <= now_) return answer(Status::clock_backwards);
    const Vector force = K_c_ * stretch + B_c_ * rate;
    if (!is_finite(force) || !is_finite(stretch) || !is_finite(rate)) return answer(Status::not_finite);
    started_ = true;
    now_ = now;
    stretch_ = stretch;
    force_ = force;
    return answer(Status::ok);
  }

  [[nodiscard]] Output answer(Status status) const noexcept { return {force_, -force_, status}; }

  Vector K_c_, B_c_;
  bool started_ = false;
  Time now_{};                                                // the last tick,
  Vector stretch_ = Vector::Zero(), force_ = Vector::Zero();  // x_device - x_tool then, and the force on the tool
};

}  // namespace limpid
