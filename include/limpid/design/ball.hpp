// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <ostream>

namespace limpid {

/// Every real number within `radius` of `centre`: what an exact result lies in, whatever was rounded on the way.
///
///     x in X, y in Y  =>  x + y in X + Y,  x y in X Y,  ...
///
/// Arithmetic to nearest is assumed, subnormal numbers kept or flushed, products and sums fused or not. Each radius is
/// computed to nearest too and then enlarged by more than it can have lost. A ball that was divided by zero or
/// overflowed is the whole line; so is one of NaN: no question about it is answered with yes.
/// @tparam Scalar  of centre and radius; a ball of it alone is exact: Ball(0.1) is the double, not a tenth
/// @realtime       no allocation, no throw for built-in scalars; a sum some 6 flops, a product 10, a quotient 12
template <Real Scalar>
class Ball {
 public:
  constexpr Ball() = default;
  // x - x is zero, or NaN where x is not finite. NOLINTBEGIN(misc-redundant-expression)
  constexpr Ball(const Scalar& exact) : centre_{exact}, radius_{exact - exact} {}
  constexpr Ball(int exact) requires(std::numeric_limits<Scalar>::digits >= 31) : Ball(Scalar(exact)) {}
  /// @param radius  >= 0
  constexpr Ball(const Scalar& centre, const Scalar& radius) : centre_{centre}, radius_{radius + (centre - centre)} {}

  /// The smallest ball found around [lower, upper]; the whole line where an end is not finite or they are the wrong way
  /// round.
  [[nodiscard]] static Ball between(const Scalar& lower, const Scalar& upper) {
    if (!(lower < upper)) return lower == upper ? Ball{lower} : whole_line();
    const Scalar centre = lower / Scalar{2} + upper / Scalar{2};
    return {centre, enlarged(std::max<Scalar>(upper - centre, centre - lower) + (upper - upper) + (lower - lower))};
  }
  // NOLINTEND(misc-redundant-expression)
  [[nodiscard]] static constexpr Ball whole_line() { return {Scalar{0}, std::numeric_limits<Scalar>::infinity()}; }

  [[nodiscard]] const Scalar& centre() const { return centre_; }
  [[nodiscard]] const Scalar& radius() const { return radius_; }
  [[nodiscard]] bool bounded() const { return radius_ < std::numeric_limits<Scalar>::infinity(); }  // false for NaN

  /// No number of the ball is below or above.
  [[nodiscard]] Scalar lower() const { return bounded() ? below(centre_ - radius_) : -whole_line().radius(); }
  [[nodiscard]] Scalar upper() const { return bounded() ? -below(-(centre_ + radius_)) : whole_line().radius(); }
  /// The absolute values of the ball's numbers lie between.
  [[nodiscard]] Scalar least_magnitude() const { return std::max<Scalar>(Scalar{0}, abs(*this).lower()); }
  [[nodiscard]] Scalar magnitude() const { return abs(*this).upper(); }

  [[nodiscard]] bool certainly_positive() const { return bounded() && centre_ > radius_; }
  [[nodiscard]] bool certainly_negative() const { return bounded() && -centre_ > radius_; }
  [[nodiscard]] bool certainly_below(const Ball& other) const { return (other - *this).certainly_positive(); }
  [[nodiscard]] bool certainly_above(const Ball& other) const { return other.certainly_below(*this); }
  /// False only where `value` is certainly outside.
  [[nodiscard]] bool contains(const Scalar& value) const { return !(value < lower()) && !(value > upper()); }
  [[nodiscard]] bool contains(const Ball& other) const { return lower() <= other.lower() && other.upper() <= upper(); }

  Ball& operator+=(const Ball& y) { return *this = *this + y; }
  Ball& operator-=(const Ball& y) { return *this = *this - y; }
  Ball& operator*=(const Ball& y) { return *this = *this * y; }
  Ball& operator/=(const Ball& y) { return *this = *this / y; }

  [[nodiscard]] friend Ball operator+(const Ball& x) { return x; }
  [[nodiscard]] friend Ball operator-(const Ball& x) { return {-x.centre_, x.radius_}; }
  [[nodiscard]] friend Ball operator+(const Ball& x, const Ball& y) {
    return rounded(x.centre_ + y.centre_, x.radius_ + y.radius_);
  }
  [[nodiscard]] friend Ball operator-(const Ball& x, const Ball& y) { return x + (-y); }
  [[nodiscard]] friend Ball operator*(const Ball& x, const Ball& y) {
    using std::abs;
    return rounded(x.centre_ * y.centre_, abs(x.centre_) * y.radius_ + x.radius_ * (abs(y.centre_) + y.radius_));
  }
  // |x'/y' - x/y| = |(x' - x) - (x/y) (y' - y)| / |y'|
  [[nodiscard]] friend Ball operator/(const Ball& x, const Ball& y) {
    using std::abs;
    const Scalar least = abs(y.centre_) - y.radius_;
    if (!(least > Scalar{0})) return whole_line();
    const Scalar quotient = x.centre_ / y.centre_;
    // What underflows before the last division is magnified by it.
    return rounded(quotient, (x.radius_ + (abs(quotient) + tiny()) * y.radius_ + tiny()) / least);
  }

  /// Squares are not negative (but for rounding), which x * x does not know.
  [[nodiscard]] friend Ball square(const Ball& x) {
    const Ball product = x * x;
    return product.lower() < Scalar{0} && product.bounded() ? between(Scalar{0}, product.upper()) : product;
  }
  [[nodiscard]] friend Ball abs(const Ball& x) { return x.centre_ < Scalar{0} ? -x : x; }
  /// The whole line where x may be negative.
  [[nodiscard]] friend Ball sqrt(const Ball& x) {
    using std::sqrt;
    if (!(x.centre_ >= x.radius_)) return whole_line();
    const Scalar root = sqrt(x.centre_);
    return x.radius_ > Scalar{0} ? rounded(root, x.radius_ / root) : rounded(root, Scalar{0});
  }
  /// By the power series on |x| <= 1/4, squared until it spans x.
  [[nodiscard]] friend Ball exp(const Ball& x) {
    if (!x.bounded()) return whole_line();
    if (x.radius_ > Scalar{1} / Scalar{2}) return hull(exp(Ball{x.lower()}), exp(Ball{x.upper()}));
    const Ball at_centre = exp_of(x.centre_);
    return at_centre * Ball{Scalar{1}, enlarged(x.radius_ * (Scalar{1} + x.radius_))};  // e^r - 1 < r + r^2
  }

  /// The smallest ball found around both.
  [[nodiscard]] friend Ball hull(const Ball& x, const Ball& y) {
    return between(std::min<Scalar>(x.lower(), y.lower()), std::max<Scalar>(x.upper(), y.upper()));
  }

  friend std::ostream& operator<<(std::ostream& out, const Ball& x) { return out << x.centre_ << " +- " << x.radius_; }

 private:
  static constexpr int most_squarings = 40;

  static Ball exp_of(const Scalar& x) {
    using std::abs;
    constexpr Scalar eps = std::numeric_limits<Scalar>::epsilon();
    Scalar part = x;
    int squarings = 0;
    for (; abs(part) > Scalar{1} / Scalar{4} && squarings < most_squarings; ++squarings) part /= Scalar{2};
    if (squarings == most_squarings) return whole_line();
    Scalar term{1}, sum{0};
    int n = 0;
    for (; abs(term) > eps / Scalar{8}; ++n, term *= part / Scalar(n)) sum += term;
    // The first n terms have lost less than n eps of 4/3, the rest is below 2 term.
    Ball result = rounded(sum, Scalar(2 * n + 2) * eps);
    for (; squarings > 0; --squarings) result = result * result;
    return result;
  }

  // Above what underflow takes from a result with all its intermediate products; where the exponent has room for it, so
  // much above that its own products are not subnormal, which would be slow.
  static constexpr Scalar tiny() {
    using Limits = std::numeric_limits<Scalar>;
    if constexpr (std::floating_point<Scalar> && Limits::min_exponent <= -1021) {
      return Limits::min() / (Limits::epsilon() * Limits::epsilon() * Limits::epsilon() * Limits::epsilon());
    } else {
      return Limits::min() * Scalar{16};
    }
  }

  // Above the exact value of an expression of at most 12 sums, products and quotients of numbers >= 0.
  static Scalar enlarged(const Scalar& radius) {
    return radius * (Scalar{1} + Scalar{8} * std::numeric_limits<Scalar>::epsilon()) + tiny();
  }
  static Scalar below(const Scalar& value) {
    using std::abs;
    return value - (abs(value) * std::numeric_limits<Scalar>::epsilon() + tiny());
  }
  // Of a centre that was rounded once.
  static Ball rounded(const Scalar& centre, const Scalar& radius) {
    using std::abs;
    return {centre, enlarged(radius + abs(centre) * std::numeric_limits<Scalar>::epsilon())};
  }

  Scalar centre_{0}, radius_{0};
};

}  // namespace limpid

/// Matrices of balls, of fixed size; products with matrices of their scalar, which are exact.
template <typename Scalar>
struct Eigen::NumTraits<limpid::Ball<Scalar>> : Eigen::GenericNumTraits<limpid::Ball<Scalar>> {
  using Real = limpid::Ball<Scalar>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  static constexpr int digits10() { return NumTraits<Scalar>::digits10(); }
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 6,
    MulCost = 10
  };
};

template <typename Scalar, typename Operation>
struct Eigen::ScalarBinaryOpTraits<limpid::Ball<Scalar>, Scalar, Operation> {
  using ReturnType = limpid::Ball<Scalar>;
};

template <typename Scalar, typename Operation>
struct Eigen::ScalarBinaryOpTraits<Scalar, limpid::Ball<Scalar>, Operation> {
  using ReturnType = limpid::Ball<Scalar>;
};
