// SPDX-License-Identifier: MIT
#include <limpid/signal/delayed_sampled.hpp>
#include <limpid/signal/filtered_derivative.hpp>
#include <limpid/signal/history.hpp>
#include <limpid/signal/low_pass.hpp>
#include <limpid/signal/quantiser.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <random>

using limpid::test::Fifty;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;
using OneFifty = Eigen::Array<Fifty, 1, 1>;

// Largest difference of a filter in double from itself in 50 digits on the same random walk over irregular ticks.
template <typename Rounded, typename Exact>
double rounding(Rounded rounded, Exact exact) {
  std::mt19937 random(18540520);
  std::uniform_int_distribution<int> step(500'000, 1'500'000);
  std::uniform_real_distribution<double> change(-1e-3, 1e-3);
  limpid::Time now{};
  double u = 0, worst = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    now += limpid::Duration(step(random));
    u += change(random);
    const double value = rounded.update(now, One(u)).value[0];
    const Fifty true_value = exact.update(now, OneFifty(Fifty(u))).value[0];
    worst = maximum(worst, Fifty(abs(value - true_value)).template convert_to<double>());
  }
  return worst;
}

}  // namespace

TEST_CASE("the filtered derivative in double is the one in 50 digits to the rounding of its differences") {
  const Fifty tau = Fifty(0.0398);  // the same double
  const double worst = rounding(limpid::FilteredDerivative<1>({.time_constant = 0.0398}),
                                limpid::FilteredDerivative<1, Fifty>({.time_constant = tau}));
  // inputs up to .1 differ exactly or to half an ulp of 1e-3; y near 1 is rounded at each tick and remembered for tau/h
  // = 40
  CHECK(worst < 2 * 40 * std::numeric_limits<double>::epsilon());
}

TEST_CASE("the low-pass in double is the one in 50 digits to some roundings") {
  const double worst = rounding(limpid::LowPass<1>({.cutoff = 4}), limpid::LowPass<1, Fifty>({.cutoff = Fifty(4)}));
  // y up to .1 is rounded twice at each tick and remembered for tau/h = 40
  CHECK(worst < 2 * 40 * 0.1 * std::numeric_limits<double>::epsilon());
}

TEST_CASE("a history, a sampler and a quantiser carry 50 digits") {
  const Fifty third = Fifty(1) / 3;
  limpid::History<Fifty> history;
  CHECK(history.push(0ms, Fifty(0)) == limpid::Status::ok);
  CHECK(history.push(3ms, Fifty(1)) == limpid::Status::ok);
  CHECK(abs(history.at(1ms).value - third) < 1e-49);
  limpid::DelayedSampled<OneFifty> sampled({.period = 1ms, .delay = 0ms});
  CHECK(sampled.update(0ms, OneFifty(third)).value[0] == third);
  limpid::Quantiser<1, Fifty> quantiser({.step = OneFifty(third)});
  CHECK(quantiser.update(OneFifty(Fifty(7) / 10)).value[0] == 2 * third);
}
