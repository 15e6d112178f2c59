// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/environment/tool.hpp>

namespace limpid::detail {

/// Position and velocity with the axes in lanes: what predictors keep of a `Motion`.
template <int Axes, Real Scalar_>
struct LaneMotion {
  using Scalar = Scalar_;
  using Array = Lanes<Axes, Scalar>;

  Array x;  // m
  Array v;  // m/s

  LaneMotion() noexcept {
    x.setZero();
    v.setZero();
  }
  // by whole packets, which a constructor's own copy is not
  LaneMotion(const LaneMotion& other) noexcept { *this = other; }
  LaneMotion(LaneMotion&& other) noexcept { *this = other; }
  LaneMotion& operator=(const LaneMotion& other) noexcept {
    x = other.x;
    v = other.v;
    return *this;
  }
  LaneMotion& operator=(LaneMotion&& other) noexcept {
    *this = other;
    return *this;
  }
  ~LaneMotion() = default;
  LaneMotion(const Array& position, const Array& velocity) noexcept : x{position}, v{velocity} {}
  /// Of a type with axes x and v, as `Motion` and `ToolState`.
  template <typename M>
  explicit LaneMotion(const M& motion) noexcept : x{to_lanes<Axes>(motion.x)}, v{to_lanes<Axes>(motion.v)} {}

  /// With an acceleration, m/s^2.
  [[nodiscard]] Motion<Axes, Scalar> with(const Array& a) const noexcept {
    return {limpid::from_lanes<Axes>(x), limpid::from_lanes<Axes>(v), limpid::from_lanes<Axes>(a)};
  }

  friend bool is_finite(const LaneMotion& motion) noexcept { return are_finite(motion.x, motion.v); }
  friend LaneMotion operator+(const LaneMotion& l, const LaneMotion& r) noexcept { return {l.x + r.x, l.v + r.v}; }
  friend LaneMotion operator-(const LaneMotion& l, const LaneMotion& r) noexcept { return {l.x - r.x, l.v - r.v}; }
  friend LaneMotion operator*(const LaneMotion& m, const Scalar& s) noexcept { return {m.x * s, m.v * s}; }
};

}  // namespace limpid::detail
