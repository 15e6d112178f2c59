// SPDX-License-Identifier: MIT
#include <conformance/q_filter_suite.hpp>
#include <limpid/control/q_filter.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

using namespace limpid;

namespace {

// A user's filter, of Bessel's kind: Q(s) = 3/((tau s)^2 + 3 tau s + 3).
struct BesselQ {
  using Scalar = double;
  static constexpr int order = 2, relative_degree = 2;
  double tau = 0.003;
  double time_constant() const { return tau; }
  std::array<double, 1> numerator() const { return {3}; }
  std::array<double, 3> denominator() const { return {3, 3, 1}; }
};

// A foreign type, adapted.
struct Foreign {
  float corner;
};

struct MissingDegree {
  using Scalar = double;
  static constexpr int order = 1;
  double time_constant() const { return 1; }
  std::array<double, 1> numerator() const { return {1}; }
  std::array<double, 2> denominator() const { return {1, 1}; }
};

struct WrongSize : BesselQ {
  std::array<double, 2> denominator() const { return {1, 1}; }
};

struct Coefficients {
  using Scalar = double;
  static constexpr int order = 3, relative_degree = 2;
  double tau;
  std::array<double, 2> N;
  std::array<double, 4> D;
  double time_constant() const { return tau; }
  std::array<double, 2> numerator() const { return N; }
  std::array<double, 4> denominator() const { return D; }
};

}  // namespace

template <>
struct limpid::QFilterTraits<Foreign> {
  using Scalar = float;
  static constexpr int order = 1, relative_degree = 1;
  static float time_constant(const Foreign& q) { return 1 / q.corner; }
  static std::array<float, 1> numerator(const Foreign&) { return {1}; }
  static std::array<float, 2> denominator(const Foreign&) { return {1, 1}; }
};

static_assert(QFilter<FirstOrderQ<>> && QFilter<ButterworthQ<float>> && QFilter<UmenoHoriQ<long double>>);
static_assert(QFilter<BesselQ> && QFilter<Foreign>);
static_assert(!QFilter<MissingDegree> && !QFilter<WrongSize> && !QFilter<double>);

TEST_CASE("the models and a user's filter keep the laws") {
  test::check_q_filter(FirstOrderQ<>{.cutoff = 50});
  test::check_q_filter(ButterworthQ<float>{.cutoff = 50});
  test::check_q_filter(UmenoHoriQ<long double>{.cutoff = 50});
  test::check_q_filter(BesselQ{});
  test::check_q_filter(Foreign{300});
}

TEST_CASE("at the cut-off first order and Butterworth have the gain 1/sqrt(2), Q31 sqrt(10/8)") {
  const std::complex<double> j{0, 1};
  CHECK(std::abs(test::q_at(FirstOrderQ<>{.cutoff = 50}, j)) == doctest::Approx(std::sqrt(0.5)).epsilon(1e-14));
  CHECK(std::abs(test::q_at(ButterworthQ<>{.cutoff = 50}, j)) == doctest::Approx(std::sqrt(0.5)).epsilon(1e-14));
  CHECK(std::abs(test::q_at(UmenoHoriQ<>{.cutoff = 50}, j)) == doctest::Approx(std::sqrt(1.25)).epsilon(1e-14));
  CHECK(FirstOrderQ<>{.cutoff = 50}.time_constant() == doctest::Approx(1 / (100 * std::acos(-1))).epsilon(1e-15));
}

TEST_CASE("1 - Q of Umeno and Hori vanishes with the square of s") {
  const auto missing = [](double s) { return std::abs(1.0 - test::q_at(UmenoHoriQ<>{.cutoff = 50}, s)); };
  // 1 - Q = s^2 (s + 3)/(s + 1)^3
  CHECK(missing(1e-3) == doctest::Approx(1e-6 * 3.001 / std::pow(1.001, 3)).epsilon(1e-9));
}

TEST_CASE("a filter that breaks a law is refused with what it breaks") {
  const auto check = [](const Coefficients& q) { detail::check_q_filter(q, "Observer"); };
  CHECK_NOTHROW(check({0.01, {1, 3}, {1, 3, 3, 1}}));
  CHECK_THROWS_WITH_AS(check({0, {1, 3}, {1, 3, 3, 1}}),
                       "Observer: filter: expected a time constant, finite and > 0 s, got 0", std::invalid_argument);
  CHECK_THROWS_AS(check({0.01, {1, std::nan("")}, {1, 3, 3, 1}}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(check({0.01, {2, 3}, {1, 3, 3, 1}}), "Observer: filter: expected Q(0) = 1, got 2",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      check({0.01, {1, 0}, {1, 3, 3, 1}}),
      "Observer: filter: expected the relative degree that it tells, a leading coefficient != 0 of N, got 0",
      std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      check({0.01, {1, 4}, {1, 3, 3, 1}}),
      "Observer: filter: expected coefficients of the numerator no larger than the denominator's, got 4",
      std::invalid_argument);
  for (const auto& unstable : {std::array<double, 4>{1, 1, 1, 2}, {1, 1, 1, 1}, {1, 3, 3, 0}, {1, 3, -3, 1}}) {
    CHECK_THROWS_AS(check({0.01, {1, 1}, unstable}), std::invalid_argument);  // roots on the axis or to the right
  }
}
