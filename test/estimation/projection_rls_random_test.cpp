// SPDX-License-Identifier: MIT
#include <limpid/estimation/projection_rls.hpp>
#include <limpid/estimation/symmetric_eigenvalues.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>

using limpid::ProjectionRLS;
using limpid::test::maximum;

namespace {

/// Steele and Vigna's splitmix64: fast, for a million ticks.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_{seed} {}

  double uniform(double low, double high) {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return low + (high - low) * (double((z ^ (z >> 31)) >> 11) * 0x1p-53);
  }

 private:
  std::uint64_t state_;
};

/// A million ticks of random length, regressor (over eight decades, in bursts, with idling) and force.
template <int N, typename Scalar>
void ramble() {
  constexpr std::uint64_t seed = 20170601;
  using Rls = ProjectionRLS<N, 1, Scalar>;
  typename Rls::Theta lower, upper, gain;
  const double k[] = {200, 20, -55}, K[] = {2000, 40, 0}, g[] = {1e9, 8e6, 1e4};
  for (int j = 0; j < N; ++j) {
    lower(j) = Scalar(k[j]);
    upper(j) = Scalar(K[j]);
    gain(j) = Scalar(g[j]);
  }
  Rls rls({.lower = lower, .upper = upper, .initial = (lower + upper) / Scalar(2), .initial_gain = gain});
  Random random(seed);
  CAPTURE(seed);
  typename Rls::Regressor scale = Rls::Regressor::Zero();
  bool definite = true, inside = true;
  Scalar largest = 0;
  for (int tick = 0; tick < 1'000'000; ++tick) {
    if (tick % 64 == 0) {
      for (int j = 0; j < N; ++j) scale(j) = Scalar(std::exp(random.uniform(-14, 5)));
      if (random.uniform(0, 1) < 0.2) scale.setZero();
    }
    typename Rls::Regressor phi;
    for (int j = 0; j < N; ++j) phi(j) = scale(j) * Scalar(random.uniform(-1, 1));
    const Scalar dt = Scalar(tick % 17 == 0 ? random.uniform(1e-5, 0.1) : 0.001);
    (void)rls.update(dt, phi, Rls::Vector::Constant(Scalar(random.uniform(-10, 10))));
    const auto [U, D] = rls.factors(0);
    definite = definite && (D.array() > Scalar(0)).all() && limpid::is_finite(U) && limpid::is_finite(D);
    inside = inside && (rls.theta() >= lower).all() && (rls.theta() <= upper).all();
    if (tick % 256 == 0) largest = maximum(largest, limpid::symmetric_eigenvalues<N, Scalar>(rls.gain(0)).maxCoeff());
  }
  CHECK(definite);
  CHECK(inside);
  // rho_M, to the roundings of log, exp and the eigenvalue
  CHECK(largest <= Scalar(5e9) * (1 + 100 * std::numeric_limits<Scalar>::epsilon()));
}

}  // namespace

// U D U' with a unit triangle is definite exactly where D > 0.
TEST_CASE_TEMPLATE("over a million random ticks Gamma stays definite and below its limit, the estimate in its box",
                   Scalar, float, double) {
  ramble<2, Scalar>();
  ramble<3, Scalar>();
}
