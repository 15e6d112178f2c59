// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/time.hpp>

namespace limpid {

/// What one axis of a sample says: position, velocity, the tissue's force.
template <Real Scalar = double>
struct AxisSample {
  Time taken{};
  Scalar x{0};      ///< m
  Scalar v{0};      ///< m/s
  Scalar force{0};  ///< F_e, N
};

}  // namespace limpid
