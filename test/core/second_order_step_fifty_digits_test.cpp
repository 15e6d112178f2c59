// SPDX-License-Identifier: MIT
#include <limpid/core/second_order_step.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using limpid::SecondOrderStep;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

template <typename Scalar>
using One = Eigen::Array<Scalar, 1, 1>;

struct Motion {
  Fifty x, v;
};

// x'' + beta x' + kappa x = f0 + slope t by roots and particular solution; beta^2 > 4 kappa > 0.
Motion closed_form(const Fifty& kappa, const Fifty& beta, const Fifty& h, const Motion& start, const Fifty& f0,
                   const Fifty& slope) {
  const Fifty root = sqrt(beta * beta / 4 - kappa), fast = -beta / 2 - root, slow = -beta / 2 + root;
  const Fifty rate = slope / kappa, rest = f0 / kappa - beta * slope / (kappa * kappa);
  const Fifty x0 = start.x - rest, v0 = start.v - rate;
  const Fifty a = (v0 - fast * x0) / (slow - fast), b = x0 - a;
  return {rest + rate * h + a * exp(slow * h) + b * exp(fast * h),
          rate + a * slow * exp(slow * h) + b * fast * exp(fast * h)};
}

template <typename Scalar>
Fifty worst_error(int cases) {
  std::mt19937 random(50);
  std::uniform_real_distribution<double> uniform(0, 1);
  Fifty worst = 0;
  for (int i = 0; i < cases; ++i) {
    const auto beta = Scalar(std::pow(10.0, 4 * uniform(random))), h = Scalar(std::pow(10.0, -4 + 3 * uniform(random)));
    const Scalar kappa = beta * beta * Scalar(0.2 * uniform(random) + 0.01);
    SecondOrderStep<1, Scalar> step;
    step.set(One<Scalar>(kappa), One<Scalar>(beta), h);
    One<Scalar> x(Scalar(1)), v(beta * Scalar(uniform(random) - 0.5));
    const One<Scalar> f0(kappa * Scalar(uniform(random))), f1(kappa * Scalar(uniform(random)));
    const Fifty slope = (Fifty(f1[0]) - Fifty(f0[0])) / Fifty(h);
    const Motion exact =
        closed_form(Fifty(kappa), Fifty(beta), Fifty(h), {Fifty(x[0]), Fifty(v[0])}, Fifty(f0[0]), slope);
    step.advance(x, v, f0, f1);
    const Fifty error_x = abs(Fifty(x[0]) - exact.x), error_v = abs(Fifty(v[0]) - exact.v) / Fifty(beta);
    worst = maximum(worst, error_x, error_v);
  }
  return worst;
}

}  // namespace

// Sizes are about one (x) and beta (v). A doubling rounds a few times and there are up to log2(2000) of them.
TEST_CASE("a step is the closed form to its roundings") {
  CHECK(worst_error<float>(300) < 60 * Fifty(std::numeric_limits<float>::epsilon()));
  CHECK(worst_error<double>(300) < 60 * Fifty(std::numeric_limits<double>::epsilon()));
  CHECK(worst_error<Fifty>(60) < Fifty("1e-46"));
}
