// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/estimation/projection_rls.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <cmath>
#include <cstdint>

namespace limpid::stress {

/// How far theta_hat and Gamma of (k, b, c) are from those in 50 digits, after many ticks.
struct LawErrors {
  double theta[3];  ///< largest, in parts of the width of the box: k, b, c
  double Gamma;     ///< largest entry, in parts of its diagonal ones
  bool definite;    ///< at every tick
};

/// The law on a press with a rough force for `ticks` ms; compared over the last 10 s. The law in 50 digits sees the
/// last 40 s alone: what went before weighs e^-60 at 30 s and less after.
template <typename Scalar>
LawErrors law_errors(std::uint64_t ticks) {
  using test::Fifty;
  constexpr std::uint64_t window = 40'000, compared = 10'000;
  constexpr double lower[] = {200, 20, -55}, upper[] = {2000, 40, 0}, gain[] = {1e9, 8e6, 1e4};
  const auto law_of = [&]<typename S>(S) {
    typename ProjectionRLS<3, 1, S>::Settings s;
    for (int j = 0; j < 3; ++j) {
      s.lower(j) = S(lower[j]);
      s.upper(j) = S(upper[j]);
      s.initial_gain(j) = S(gain[j]);
    }
    s.initial = (s.lower + s.upper) / S(2);
    s.normalisation = S(Scalar(0.01));  // the same number
    return ProjectionRLS<3, 1, S>(s);
  };
  auto law = law_of(Scalar{});
  auto exact = law_of(Fifty{});
  LawErrors errors{{0, 0, 0}, 0, true};
  const Scalar dt = Scalar(0.001);
  for (std::uint64_t i = 0; i < ticks; ++i) {
    const double t = 1e-3 * double(i), x = 0.006 * (1 - std::cos(3 * t)) + 0.001 * std::sin(11 * t);
    const double v = 0.018 * std::sin(3 * t) + 0.011 * std::cos(11 * t);
    const double rough = 0.02 * std::sin(1e3 * std::sin(double(i)));
    const Scalar phi[] = {Scalar(x), Scalar(v), Scalar(1)}, F = Scalar(800 * x + 30 * v - 5 + rough);
    (void)law.update(dt, {{phi[0], phi[1], phi[2]}}, Eigen::Array<Scalar, 1, 1>(F));
    const auto [U, D] = law.factors(0);
    errors.definite = errors.definite && (D.array() > Scalar{0}).all() && is_finite(U) && is_finite(D);
    if (i + window < ticks) continue;
    (void)exact.update(Fifty(dt), {{Fifty(phi[0]), Fifty(phi[1]), Fifty(phi[2])}}, Eigen::Array<Fifty, 1, 1>(Fifty(F)));
    if (i + compared < ticks || i % 100 != 0) continue;
    const auto Gamma = exact.gain(0);
    for (int j = 0; j < 3; ++j) {
      const double error = double(Fifty(law.theta()(0, j)) - exact.theta()(0, j)) / (upper[j] - lower[j]);
      errors.theta[j] = test::maximum(errors.theta[j], std::abs(error));
      for (int k = 0; k < 3; ++k) {
        const double size = std::sqrt(double(Gamma(j, j)) * double(Gamma(k, k)));
        errors.Gamma = test::maximum(errors.Gamma, std::abs(double(Fifty(law.gain(0)(j, k)) - Gamma(j, k))) / size);
      }
    }
  }
  return errors;
}

}  // namespace limpid::stress
