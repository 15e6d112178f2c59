// SPDX-License-Identifier: MIT
#include "sensing.hpp"

#include <cmath>

namespace limpid::examples {

namespace {

double rounded(double value, double step) { return step > 0 ? std::round(value / step) * step : value; }

}  // namespace

void Sensor::draw() {
  off_ = any_ ? uniform_(random_) : 0;
  any_ = true;
  x_noise_ = normal_(random_);
  v_noise_ = normal_(random_);
  F_noise_ = normal_(random_);
  part_ = of_one_(random_);
}

SensedTool Sensor::sense(const SensedTool& truly) const {
  return {rounded(truly.x + sensing_.position_noise * x_noise_, sensing_.position_step),
          truly.v + sensing_.velocity_noise * v_noise_,
          rounded(truly.F_e + sensing_.force_noise * F_noise_, sensing_.force_step)};
}

}  // namespace limpid::examples
