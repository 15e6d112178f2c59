// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace limpid {

/// What adapts a type to the QFilter concept. The primary template forwards to members of the same names; to adapt a
/// foreign type, specialise it with all of
///
///     Scalar, order, relative_degree   the real; degree of D; degree of D less that of N
///     time_constant(q)                 tau, s, > 0; the cut-off is 1/(2 pi tau), in Hz
///     numerator(q), denominator(q)     std::array of the coefficients of N and D in powers of tau s, the constant
///     first
///
/// Laws: Q(s) = N(tau s)/D(tau s) has Q(0) = 1, no pole with a real part >= 0, and the relative degree that it tells.
/// The denominator's coefficients are no smaller than the numerator's, so that Q <= 1 on the positive real axis: a
/// disturbance observer's algebraic loop then has its solution at any spacing of the ticks.
template <typename Q>
struct QFilterTraits {};

/// The members to which QFilterTraits forwards.
template <typename Q>
concept HasQFilterMembers = requires(const Q& q) {
  typename Q::Scalar;
  { Q::order } -> std::convertible_to<int>;
  { Q::relative_degree } -> std::convertible_to<int>;
  q.time_constant();
  q.numerator();
  q.denominator();
};

template <HasQFilterMembers Q>
struct QFilterTraits<Q> {
  using Scalar = typename Q::Scalar;
  static constexpr int order = Q::order;
  static constexpr int relative_degree = Q::relative_degree;

  static Scalar time_constant(const Q& q) noexcept { return q.time_constant(); }
  static auto numerator(const Q& q) noexcept { return q.numerator(); }
  static auto denominator(const Q& q) noexcept { return q.denominator(); }
};

template <typename Q>
using QFilterScalar = typename QFilterTraits<Q>::Scalar;

/// Coefficients of a polynomial, the constant first.
template <Real Scalar, int degree>
using Polynomial = std::array<Scalar, static_cast<std::size_t>(degree) + 1>;

/// A low-pass Q(s) of Fig. 1 of the transparency paper. See QFilterTraits.
template <typename Q>
concept QFilter = std::copyable<Q> && Real<typename QFilterTraits<Q>::Scalar> &&(QFilterTraits<Q>::order >= 1) &&
                  (QFilterTraits<Q>::relative_degree >= 0) &&
                  (QFilterTraits<Q>::relative_degree <= QFilterTraits<Q>::order) && requires(const Q& q) {
  { QFilterTraits<Q>::time_constant(q) } -> std::convertible_to<QFilterScalar<Q>>;
  {
    QFilterTraits<Q>::numerator(q)
    } -> std::convertible_to<Polynomial<QFilterScalar<Q>, QFilterTraits<Q>::order - QFilterTraits<Q>::relative_degree>>;
  { QFilterTraits<Q>::denominator(q) } -> std::convertible_to<Polynomial<QFilterScalar<Q>, QFilterTraits<Q>::order>>;
};

/// tau of a cut-off in Hz: 1/(2 pi cutoff), s.
template <Real Scalar>
[[nodiscard]] Scalar time_constant_of(const Scalar& cutoff) noexcept {
  using std::atan;
  return Scalar{1} / (Scalar{8} * atan(Scalar{1}) * cutoff);
}

/// Q(s) = 1/(tau s + 1)
template <Real Scalar_ = double>
struct FirstOrderQ {
  using Scalar = Scalar_;
  static constexpr int order = 1, relative_degree = 1;

  Scalar cutoff = std::numeric_limits<Scalar>::quiet_NaN();  ///< Hz, > 0

  [[nodiscard]] Scalar time_constant() const noexcept { return time_constant_of(cutoff); }
  [[nodiscard]] Polynomial<Scalar, 0> numerator() const noexcept { return {Scalar{1}}; }
  [[nodiscard]] Polynomial<Scalar, 1> denominator() const noexcept { return {Scalar{1}, Scalar{1}}; }
};

/// Second order, of Butterworth: Q(s) = 1/((tau s)^2 + sqrt(2) tau s + 1)
template <Real Scalar_ = double>
struct ButterworthQ {
  using Scalar = Scalar_;
  static constexpr int order = 2, relative_degree = 2;

  Scalar cutoff = std::numeric_limits<Scalar>::quiet_NaN();  ///< Hz, > 0

  [[nodiscard]] Scalar time_constant() const noexcept { return time_constant_of(cutoff); }
  [[nodiscard]] Polynomial<Scalar, 0> numerator() const noexcept { return {Scalar{1}}; }
  [[nodiscard]] Polynomial<Scalar, 2> denominator() const noexcept {
    using std::sqrt;
    return {Scalar{1}, sqrt(Scalar{2}), Scalar{1}};
  }
};

/// Q31 of Umeno and Hori, reference [5] of the paper: Q(s) = (3 tau s + 1)/(tau s + 1)^3. 1 - Q vanishes as s^2, so
/// that a ramp of the disturbance is followed too.
template <Real Scalar_ = double>
struct UmenoHoriQ {
  using Scalar = Scalar_;
  static constexpr int order = 3, relative_degree = 2;

  Scalar cutoff = std::numeric_limits<Scalar>::quiet_NaN();  ///< Hz, > 0

  [[nodiscard]] Scalar time_constant() const noexcept { return time_constant_of(cutoff); }
  [[nodiscard]] Polynomial<Scalar, 1> numerator() const noexcept { return {Scalar{1}, Scalar{3}}; }
  [[nodiscard]] Polynomial<Scalar, 3> denominator() const noexcept {
    return {Scalar{1}, Scalar{3}, Scalar{3}, Scalar{1}};
  }
};

namespace detail {

/// Whether all coefficients are positive and no root has a real part >= 0: Routh's scheme.
template <Real Scalar, std::size_t size>
[[nodiscard]] bool is_hurwitz(std::array<Scalar, size> p) noexcept {
  // p less p_n/p_(n-1) s (p_(n-1) s^(n-1) + p_(n-3) s^(n-3) + ...) has a degree less and as many roots to the left less
  // one.
  for (std::size_t n = size - 1; n > 0; --n) {
    if (!(p[n] > Scalar{0}) || !(p[n - 1] > Scalar{0})) return false;
    const Scalar ratio = p[n] / p[n - 1];
    for (std::size_t i = 1 + n % 2; i < n; i += 2) p[i - 1] -= i > 1 ? ratio * p[i - 2] : Scalar{0};
  }
  return true;
}

/// The laws of QFilterTraits.
/// @throws std::invalid_argument  "CLASS: filter: ..." where one is broken
template <QFilter Q>
void check_q_filter(const Q& q, std::string_view name) {
  using Scalar = QFilterScalar<Q>;
  using Traits = QFilterTraits<Q>;
  const std::string filter = std::string(name) + ": filter";
  const Scalar tau = Traits::time_constant(q);
  const Polynomial<Scalar, Traits::order> D = Traits::denominator(q);
  const Polynomial<Scalar, Traits::order - Traits::relative_degree> N = Traits::numerator(q);
  expect(is_finite(tau) && tau > Scalar{0}, filter, "a time constant, finite and > 0 s", tau);
  for (const Scalar& d : D) expect(is_finite(d), filter, "finite coefficients of the denominator", d);
  for (const Scalar& c : N) expect(is_finite(c), filter, "finite coefficients of the numerator", c);
  expect(is_hurwitz(D), filter, "a denominator with its roots to the left of the imaginary axis, leading coefficient",
         D.back());
  expect(N.back() != Scalar{0}, filter, "the relative degree that it tells, a leading coefficient != 0 of N", N.back());
  expect(N.front() == D.front(), filter, "Q(0) = 1", Scalar(N.front() / D.front()));
  for (std::size_t i = 0; i < N.size(); ++i) {
    expect(N[i] <= D[i], filter, "coefficients of the numerator no larger than the denominator's", N[i]);
  }
}

}  // namespace detail

}  // namespace limpid
