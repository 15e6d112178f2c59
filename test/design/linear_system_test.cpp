// SPDX-License-Identifier: MIT
#include "norm_instances.hpp"

#include <limpid/design/discretise.hpp>
#include <limpid/design/frequency_response.hpp>
#include <limpid/design/h2_norm.hpp>
#include <limpid/design/hinf_norm.hpp>
#include <limpid/design/lyapunov.hpp>
#include <limpid/design/state_space.hpp>
#include <limpid/design/transfer_function.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <initializer_list>
#include <random>
#include <stdexcept>

using namespace limpid;

namespace {

using Complex = std::complex<double>;
using System = StateSpace<double>;
using limpid::test::maximum;

Eigen::VectorXd list(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.data());
  return v;
}

TransferFunction<double> quotient(std::initializer_list<double> numerator, std::initializer_list<double> denominator,
                                  double period = 0) {
  return {list(numerator), list(denominator), period};
}

System resonance(double w_n, double zeta) { return state_space(quotient({w_n * w_n}, {1, 2 * zeta * w_n, w_n * w_n})); }

bool close(double actual, double expected, double part) {
  return std::abs(actual - expected) <= part * std::abs(expected);
}

bool close(const Complex& actual, const Complex& expected, double part) {
  return std::abs(actual - expected) <= part * std::abs(expected);
}

Complex response(const System& G, double omega) { return frequency_response(G, omega)(0, 0); }

}  // namespace

TEST_CASE("a state space answers to a sine as its transfer function does") {
  const auto G = quotient({2, 0, 5}, {3, 1, 7});
  for (const double omega : {0.0, 0.3, 1.5, 40.0}) {
    CHECK(close(response(state_space(G), omega), G(Complex(0, omega)), 1e-14));  // a few roundings
  }
  const auto H = quotient({1, -0.5}, {1, -0.9, 0.3}, 0.01);
  for (const double omega : {0.0, 30.0, 300.0}) {
    CHECK(close(response(state_space(H), omega), H(std::polar(1.0, omega * 0.01)), 1e-13));
  }
}

TEST_CASE("series, parallel, a factor and feedback are what they are of complex numbers") {
  const System G = state_space(quotient({1, 3}, {1, 2, 10})), H = state_space(quotient({2, 1}, {1, 5}));
  for (const double omega : {0.2, 3.0, 25.0}) {
    const Complex g = response(G, omega), h = response(H, omega);
    CHECK(close(response(series(G, H), omega), g * h, 1e-13));
    CHECK(close(response(parallel(G, H), omega), g + h, 1e-13));
    CHECK(close(response(scaled(G, -3.0), omega), -3.0 * g, 1e-13));
    CHECK(close(response(feedback(G, H), omega), g / (1.0 + g * h), 1e-13));
    CHECK(close(response(feedback(H, static_gain<double>(Eigen::MatrixXd::Constant(1, 1, 4))), omega),
                h / (1.0 + 4.0 * h), 1e-13));
  }
}

TEST_CASE("with a hold a first-order lag and a double integrator step exactly") {
  const double a = 3, T = 0.2;
  const System lag = discretise(state_space(quotient({1}, {1, a})), T, Discretisation::zero_order_hold);
  CHECK(close(lag.A(0, 0), std::exp(-a * T), 1e-15));
  CHECK(close(lag.B(0, 0), -std::expm1(-a * T) / a, 1e-14));
  const System twice = discretise(state_space(quotient({1}, {1, 0, 0})), T, Discretisation::zero_order_hold);
  const Complex z = std::polar(1.0, 0.7);
  CHECK(close(response(twice, 0.7 / T), T * T / 2 * (z + 1.0) / ((z - 1.0) * (z - 1.0)), 1e-13));
}

TEST_CASE("Tustin and backward Euler put their own s into the transfer function") {
  const auto G = quotient({1, 2}, {1, 0.4, 9});
  const double T = 0.05, omega = 11;
  const Complex z = std::polar(1.0, omega * T);
  CHECK(close(response(discretise(state_space(G), T, Discretisation::tustin), omega), G(2 / T * (z - 1.0) / (z + 1.0)),
              1e-13));
  CHECK(close(response(discretise(state_space(G), T, Discretisation::backward_euler), omega), G((z - 1.0) / (T * z)),
              1e-13));
}

TEST_CASE("the energy of a lag, a resonance and a geometric sequence is their closed form") {
  CHECK(close(h2_norm(state_space(quotient({1}, {1, 5}))).squared, 1.0 / 10, 1e-14));
  for (const double w_n : {1e-3, 1.0, 1e4}) {
    for (const double zeta : {0.01, 0.5, 3.0}) {
      CHECK(close(h2_norm(resonance(w_n, zeta)).squared, w_n / (4 * zeta), 1e-12));
    }
  }
  CHECK(close(h2_norm(state_space(quotient({1}, {1, -0.9}, 0.1))).squared, 1 / (1 - 0.81), 1e-13));
  // D adds its own square in discrete time
  CHECK(close(h2_norm(state_space(quotient({2, -0.8}, {1, -0.9}, 0.1))).squared, 4 + 1 / (1 - 0.81), 1e-13));
}

TEST_CASE("the largest gain of a resonance is 1/(2 zeta sqrt(1 - zeta^2)), at its frequency") {
  for (const double w_n : {1e-3, 1.0, 1e4}) {
    for (const double zeta : {1e-4, 0.01, 0.3, 0.7}) {
      const auto norm = hinf_norm(resonance(w_n, zeta));
      CHECK(norm.verdict == NormVerdict::finite);
      CHECK(close(norm.norm, 1 / (2 * zeta * std::sqrt(1 - zeta * zeta)), 1e-11));
      if (zeta < 0.5) CHECK(close(norm.frequency, w_n * std::sqrt(1 - 2 * zeta * zeta), 1e-9));
      CHECK(norm.upper >= norm.norm);
      CHECK(norm.upper <= norm.norm * (1 + 1e-6));
    }
    CHECK(close(hinf_norm(resonance(w_n, 0.9)).norm, 1, 1e-12));  // at rest
  }
}

TEST_CASE("of two peaks, however narrow, the higher is the norm, not the value at rest") {
  std::mt19937 random(71);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 30; ++i) {
    CAPTURE(i);
    const double w1 = std::pow(10, uniform(-1, 1)), w2 = w1 * uniform(3, 300), z1 = std::pow(10, uniform(-5, -1)),
                 z2 = std::pow(10, uniform(-5, -1));
    const System G = parallel(resonance(w1, z1), scaled(resonance(w2, z2), uniform(0.1, 2)));
    const double norm = hinf_norm(G).norm;
    double swept = 0;
    for (const auto& [w, z] : {std::pair{w1, z1}, std::pair{w2, z2}}) {
      for (int k = -400; k <= 400; ++k) swept = maximum(swept, std::abs(response(G, w * (1 + 0.01 * k * z))));
    }
    CHECK(norm >= swept * (1 - 1e-12));
    CHECK(norm <= swept * (1 + 1e-3));  // the sweep is a hundredth of the width apart
  }
}

TEST_CASE("a high-pass has its norm at infinite frequency and a discrete lag at rest") {
  const auto high = hinf_norm(state_space(quotient({3, 0}, {1, 5})));
  CHECK(close(high.norm, 3, 1e-12));
  CHECK(high.frequency == std::numeric_limits<double>::infinity());
  CHECK(close(hinf_norm(state_space(quotient({1}, {1, -0.9}, 0.1))).norm, 10, 1e-12));
  CHECK(close(hinf_norm(state_space(quotient({1}, {1, 0.9}, 0.1))).norm, 10, 1e-12));  // at the Nyquist frequency
}

TEST_CASE("what is not stable or goes straight through has no finite norm, and says which") {
  CHECK(h2_norm(state_space(quotient({1}, {1, -1}))).verdict == NormVerdict::unstable);
  CHECK(h2_norm(state_space(quotient({1}, {1, 0}))).verdict == NormVerdict::unstable);
  CHECK(hinf_norm(state_space(quotient({1}, {1, 0, 4}))).verdict == NormVerdict::unstable);
  CHECK(hinf_norm(state_space(quotient({1}, {1, -1.01}, 0.1))).norm == std::numeric_limits<double>::infinity());
  const auto through = h2_norm(state_space(quotient({1, 0}, {1, 1})));
  CHECK(through.verdict == NormVerdict::unbounded);
  CHECK(through.norm == std::numeric_limits<double>::infinity());
}

TEST_CASE("Lyapunov's equations are solved to their residual") {
  std::mt19937 random(72);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10; ++i) {
    CAPTURE(i);
    const Eigen::Index n = 1 + i % 6;
    Eigen::MatrixXd A(n, n), half(n, n);
    for (Eigen::Index k = 0; k < n * n; ++k) A.data()[k] = normal(random), half.data()[k] = normal(random);
    const Eigen::MatrixXd Q = half * half.transpose(), X = lyapunov<double>(A - 4 * Eigen::MatrixXd::Identity(n, n), Q);
    const Eigen::MatrixXd shifted = A - 4 * Eigen::MatrixXd::Identity(n, n);
    CHECK((shifted * X + X * shifted.transpose() + Q).norm() < 1e-13 * Q.norm());
    const Eigen::MatrixXd small = A / (2 * A.norm()), Y = discrete_lyapunov<double>(small, Q);
    CHECK((small * Y * small.transpose() - Y + Q).norm() < 1e-13 * Q.norm());
  }
}

TEST_CASE("a lag keeps its norms where the squares of its entries leave the scalar's range") {
  const auto lag = [](double a, double b, double c) {
    const auto entry = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
    return System{entry(-a), entry(b), entry(c), entry(0)};
  };
  const auto has = [](const System& G, double largest, double energy) {
    const auto peak = hinf_norm(G);
    const auto root = h2_norm(G);
    CHECK(peak.verdict == NormVerdict::finite);
    CHECK(close(peak.norm, largest, 1e-14));  // a few roundings
    CHECK(peak.upper >= largest);
    CHECK(root.verdict == NormVerdict::finite);
    CHECK(close(root.norm, energy, 1e-14));
  };
  for (const double s : {1e-300, 1e-170, 1e-150, 1e150, 1e170, 1e300}) {
    CAPTURE(s);
    has(lag(s, s, 1), 1, std::sqrt(s / 2));  // s/(p + s)
    has(lag(1, s, 1), s, s / std::sqrt(2.0));
    has(lag(1, 1, s), s, s / std::sqrt(2.0));
    has(lag(1, s, 1 / s), 1, 1 / std::sqrt(2.0));
    CHECK(close(response(lag(s, s, 1), s), 1.0 / Complex(1, 1), 1e-14));
    const auto through = hinf_norm(static_gain<double>(Eigen::MatrixXd::Constant(2, 2, s)));
    CHECK(close(through.norm, 2 * s, 1e-14));
  }
}

TEST_CASE("rates twenty decades apart are not taken for a singular matrix") {
  const auto diagonal = [](double first, double second) {
    return Eigen::MatrixXd(Eigen::Vector2d(first, second).asDiagonal());
  };
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(2, 2);
  const System G{diagonal(-1e20, -1e-3), I, I, 0 * I};
  const System tustin = discretise(G, 1.0, Discretisation::tustin);
  CHECK(close(tustin.A(0, 0), -1, 1e-15));
  CHECK(close(tustin.A(1, 1), (1 - 5e-4) / (1 + 5e-4), 1e-15));
  const System backward = discretise(G, 1.0, Discretisation::backward_euler);
  CHECK(close(backward.A(0, 0), 1e-20, 1e-15));
  CHECK(close(backward.A(1, 1), 1 / 1.001, 1e-15));
  const System loop = feedback(static_gain<double>(diagonal(1e20, 1)), static_gain<double>(I));
  CHECK(close(loop.D(0, 0), 1, 1e-15));
  CHECK(close(loop.D(1, 1), 0.5, 1e-15));
}

TEST_CASE("systems that cannot be are refused by name") {
  const auto refused = [](const auto& act, const char* text) {
    CHECK_THROWS_WITH_AS(act(), doctest::Contains(text), std::invalid_argument);
  };
  System G = state_space(quotient({1}, {1, 5}));
  refused([] { (void)state_space(quotient({1, 2, 3}, {1, 2})); }, "TransferFunction: numerator");
  refused([] { (void)state_space(quotient({1}, {0, 2})); }, "TransferFunction: denominator");
  refused([&] { (void)discretise(G, 0.0, Discretisation::tustin); }, "discretise: period");
  refused([&] { (void)discretise(discretise(G, 1.0, Discretisation::tustin), 1.0, Discretisation::tustin); },
          "discretise: G");
  refused([&] { (void)series(G, state_space(quotient({1}, {1, 0.5}, 0.1))); }, "StateSpace: period");
  refused([&] { (void)frequency_response(G, std::nan("")); }, "frequency_response: omega");
  refused([] { (void)first_order_weight(-1.0); }, "first_order_weight: corner");
  refused(
      [] {
        (void)feedback(static_gain<double>(Eigen::MatrixXd::Constant(1, 1, -1)),
                       static_gain<double>(Eigen::MatrixXd::Constant(1, 1, 1)));
      },
      "feedback: I + D_H D_G");
  const Eigen::MatrixXd many = -Eigen::MatrixXd::Identity(101, 101);
  refused([&] { (void)lyapunov<double>(many, many); }, "lyapunov: A: expected at most 100 states, got 101");
  G.B(0, 0) = std::nan("");
  refused([&] { (void)h2_norm(G); }, "StateSpace: B");
  G.B = Eigen::MatrixXd::Zero(2, 1);
  refused([&] { (void)hinf_norm(G); }, "StateSpace: B");
}
