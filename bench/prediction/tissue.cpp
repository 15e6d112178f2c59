// SPDX-License-Identifier: MIT
#include "prediction/tissue.hpp"

#include <algorithm>
#include <cmath>

namespace limpid::bench {

namespace {

using Law = std::function<double(double)>;

Law linear(double k) {
  return [=](double x) { return k * x; };
}

// (3.34)
Law smooth_bilinear(double k1, double k2, double depth, double sharpness) {
  return [=](double x) {
    const double away = sharpness * (x / depth - 1);
    const double s = depth / sharpness * (std::max(away, 0.0) + std::log1p(std::exp(-std::abs(away))));
    return k1 * (x - s) + k2 * s;
  };
}

Law power(double k, double exponent) {
  return [=](double x) { return std::copysign(k * std::pow(std::abs(x), exponent), x); };
}

// Slopes of 400, 1500 and 800 N/m.
double three_layers(double x) { return 400 * x + 1100 * std::max(x - 0.0015, 0.0) - 700 * std::max(x - 0.0025, 0.0); }

// The slope falls from 1400 N/m to 500 N/m at 3 mm and stays.
double softening(double x) {
  constexpr double end = 0.003, fall = 900 / end;
  const double depth = std::abs(x), bent = std::min(depth, end);
  return std::copysign(1400 * bent - fall * bent * bent / 2 + 500 * (depth - bent), x);
}

}  // namespace

const std::vector<Tissue>& tissues() {
  constexpr double touched = 0.001;
  static const std::vector<Tissue> all{
      {.name = "A", .elastic = smooth_bilinear(370, 1980, 0.0028, 20)},
      {.name = "B", .elastic = smooth_bilinear(450, 1000, 0.005, 20)},
      {.name = "power", .elastic = power(1500, 1.3)},
      {.name = "exponential", .elastic = [](double x) { return 0.5 * std::expm1(600 * x); }},
      {.name = "layered", .elastic = three_layers, .smooth = false},
      {.name = "linear200", .elastic = linear(200)},
      {.name = "linear800", .elastic = linear(800)},
      {.name = "linear2000", .elastic = linear(2000)},
      {.name = "wall",
       .elastic = [](double x) { return 1500 * std::max(x - touched, 0.0); },
       .edge = touched,
       .smooth = false},
      {.name = "steepening", .elastic = power(36000, 1.7), .held_out = true},
      {.name = "softening", .elastic = softening, .damping = 20, .held_out = true},
  };
  return all;
}

}  // namespace limpid::bench
