// SPDX-License-Identifier: MIT
#include <limpid/design/ball.hpp>
#include <limpid/design/mean_value_form.hpp>
#include <limpid/design/second_order_enclosure.hpp>
#include <limpid/design/second_order_flow.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using limpid::Ball;
using limpid::MeanValueForm;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

/// Whether the ball holds a number known to 50 digits: its bounds are exact there.
template <typename Scalar>
bool holds(const Ball<Scalar>& ball, const Fifty& exact) {
  return Fifty(ball.lower()) <= exact && exact <= Fifty(ball.upper());
}

}  // namespace

TEST_CASE_TEMPLATE("a mean value form holds the function over its cell, with an excess that falls as the width squared",
                   Scalar, double, long double) {
  using Form = MeanValueForm<Scalar>;
  const auto f = [](const auto& x, const auto& y) { return exp(x * y - y) * (x - y * y) / (x * x + y); };
  const auto excess = [&](Scalar width) {
    const Form x = Form::first(Scalar(0.7) - width, Scalar(0.7) + width),
               y = Form::second(Scalar(1.2) - width, Scalar(1.2) + width);
    const Ball<Scalar> range = f(x, y).range();
    Fifty least = 1e9, most = -1e9;
    for (int i = -8; i <= 8; ++i) {
      for (int j = -8; j <= 8; ++j) {
        const Fifty value = f(Fifty(Scalar(0.7)) + Fifty(width) * i / 8, Fifty(Scalar(1.2)) + Fifty(width) * j / 8);
        REQUIRE(holds(range, value));
        least = std::min(least, value);
        most = maximum(most, value);
      }
    }
    return static_cast<double>(Fifty(range.upper()) - most + least - Fifty(range.lower()));
  };
  // Four times less for half the width, a little more than that for higher orders.
  CHECK(excess(Scalar(0.01)) / excess(Scalar(0.005)) == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE_TEMPLATE("the flow lies in its enclosure: under, over and critically damped, stiff, soft and unstable",
                   Scalar, double, long double) {
  using Form = MeanValueForm<Scalar>;
  std::mt19937 generator{20'262};
  INFO("seed 20262");
  const auto uniform = [&](double from, double to) {
    return static_cast<Scalar>(std::uniform_real_distribution<double>(from, to)(generator));
  };
  for (int i = 0; i < 400; ++i) {
    const Scalar h = static_cast<Scalar>(std::exp(static_cast<double>(uniform(-7, -1))));
    const Scalar beta = uniform(-5, 400);
    Scalar kappa = i % 5 == 0 ? uniform(-20, 20) : uniform(0, 20'000);
    if (i % 7 == 0) kappa = beta * beta / Scalar{4};
    const Scalar wk = i % 2 == 0 ? Scalar{0} : Scalar(20), wb = i % 2 == 0 ? Scalar{0} : Scalar(0.3);
    const auto flow = limpid::detail::enclose_second_order_flow(Form::first(kappa - wk, kappa + wk),
                                                                Form::second(beta - wb, beta + wb), Ball<Scalar>{h});
    const Fifty part(uniform(-1, 1));
    const Fifty K = Fifty(kappa) + Fifty(wk) * part * Fifty(0.99), B = Fifty(beta) - Fifty(wb) * part * Fifty(0.99);
    const auto exact = limpid::detail::second_order_flow<Fifty>(K, B, Fifty(h));
    CAPTURE(kappa);
    CAPTURE(beta);
    CAPTURE(h);
    REQUIRE(holds(flow.trace.range(), exact.trace));
    REQUIRE(holds(flow.determinant.range(), exact.determinant));
    REQUIRE(holds(flow.phi11.range(), exact.phi11));
    REQUIRE(holds(flow.phi22.range(), exact.phi22));
    REQUIRE(holds(flow.s.range(), exact.s));
    REQUIRE(holds(flow.g.range(), exact.g));
    // Of one point the bounds are as near as rounding and the reduction of the argument allow.
    if (wk == Scalar{0})
      REQUIRE(flow.trace.range().radius() < Scalar(1e-10) * (Scalar{1} + flow.trace.range().magnitude()));
  }
}
