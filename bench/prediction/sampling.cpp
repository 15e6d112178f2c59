// SPDX-License-Identifier: MIT
#include "prediction/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace limpid::bench {

namespace {

double rounded(double value, double step) { return step > 0 ? std::round(value / step) * step : value; }

}  // namespace

std::vector<SensedSample> sampled(const Truth& truth, std::size_t period, const Sensing& sensing, std::uint32_t seed) {
  std::mt19937 random(seed);  // NOLINT(cert-msc51-cpp): the same noise in every run
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1), part(0, 1);
  std::vector<SensedSample> samples;
  for (std::size_t k = 0;; ++k) {
    const double off = k > 0 ? sensing.jitter * static_cast<double>(period) * uniform(random) : 0;
    const auto taken = static_cast<std::size_t>(std::llround(static_cast<double>(k * period) + off));
    if (taken >= truth.ticks.size()) break;
    const double x_noise = normal(random), v_noise = normal(random), F_noise = normal(random);
    if (part(random) < sensing.loss) continue;
    const TrueTick& tick = truth.ticks[taken];
    samples.push_back({taken, taken + period,
                       rounded(tick.tool.x + sensing.position_noise * x_noise, sensing.position_step),
                       tick.tool.v + sensing.velocity_noise * v_noise,
                       rounded(tick.F_e + sensing.force_noise * F_noise, sensing.force_step)});
  }
  std::ranges::sort(samples, {}, &SensedSample::taken);
  return samples;
}

// FNV-1a.
std::uint32_t seed_of(const std::string& name) {
  std::uint32_t hash = 2166136261;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

}  // namespace limpid::bench
