// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <cmath>

namespace limpid {

/// Dahl's presliding: how far the bristles are bent, from -1 to 1, F = F_c z. Over `length` of travel z goes to the
/// sign of v; Coulomb's friction is the limit of no length.
///
///     z' = (v - |v| z) / length
///
/// (P. Dahl, A solid friction model, 1968.) A velocity that is constant over a step is taken exactly, so |z| <= 1
/// stays.
/// @param length  m, > 0
/// @realtime      no allocation for built-in scalars; an exponential
template <Real Scalar>
[[nodiscard]] Scalar presliding_after(const Scalar& z, const Scalar& v, const Scalar& h,
                                      const Scalar& length) noexcept {
  using std::abs;
  using std::exp;
  const Scalar end = v < Scalar{0} ? Scalar{-1} : Scalar{1};
  return end + (z - end) * exp(-abs(v) * h / length);
}

}  // namespace limpid
