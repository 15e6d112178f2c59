// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/loop/block.hpp>
#include <limpid/loop/signal.hpp>

#include <array>

/// A small scene with numbers for signals, chosen so that each answer tells which block was called with what.
namespace scene {

using limpid::Status;
using limpid::Time;

struct Force {
  using value_type = double;
};
struct Sample {
  using value_type = double;
};
struct Estimate {
  using value_type = double;
};
struct Motion {
  using value_type = double;
  static double initial() { return -1; }
};
struct Torque {
  using value_type = double;
  static double initial() { return 100; }
};

struct Sampling {
  using reads = limpid::signals<Force>;
  using writes = limpid::signals<Sample>;
  double operator()(Time, double force) noexcept { return force + 1; }
};
struct Estimation {
  using reads = limpid::signals<Sample>;
  using writes = limpid::signals<Estimate>;
  std::array<double, 64> covariance{};  // large, to be missed where it is pruned
  double operator()(Time, double sample) noexcept { return covariance[0] = 10 * sample; }
};
struct KnownPrediction {
  using reads = limpid::signals<Sample, Force>;
  using writes = limpid::signals<Motion>;
  double k = 7;
  double operator()(Time, double sample, double force) noexcept { return k * sample + force; }
};
struct EstimatedPrediction {
  using reads = limpid::signals<Sample, Estimate>;
  using writes = limpid::signals<Motion>;
  double operator()(Time, double sample, double estimate) noexcept { return sample + estimate; }
};
struct Tracking {
  using reads = limpid::signals<Motion>;
  using writes = limpid::signals<Torque>;
  double operator()(Time, double motion) noexcept { return -motion; }
};

}  // namespace scene
