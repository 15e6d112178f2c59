// SPDX-License-Identifier: MIT
// Stiffness and damping of a tissue, found while it is pressed; and a monitor that says whether they can be.
#include <limpid/estimation/excitation.hpp>
#include <limpid/estimation/projection_rls.hpp>

#include <cmath>
#include <cstdio>

int main() {
  limpid::ProjectionRLS<2> estimator(
      {.lower = {200, 20}, .upper = {2000, 40}, .initial = {1100, 30}, .initial_gain = {1e9, 8e6}, .forgetting = 2});
  limpid::ExcitationMonitor<2> monitor({.window = 0.5, .least = 1e-9});
  const double k = 1500, b = 35, dt = 0.001;
  bool excited = false;
  for (int tick = 0; tick <= 1000; ++tick) {
    const double x = 0.002 * std::sin(0.01 * tick), v = 0.02 * std::cos(0.01 * tick);
    (void)estimator.update(dt, {x, v}, limpid::ProjectionRLS<2>::Vector(k * x + b * v));
    excited = monitor.update(dt, {x, v}).excited.all();
    if (tick % 250 != 0) continue;
    const auto theta = estimator.theta();
    std::printf("%4d ms: k %.1f N/m, b %.2f N s/m, %s\n", tick, theta(0, 0), theta(0, 1),
                excited ? "excited" : "not excited yet");
  }
  const auto theta = estimator.theta();
  return excited && std::abs(theta(0, 0) - k) < 0.01 * k && std::abs(theta(0, 1) - b) < 0.01 * b ? 0 : 1;
}
