// SPDX-License-Identifier: MIT
#include <limpid/control/disturbance_observer.hpp>
#include <support/disturbance_observer.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace limpid;
using namespace limpid::test;
using namespace std::chrono_literals;
using limpid::test::maximum;

namespace {

// A polynomial in tau s, with s by the rule of a form, in powers of z^-1.
template <std::size_t order>
std::array<double, order> discrete(const auto& p, double k, bool tustin) {
  std::array<double, order> sum{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::array<double, order> term{};
    term[0] = p[i];
    for (std::size_t factor = 0; factor + 1 < order; ++factor) {  // k (1 - 1/z), or what Tustin's rule divides by
      const double now = factor < i ? k : 1, before = factor < i ? -k : (tustin ? 1 : 0);
      for (std::size_t j = order; j-- > 0;) term[j] = now * term[j] + (j > 0 ? before * term[j - 1] : 0);
    }
    for (std::size_t j = 0; j < order; ++j) sum[j] += term[j];
  }
  return sum;
}

}  // namespace

// The observer solves for its force; the filters' difference equations, given that force, must say the same d_hat.
TEST_CASE_TEMPLATE("the force solves the algebraic loop, for random plants and signals", Q, FirstOrderQ<>,
                   ButterworthQ<>, UmenoHoriQ<>) {
  constexpr unsigned seed = 19631207;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  constexpr std::size_t order = Q::order + 1;
  using Observer = DisturbanceObserver<Q>;
  using Vector = typename Observer::Vector;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    const bool tustin = i % 2 == 0;
    const Q q{.cutoff = 5 + 200 * part(random)};
    const double m = 0.001 + part(random), b = part(random), tau = q.time_constant(), k = (tustin ? 2 : 1) * tau / 1e-3;
    Observer observer({.filter = q,
                       .mass = Vector(m),
                       .damping = Vector(b),
                       .form = tustin ? ObserverForm::tustin : ObserverForm::backward_euler});
    std::array<double, order> inverse_N{};  // of N (m s + b)
    for (std::size_t j = 0; j < q.numerator().size(); ++j) {
      inverse_N[j] += b * q.numerator()[j];
      inverse_N[j + 1] += m / tau * q.numerator()[j];
    }
    const auto N = discrete<order>(q.numerator(), k, tustin), P = discrete<order>(inverse_N, k, tustin);
    const auto D = discrete<order>(q.denominator(), k, tustin);
    std::array<double, order> force{}, velocity{}, d_hat{};  // the newest first
    (void)tick(observer, 0ms, Vector(0.0), Vector(0.0), Vector(0.0), Vector(0.0));
    double applied = 0, asked = 0, largest = 1, worst = 0;
    for (int t = 1; t < 200; ++t) {
      force[0] += applied - asked;  // a limiter gave less
      d_hat[0] += N[0] / D[0] * (applied - asked);
      for (auto* past : {&force, &velocity, &d_hat}) std::copy_backward(past->begin(), past->end() - 1, past->end());
      const double hand = part(random) - 0.5, v = 0.1 * (part(random) - 0.5);
      const auto output = tick(observer, t * 1ms, Vector(part(random)), Vector(hand), Vector(v), Vector(applied));
      asked = output.force[0];
      applied = asked * part(random);
      force[0] = asked + hand;
      velocity[0] = v;
      d_hat[0] = N[0] * force[0] - P[0] * v;
      for (std::size_t j = 1; j < order; ++j) {
        d_hat[0] += N[j] * force[j] - P[j] * velocity[j] - D[j] * d_hat[j];
      }
      d_hat[0] /= D[0];
      largest = maximum(largest, std::abs(asked));
      worst = maximum(worst, std::abs(d_hat[0] - output.disturbance[0]));
    }
    // D's roots may lie as near to 1 as 1 - .03, three of them together: its sums cancel to .03^3 and less
    CHECK(worst < 1e-8 * largest);
  }
}

// A hand alone: Q's step response 1 - exp(-t/tau), which the held force makes exact at any spacing of the ticks.
TEST_CASE("step-invariant, a held force is followed exactly over irregular ticks") {
  constexpr unsigned seed = 18240626;
  CAPTURE(seed);
  auto observer = observer_of<FirstOrderQ<>>(50, ObserverForm::step_invariant);
  using Vector = decltype(observer)::Vector;
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> step(1'000, 3'000'000);
  Time now{};
  (void)tick(observer, now, Vector(0.0), Vector(2.0), Vector(0.0), Vector(0.0));
  for (int k = 0; k < 300; ++k) {
    now += Time(step(random));
    const double exact = -2 * std::expm1(-in_seconds(now) * 100 * std::numbers::pi);
    const auto output = tick(observer, now, Vector(0.0), Vector(2.0), Vector(0.0), Vector(0.0));
    REQUIRE(std::abs(output.disturbance[0] - exact) < 300 * std::numeric_limits<double>::epsilon());
  }
}

// tau y' = t - y: y = t - tau (1 - exp(-t/tau)). Tustin's rule is off by (h/tau)^2/12 of a lag of tau, Euler's by h/2.
TEST_CASE("by Tustin and Euler a ramp is followed to their order over irregular ticks") {
  for (const bool tustin : {true, false}) {
    CAPTURE(tustin);
    auto observer = observer_of<FirstOrderQ<>>(50, tustin ? ObserverForm::tustin : ObserverForm::backward_euler);
    using Vector = decltype(observer)::Vector;
    const double tau = 1 / (100 * std::numbers::pi), h = 2e-4;
    std::mt19937 random(17070415);
    std::uniform_int_distribution<int> step(50'000, 200'000);
    Time now{};
    double worst = 0;
    (void)tick(observer, now, Vector(0.0), Vector(0.0), Vector(0.0), Vector(0.0));
    for (int k = 0; k < 300; ++k) {
      now += Time(step(random));
      const double t = in_seconds(now), exact = t + tau * std::expm1(-t / tau);
      // a command that keeps the device's force at 0 but for the error, which the loop raises by 1/(1 - q_0)
      const auto output = tick(observer, now, Vector(-exact), Vector(t), Vector(0.0), Vector(0.0));
      worst = maximum(worst, std::abs(output.disturbance[0] - exact));
    }
    CHECK(worst < (1 + h / tau) * (tustin ? tau * (h / tau) * (h / tau) / 12 : h / 2));
  }
}

TEST_CASE("in double it is itself in 50 digits to some roundings") {
  using test::Fifty;
  for (const auto form : observer_forms) {
    CAPTURE(static_cast<int>(form));
    auto rounded = observer_of<UmenoHoriQ<>>(50, form);
    auto exact = DisturbanceObserver<UmenoHoriQ<Fifty>>({.filter = {.cutoff = Fifty(50)},
                                                         .mass = Eigen::Array<Fifty, 1, 1>(Fifty(0.01)),
                                                         .damping = Eigen::Array<Fifty, 1, 1>(Fifty(0.022)),
                                                         .form = form});
    using One = Eigen::Array<double, 1, 1>;
    using OneFifty = Eigen::Array<Fifty, 1, 1>;
    std::mt19937 random(16421225);
    std::uniform_real_distribution<double> part(-1, 1);
    double worst = 0;
    Time now{};
    for (int k = 0; k < 300; ++k) {
      now += k < 200 ? Time(1ms) : Time(700us + k % 3 * 300us);
      const double command = part(random), hand = part(random), v = 0.1 * part(random), applied = part(random);
      const auto d = tick(rounded, now, One(command), One(hand), One(v), One(applied)).disturbance[0];
      const auto reference = tick(exact, now, OneFifty(Fifty(command)), OneFifty(Fifty(hand)), OneFifty(Fifty(v)),
                                  OneFifty(Fifty(applied)));
      worst = maximum(worst, std::abs(static_cast<double>(Fifty(d - reference.disturbance[0]))));
    }
    // forces to 2 N, rounded some 12 times a tick and remembered for 1/(1 - exp(-h/tau)) = 4 ticks, thrice in a row
    CHECK(worst < 12 * 4 * 3 * 2 * std::numeric_limits<double>::epsilon());
  }
}
