// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/truth.hpp"

#include <common/sensing.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace limpid::bench {

using examples::Sensing;

/// Of the tool, in ticks: it arrives a period after it was taken.
struct SensedSample {
  std::size_t taken = 0, arrived = 0;
  double x = 0, v = 0, F_e = 0;  ///< m, m/s, N
};

/// In the order of their instants; the first one is taken at the start.
/// @param period  ticks
[[nodiscard]] std::vector<SensedSample> sampled(const Truth& truth, std::size_t period, const Sensing& sensing,
                                                std::uint32_t seed);

/// The same for the same name everywhere, whatever else is run.
[[nodiscard]] std::uint32_t seed_of(const std::string& name);

}  // namespace limpid::bench
