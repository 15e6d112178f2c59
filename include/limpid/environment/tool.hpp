// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/signal/intersample.hpp>
#include <limpid/signal/sample.hpp>

#include <Eigen/Core>

namespace limpid {

/// The virtual tool between the operator's force and the environment's, eq. (3.29):
///
///     m_t x'' + b_t x' + k_t (x - anchor) = F_h - F_e
///
/// Positions are relative to the wall, depth and force positive into it.
/// @tparam Axes  number of axes, each moving for itself
template <int Axes = 1, Real Scalar = double>
struct Tool {
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  Scalar mass{0};                  ///< m_t, kg, > 0
  Scalar damping{0};               ///< b_t, N s/m, >= 0
  Scalar stiffness{0};             ///< k_t, N/m, >= 0
  Vector anchor = Vector::Zero();  ///< where the tool's spring is relaxed, m

  /// @throws std::invalid_argument  where a field cannot be a tool's, or is too large for so small a mass
  void check() const {
    expect(is_finite(mass) && mass > Scalar{0}, "Tool: mass", "finite and > 0", mass);
    expect(is_finite(damping) && damping >= Scalar{0}, "Tool: damping", "finite and >= 0", damping);
    expect(is_finite(stiffness) && stiffness >= Scalar{0}, "Tool: stiffness", "finite and >= 0", stiffness);
    expect(is_finite(anchor), "Tool: anchor", "finite", anchor);
    expect(is_finite(Scalar(Scalar{1} / mass)), "Tool: mass", "a finite 1/mass", mass);
    expect(is_finite(Scalar(damping / mass)), "Tool: damping", "finite over the mass", damping);
    expect(is_finite(Scalar(stiffness / mass)), "Tool: stiffness", "finite over the mass", stiffness);
    expect(is_finite(Vector(stiffness * anchor / mass)), "Tool: anchor", "a finite force of the spring over the mass",
           anchor);
  }
};

/// Position, velocity and acceleration of a point; adds and scales as a vector does, so that a History can interpolate.
template <int Axes = 1, Real Scalar_ = double>
struct Motion {
  using Scalar = Scalar_;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  Vector x = Vector::Zero();  ///< m
  Vector v = Vector::Zero();  ///< m/s
  Vector a = Vector::Zero();  ///< m/s^2

  friend Motion operator+(const Motion& l, const Motion& r) noexcept { return {l.x + r.x, l.v + r.v, l.a + r.a}; }
  friend Motion operator-(const Motion& l, const Motion& r) noexcept { return {l.x - r.x, l.v - r.v, l.a - r.a}; }
  friend Motion operator*(const Motion& m, const Scalar& s) noexcept { return {m.x * s, m.v * s, m.a * s}; }
  friend Motion operator*(const Scalar& s, const Motion& m) noexcept { return m * s; }
};

/// What the environment knows of the tool at one instant.
template <int Axes = 1, Real Scalar_ = double>
struct ToolState {
  using Scalar = Scalar_;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  Vector x = Vector::Zero();      ///< m
  Vector v = Vector::Zero();      ///< m/s
  Vector a = Vector::Zero();      ///< m/s^2
  Vector force = Vector::Zero();  ///< F_e, with which the environment pushes back, N
};

template <int Axes = 1, Real Scalar = double>
using ToolSample = Sample<ToolState<Axes, Scalar>>;

/// @realtime  no allocation; one test for all entries
template <int Axes, Real Scalar>
[[nodiscard]] bool is_finite(const Motion<Axes, Scalar>& motion) noexcept {
  return are_finite(to_lanes<Axes>(motion.x), to_lanes<Axes>(motion.v), to_lanes<Axes>(motion.a));
}

template <int Axes, Real Scalar>
[[nodiscard]] bool is_finite(const ToolState<Axes, Scalar>& state) noexcept {
  return are_finite(to_lanes<Axes>(state.x), to_lanes<Axes>(state.v), to_lanes<Axes>(state.a),
                    to_lanes<Axes>(state.force));
}

}  // namespace limpid
