// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/environment/tool.hpp>

namespace limpid::detail {

/// The cubic in time through the positions and velocities of two motions, with its own velocity and acceleration.
/// @param part  of the way: 0 at `from`, 1 at `to`
/// @param h     from one to the other, s, > 0
/// @realtime    no allocation, no throw; 20 flops an axis
template <int Axes, Real Scalar>
[[nodiscard]] Motion<Axes, Scalar> cubic_hermite(const Motion<Axes, Scalar>& from, const Motion<Axes, Scalar>& to,
                                                 const Scalar& part, const Scalar& h) noexcept {
  using Vector = typename Motion<Axes, Scalar>::Vector;
  // x0 + v0 t + c2 s^2 + c3 s^3, s = t/h
  const Vector off = to.x - from.x - from.v * h, turn = (to.v - from.v) * h;
  const Vector c2 = off * Scalar{3} - turn, c3 = turn - off * Scalar{2};
  const Scalar rate = Scalar{1} / h;
  return {from.x + part * (from.v * h + part * (c2 + part * c3)),
          from.v + part * rate * (c2 * Scalar{2} + part * (c3 * Scalar{3})),
          rate * rate * (c2 * Scalar{2} + part * (c3 * Scalar{6}))};
}

}  // namespace limpid::detail
