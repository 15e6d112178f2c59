// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/q_filter.hpp>
#include <support/no_allocation.hpp>

#include <Eigen/Dense>

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

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

/// The laws of QFilterTraits, for any type.
template <QFilter Q>
void check_q_filter(const Q& q) {
  using Traits = QFilterTraits<Q>;
  constexpr int n = Traits::order;
  CHECK_NOTHROW(detail::check_q_filter(q, "test"));
  CHECK(Traits::time_constant(q) > 0);

  CHECK(q_at(q, 0) == 1.0);
  // Far out Q falls as sigma to the relative degree: by 10 to that power from 1e6 to 1e7, but for 1e-5 or so.
  const double fall = std::abs(q_at(q, 1e6)) / std::abs(q_at(q, 1e7));
  CHECK(fall == doctest::Approx(std::pow(10, Traits::relative_degree)).epsilon(1e-4));

  // Poles: the roots of D by its companion matrix.
  const auto D = Traits::denominator(q);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);  // dynamic: one solver for the compiler
  for (int i = 0; i < n; ++i) {
    if (i > 0) companion(i, i - 1) = 1;
    companion(i, n - 1) = -static_cast<double>(D[static_cast<std::size_t>(i)] / D.back());
  }
  const Eigen::VectorXcd poles = companion.eigenvalues();
  for (int i = 0; i < n; ++i) CHECK(poles[i].real() < 0);

  // The algebraic loop of any dt: Q(2 tau/h) < 1.
  for (double sigma = 1e-3; sigma < 1e3; sigma *= 1.1) REQUIRE(q_at(q, sigma).real() < 1);

  typename Traits::Scalar kept{0};
  check_no_allocation([&] { kept = Traits::time_constant(q) + Traits::numerator(q)[0] + Traits::denominator(q)[0]; });
  CHECK(kept > 0);
}

}  // namespace limpid::test
