// SPDX-License-Identifier: MIT
#include <limpid/environment/operator_hand.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

using namespace limpid;
using namespace std::chrono_literals;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <typename Scalar>
using One = Eigen::Array<Scalar, 1, 1>;

struct Hand {
  double M, B, K;
};

constexpr Hand hands[] = {{0.02, 0.5, 50}, {0.02, 20, 1000}, {0.3, 5, 300}, {1, 0.5, 1000}, {1, 20, 50}, {0.3, 0, 0}};

template <typename Scalar = double>
OperatorHand<1, Scalar> make(const Hand& hand) {
  return OperatorHand<1, Scalar>({.mass = One<Scalar>(Scalar(hand.M)),
                                  .damping = One<Scalar>(Scalar(hand.B)),
                                  .stiffness = One<Scalar>(Scalar(hand.K))});
}

// A tick as given: intention and tip at its ends.
struct Given {
  double h, F0, F1, x0, v0, x1, v1;
};

// Bound of the error of the energies over a tick: 5.6e-10 h^9 |g^(8)| for each power g of work, dissipation, delivery.
// From its second derivative on the stretch e has no forcing, so that sqrt(kappa e_n^2 + e_(n+1)^2) never rises.
double quadrature_bound(const Hand& hand, const Given& t, double e, double edot) {
  const double kappa = hand.K / hand.M, beta = hand.B / hand.M, h = t.h;
  const double mean = (t.x1 - t.x0) / h, a0 = (6 * mean - 4 * t.v0 - 2 * t.v1) / h;
  const double jerk = (6 * (t.v0 + t.v1) - 12 * mean) / (h * h), a1 = std::abs(a0) + std::abs(jerk) * h;
  const double slope = (t.F1 - t.F0) / (h * hand.M) - jerk;
  std::array<double, 12> at{e, edot, t.F0 / hand.M - a0 - beta * edot - kappa * e}, most{};
  at[3] = slope - beta * at[2] - kappa * at[1];
  for (std::size_t n = 4; n < at.size(); ++n) at[n] = -beta * at[n - 1] - kappa * at[n - 2];
  for (std::size_t n = 3; n < at.size(); ++n) most[n] = std::hypot(std::sqrt(kappa) * at[n - 1], at[n]);
  // below, by Taylor from the start, with the third derivative bounded
  most[2] = std::abs(at[2]) + h * most[3];
  most[1] = std::abs(at[1]) + h * most[2];
  most[0] = std::abs(at[0]) + h * most[1];
  const double F = std::max(std::abs(t.F0), std::abs(t.F1)), rise = std::abs(t.F1 - t.F0) / h;
  const double v = std::abs(t.v0) + h * a1;
  constexpr double binomial[] = {1, 8, 28, 56, 70, 56, 28, 8, 1};
  double dissipated = 0;
  for (std::size_t j = 0; j <= 8; ++j) dissipated += hand.B * binomial[j] * most[j + 1] * most[9 - j];
  const auto force = [&](std::size_t n) { return hand.K * most[n] + hand.B * most[n + 1]; };
  const double delivered = v * force(8) + 8 * a1 * force(7) + 28 * std::abs(jerk) * force(6);
  const double work = F * most[9] + 8 * rise * most[8];
  return 331776.0 / (9 * std::pow(40320.0, 3)) * std::pow(h, 9) * (work + dissipated + delivered);
}

// A few roundings of what is added up over a tick. The hand's velocity is the tip's and the grip's, which may cancel.
double rounding_bound(const Hand& hand, const Given& t, double e, double edot) {
  const double v = std::abs(t.v0) + std::abs(t.v1) + std::abs(edot);
  const double F = std::abs(t.F0) + std::abs(t.F1) + hand.K * std::abs(e) + hand.B * std::abs(edot);
  return 64 * std::numeric_limits<double>::epsilon() * (F * v * t.h + hand.M * v * v + hand.K * e * e);
}

// Moves at random on cubics; reports every tick.
template <typename Visit>
void wander(const Hand& parameters, unsigned seed, Duration longest, Visit&& visit) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<Duration::rep> length(100'000, longest.count());
  OperatorHand<1> hand = make(parameters);
  double x = 0.1, v = 0, F = 0;
  Time now{};
  (void)hand.advance(now, One<double>(F), One<double>(x), One<double>(v));
  for (int k = 0; k < 2000; ++k) {
    const Duration step{length(random)};
    const double h = in_seconds(step), v1 = 0.98 * v + 0.02 * normal(random), x1 = 0.999 * x + h * (v + v1) / 2;
    const double F1 = 0.95 * F + normal(random), e = hand.position()[0] - x, edot = hand.velocity()[0] - v;
    now += step;
    const auto out = hand.advance(now, One<double>(F1), One<double>(x1), One<double>(v1));
    REQUIRE(out.status == Status::ok);
    visit(hand, Given{h, F, F1, x, v, x1, v1}, e, edot, out.force[0]);
    x = x1, v = v1, F = F1;
  }
}

}  // namespace

TEST_CASE("at rest the hand gives what it intends, whatever hand it is") {
  for (const Hand& parameters : hands) {
    if (parameters.K == 0) continue;
    OperatorHand<1> hand = make(parameters);
    double force = 0;
    for (int k = 0; k < 400; ++k) {
      force = hand.advance(k * 100ms, One<double>(-5.0), One<double>(0.2), One<double>(0.0)).force[0];
    }
    // the slowest of them decays by exp(-B t/(2 M)) = exp(-10) over 40 s
    CHECK(std::abs(force + 5) < 5 * 5 * std::exp(-10.0));
  }
}

TEST_CASE("pressed against a tip that stands, the hand follows the closed form of its damped swing") {
  const Hand parameters{0.3, 5, 300};
  OperatorHand<1> hand = make(parameters);
  (void)hand.advance(0s, One<double>(2.0), One<double>(0.0), One<double>(0.0));
  const double decay = parameters.B / (2 * parameters.M);
  const double omega = std::sqrt(parameters.K / parameters.M - decay * decay);
  for (int k = 1; k < 300; ++k) {
    const double t = k * 3e-3, phase = omega * t;
    const double swing = std::exp(-decay * t);
    const double e = 2 / parameters.K * (1 - swing * (std::cos(phase) + decay / omega * std::sin(phase)));
    const double edot = 2 / (parameters.M * omega) * swing * std::sin(phase);
    const double force = hand.advance(k * 3ms, One<double>(2.0), One<double>(0.0), One<double>(0.0)).force[0];
    REQUIRE(std::abs(force - parameters.K * e - parameters.B * edot) < 1e-12);  // 300 steps of a few 1e-16 of 4 N
  }
}

TEST_CASE("a tip on a cubic under a linear intention is one tick or ten: the step is exact") {
  for (const Hand& parameters : hands) {
    OperatorHand<1> whole = make(parameters), parts = make(parameters);
    const auto x = [](double t) { return 0.1 + t * (0.2 + t * (-3 + t * 40)); };
    const auto v = [](double t) { return 0.2 + t * (-6 + t * 120); };
    const auto F = [](double t) { return 1 + 30 * t; };
    One<double> one(0.0), ten(0.0);
    for (int k = 0; k <= 10; ++k) {
      const double t = k * 4e-3;
      ten = parts.advance(k * 4ms, One<double>(F(t)), One<double>(x(t)), One<double>(v(t))).force;
      if (k % 10 == 0) one = whole.advance(k * 4ms, One<double>(F(t)), One<double>(x(t)), One<double>(v(t))).force;
    }
    // accelerations of the tip from its positions: 6 1e-16 0.1/h^2 = 4e-12 m/s^2, on at most 1 kg or B over h/2
    CHECK(std::abs(one[0] - ten[0]) < 1e-10);
    CHECK(whole.position()[0] == doctest::Approx(parts.position()[0]).epsilon(1e-12));
  }
}

TEST_CASE("the energies balance to the bound of their quadrature") {
  for (const Hand& parameters : hands) {
    CAPTURE(parameters.M);
    CAPTURE(parameters.B);
    CAPTURE(parameters.K);
    double residual = 0, allowed = 0;
    wander(parameters, 1738, 2ms, [&](const auto& hand, const Given& tick, double e, double edot, double) {
      const auto& energy = hand.energy();
      const double size =
          energy.kinetic + energy.elastic + energy.dissipated + std::abs(energy.work) + std::abs(energy.delivered);
      allowed += quadrature_bound(parameters, tick, e, edot) * (1 + 1e-6) + 4e-16 * size +
                 rounding_bound(parameters, tick, e, edot);
      residual = energy.residual();
      REQUIRE(std::abs(residual) <= allowed);
    });
    CHECK(allowed < 1e-3);  // the bound says something: joules are exchanged
  }
}

TEST_CASE("no more is delivered than was intended") {
  for (const Hand& parameters : hands) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      CAPTURE(seed);
      double allowed = 0;
      wander(parameters, seed, 2ms, [&](const auto& hand, const Given& tick, double e, double edot, double) {
        const auto& energy = hand.energy();
        const double size = std::abs(energy.work) + energy.dissipated;
        allowed += quadrature_bound(parameters, tick, e, edot) * (1 + 1e-6) + 4e-16 * size +
                   rounding_bound(parameters, tick, e, edot);
        REQUIRE(energy.delivered <= energy.initial + energy.work + allowed);
        REQUIRE(energy.dissipated >= 0);
      });
    }
  }
}

TEST_CASE("rounding in double stays far below a micronewton: the same ticks in 50 digits") {
  for (const Hand& parameters : hands) {
    auto fifty = make<Fifty>(parameters);
    Time now{};
    (void)fifty.advance(now, One<Fifty>(Fifty(0)), One<Fifty>(Fifty(0.1)), One<Fifty>(Fifty(0)));
    double worst = 0;
    int count = 0;
    wander(parameters, 5, 2ms, [&](const auto&, const Given& t, double, double, double force) {
      if (++count > 200) return;
      now += from_seconds(t.h);
      const auto exact = fifty.advance(now, One<Fifty>(Fifty(t.F1)), One<Fifty>(Fifty(t.x1)), One<Fifty>(Fifty(t.v1)));
      worst = maximum(worst, std::abs(force - static_cast<double>(exact.force[0])));
    });
    // a_t from positions: 6 1e-17/h^2 = 6e-9 m/s^2 at 0.1 ms, on at most 1 kg, over 200 ticks that mostly cancel
    CHECK(worst < 1e-7);
  }
}

TEST_CASE("an input that is not finite, or a clock that stands, changes nothing") {
  OperatorHand<1> hand = make({0.3, 5, 300}), undisturbed = hand;
  for (auto* each : {&hand, &undisturbed}) {
    (void)each->advance(0ms, One<double>(1.0), One<double>(0.0), One<double>(0.0));
    (void)each->advance(1ms, One<double>(1.0), One<double>(0.01), One<double>(0.1));
  }
  const One<double> good(0.02);
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    const One<double> wrong(bad);
    CHECK(hand.advance(2ms, wrong, good, good).status == Status::not_finite);
    CHECK(hand.advance(2ms, good, wrong, good).status == Status::not_finite);
    CHECK(hand.advance(2ms, good, good, wrong).status == Status::not_finite);
  }
  CHECK(hand.advance(1ms, good, good, good).status == Status::clock_backwards);
  CHECK(hand.advance(3ms, good, good, good).force[0] == undisturbed.advance(3ms, good, good, good).force[0]);
}

TEST_CASE("three axes are three hands") {
  OperatorHand<3> together({.mass = {0.1, 0.2, 0.3}, .damping = {1, 2, 3}, .stiffness = {100, 200, 300}});
  OperatorHand<1> last = make({0.3, 3, 300});
  for (int k = 0; k < 20; ++k) {
    const double t = k * 1e-3, x = 0.01 * std::sin(30 * t), v = 0.3 * std::cos(30 * t);
    const auto out = together.advance(k * 1ms, {0, 1, 2}, {x, -x, x}, {v, -v, v});
    const auto one = last.advance(k * 1ms, One<double>(2.0), One<double>(x), One<double>(v));
    CHECK(std::abs(out.force[2] - one.force[0]) < 1e-13);
  }
}

TEST_CASE("no call allocates") {
  OperatorHand<3> hand({.mass = {0.1, 0.2, 0.3}, .damping = {1, 2, 3}, .stiffness = {100, 200, 300}});
  test::check_no_allocation([&] {
    for (int k = 0; k < 10; ++k) (void)hand.advance(k * k * 1ms, {0, 1, 2}, {0, 0.01, 0.02}, {0, 0, 0.1});
  });
}

TEST_CASE("a hand without mass or with a grip below zero is refused by name") {
  CHECK_THROWS_WITH_AS((void)make({0, 1, 1}), "OperatorHand: mass: expected finite and > 0, got 0",
                       std::invalid_argument);
  CHECK_THROWS_AS((void)make({1, -1, 1}), std::invalid_argument);
  CHECK_THROWS_AS((void)make({1, 1, infinity}), std::invalid_argument);
  CHECK_THROWS_AS(OperatorHand<2>(OperatorHand<2>::Settings{}), std::invalid_argument);
}
