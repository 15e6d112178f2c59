// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"

#include <limpid/design/sampled_stability.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::Gain;
using limpid::sampled_radius;
using limpid::SampledStability;
using limpid::SampledSystem;
using limpid::Tissue;
using limpid::Tool;
using limpid::test::Fifty;
using limpid::test::tool;

namespace {

template <typename Scalar>
Tool<1, Scalar> tool_in() {
  return {static_cast<Scalar>(tool.mass), static_cast<Scalar>(tool.damping), static_cast<Scalar>(tool.stiffness)};
}

}  // namespace

TEST_CASE_TEMPLATE("Theorem 3's counterexample: certified, and yet the sampled error grows", Scalar, double,
                   long double, Fifty) {
  const Scalar T = Scalar(1) / Scalar(60);
  const Gain<Scalar> L(Scalar(-7532) / 10, Scalar(-1701) / 100);
  const double printed[] = {1.017, 1.013, 1.008, 1.002};
  for (int i = 0; i < 4; ++i) {
    const Tissue<Scalar> tissue{Scalar(400 + 100 * i), Scalar(20)};
    const SampledSystem<Scalar> system{tool_in<Scalar>(), T, T};
    CHECK(std::abs(static_cast<double>(sampled_radius(system, tissue, L)) - printed[i]) < 5e-4);
    CHECK_FALSE(SampledStability<Scalar>(system).stable(tissue, L));
  }
}

TEST_CASE_TEMPLATE("coefficients and radius agree with 50 digits, under, over and critically damped", Scalar, float,
                   double, long double) {
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const Gain<Scalar> L(Scalar(-200), Scalar(-1.5));
  for (const Scalar& T : {Scalar(0.001), Scalar(0.016), Scalar(0.1)}) {
    for (int b = 1; b <= 40; b += 3) {
      for (const int over : {0, 1, 2, 3}) {
        // b_e + b_t = 2 sqrt(m k) is critical; then near it, and far.
        const Scalar m = Scalar(0.1), total = Scalar(b), critical = total * total / (Scalar(4) * m);
        const Scalar k = critical * (Scalar(1) + (over == 0   ? Scalar(0)
                                                  : over == 1 ? Scalar(1e-6)
                                                  : over == 2 ? Scalar(-1e-6)
                                                              : Scalar(2)));
        const SampledSystem<Scalar> system{{m, Scalar(0), Scalar(0)}, T, T};
        const SampledSystem<Fifty> exact{{Fifty(m), Fifty(0), Fifty(0)}, Fifty(T), Fifty(T)};
        const auto p = SampledStability<Scalar>(system).polynomial({k, total}, L);
        const auto P = SampledStability<Fifty>(exact).polynomial({Fifty(k), Fifty(total)}, L.template cast<Fifty>());
        CAPTURE(T);
        CAPTURE(k);
        CAPTURE(total);
        // beta T up to 40 and omega T up to 35 lose that factor in exp and cos; L G is of the size |L| T / m at most.
        const Scalar size = Scalar(80) * (Scalar(1) + Scalar(16) * T * (std::abs(L[0]) * T + std::abs(L[1])) / m);
        for (int i = 0; i < 4; ++i) CHECK(std::abs(static_cast<Scalar>(P[i] - Fifty(p[i]))) < size * eps);
      }
    }
  }
}
