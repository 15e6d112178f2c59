// SPDX-License-Identifier: MIT
// expect: the Q of a disturbance observer needs a relative degree of at least 1: Q/P_n is improper with less
#include <limpid/control/disturbance_observer.hpp>

struct LeadLag {
  using Scalar = double;
  static constexpr int order = 1, relative_degree = 0;

  double time_constant() const { return 0.01; }
  std::array<double, 2> numerator() const { return {1, 0.5}; }
  std::array<double, 2> denominator() const { return {1, 1}; }
};

int main() {
  using Observer = limpid::DisturbanceObserver<LeadLag>;
  const Observer observer({.filter = {}, .mass = Observer::Vector(0.01), .damping = Observer::Vector(0.022)});
  (void)observer;
}
