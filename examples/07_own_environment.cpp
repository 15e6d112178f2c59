// SPDX-License-Identifier: MIT
// An environment of one's own: a spring that hardens, with its two parameters found on line.
#include <limpid/environment/environment.hpp>
#include <limpid/estimation/projection_rls.hpp>

#include <cmath>
#include <cstdio>

// F = k1 x + k3 x^3
struct HardeningSpring {
  using Scalar = double;
  static constexpr int axes = 1, parameters = 2;
  static constexpr bool linear = false;
  using Vector = Eigen::Array<double, 1, 1>;
  using Theta = Eigen::Array<double, 1, 2>;

  [[nodiscard]] Theta regressor(const Vector& x, const Vector&) const noexcept { return {x[0], x[0] * x[0] * x[0]}; }
  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return Vector((regressor(x, v) * theta).sum());
  }
  [[nodiscard]] limpid::Tangents<1> tangent(const Theta& theta, const Vector& x, const Vector&) const noexcept {
    return {.stiffness = Vector(theta(0, 0) + 3 * theta(0, 1) * x[0] * x[0])};
  }
};
static_assert(limpid::Environment<HardeningSpring>);

int main() {
  const HardeningSpring spring;
  const HardeningSpring::Theta truth(500, 4e7);
  limpid::ProjectionRLS<2> estimator(
      {.lower = {0, 0}, .upper = {2000, 1e8}, .initial = {1000, 0}, .initial_gain = {1e9, 1e18}, .gain_limit = 1e19});
  for (int tick = 0; tick < 3000; ++tick) {
    const HardeningSpring::Vector x(0.002 * (1 - std::cos(0.006 * tick))), v(0);
    (void)estimator.update(0.001, spring.regressor(x, v), spring.force(truth, x, v));
  }
  std::printf("k1 %.2f N/m, k3 %.4g N/m^3\n", estimator.theta()(0, 0), estimator.theta()(0, 1));
  return std::abs(estimator.theta()(0, 0) - 500) < 5 && std::abs(estimator.theta()(0, 1) - 4e7) < 4e5 ? 0 : 1;
}
