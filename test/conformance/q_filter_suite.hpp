// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/q_filter.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace limpid::test {

/// Q at s = sigma/tau.
template <QFilter Q>
[[nodiscard]] std::complex<double> q_at(const Q& q, const std::complex<double>& sigma) {
  const auto polynomial = [&](const auto& coefficients) {
    std::complex<double> value = 0;
    for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * sigma + static_cast<double>(*c);
    return value;
  };
  return polynomial(QFilterTraits<Q>::numerator(q)) / polynomial(QFilterTraits<Q>::denominator(q));
}

/// Roots of a polynomial, the constant first, by the simultaneous iteration of Durand and Kerner.
template <typename Scalar, std::size_t size>
[[nodiscard]] std::array<std::complex<double>, size - 1> roots_of(const std::array<Scalar, size>& coefficients) {
  std::array<std::complex<double>, size - 1> roots;
  for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = std::pow(std::complex(0.4, 0.9), static_cast<double>(i));
  for (int step = 0; step < 1000; ++step) {
    for (auto& root : roots) {
      std::complex<double> value = 0, others = 1;
      for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c)
        value = value * root + static_cast<double>(*c);
      for (const auto& other : roots) others *= &other == &root ? 1.0 : root - other;
      if (value != 0.0) root -= value / (static_cast<double>(coefficients.back()) * others);
    }
  }
  for (const auto& root : roots) {  // they are roots, to the square root of rounding and better
    std::complex<double> value = 0;
    double size_of_terms = 0;
    for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) {
      value = value * root + static_cast<double>(*c);
      size_of_terms = size_of_terms * std::abs(root) + std::abs(static_cast<double>(*c));
    }
    CHECK(std::abs(value) <= 1e-8 * size_of_terms);
  }
  return roots;
}

/// The laws of QFilterTraits, for any type.
template <QFilter Q>
void check_q_filter(const Q& q) {
  using Traits = QFilterTraits<Q>;
  CHECK_NOTHROW(detail::check_q_filter(q, "test"));
  CHECK(Traits::time_constant(q) > 0);

  CHECK(q_at(q, 0) == 1.0);
  // Far out Q falls as sigma to the relative degree: by 10 to that power from 1e6 to 1e7, but for 1e-5 or so.
  const double fall = std::abs(q_at(q, 1e6)) / std::abs(q_at(q, 1e7));
  CHECK(fall == doctest::Approx(std::pow(10, Traits::relative_degree)).epsilon(1e-4));

  for (const std::complex<double>& pole : roots_of(Traits::denominator(q))) CHECK(pole.real() < 0);

  // The algebraic loop of any dt: Q(2 tau/h) < 1.
  for (double sigma = 1e-3; sigma < 1e3; sigma *= 1.1) REQUIRE(q_at(q, sigma).real() < 1);

  typename Traits::Scalar kept{0};
  check_no_allocation([&] { kept = Traits::time_constant(q) + Traits::numerator(q)[0] + Traits::denominator(q)[0]; });
  CHECK(kept > 0);
}

}  // namespace limpid::test
