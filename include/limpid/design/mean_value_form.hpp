// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/ball.hpp>

namespace limpid {

/// A function of two parameters over a cell: for every Delta in [-1, 1] x [-1, 1] there are numbers of the three balls
/// with
///
///     f(Delta) = centre + slope1 Delta1 + slope2 Delta2
///
/// What was rounded or cut off lies in `centre`. As the cell shrinks, the bounds of a sum, product or smooth function
/// come to its true ones as the square of the width; a Ball alone does so linearly.
/// @realtime  no allocation, no throw for built-in scalars; a product some 100 flops
template <Real Scalar>
class MeanValueForm {
 public:
  using Number = Ball<Scalar>;

  MeanValueForm() = default;
  MeanValueForm(const Number& constant) : centre_{constant} {}
  MeanValueForm(const Scalar& exact) : centre_{exact} {}
  MeanValueForm(const Number& centre, const Number& slope1, const Number& slope2)
      : centre_{centre}, slope1_{slope1}, slope2_{slope2} {}

  /// Parameter 1 over [lower, upper]; parameter 2 by `second`.
  [[nodiscard]] static MeanValueForm first(const Scalar& lower, const Scalar& upper) {
    const Number side = Number::between(lower, upper);
    return {Number{side.centre()}, Number{side.radius()}, Number{}};
  }
  [[nodiscard]] static MeanValueForm second(const Scalar& lower, const Scalar& upper) {
    const Number side = Number::between(lower, upper);
    return {Number{side.centre()}, Number{}, Number{side.radius()}};
  }

  [[nodiscard]] const Number& centre() const { return centre_; }
  [[nodiscard]] const Number& slope1() const { return slope1_; }
  [[nodiscard]] const Number& slope2() const { return slope2_; }
  /// Every value over the cell.
  [[nodiscard]] Number range() const { return centre_ + slope1_ * unit() + slope2_ * unit(); }

  /// The values at one Delta.
  [[nodiscard]] Number at(const Number& Delta1, const Number& Delta2) const {
    return centre_ + slope1_ * Delta1 + slope2_ * Delta2;
  }

  /// f(x), where `at_centre` holds f of x.centre() and `derivative` f' of x.range().
  [[nodiscard]] static MeanValueForm of(const MeanValueForm& x, const Number& at_centre, const Number& derivative) {
    return {at_centre, derivative * x.slope1_, derivative * x.slope2_};
  }

  [[nodiscard]] friend MeanValueForm operator-(const MeanValueForm& x) { return {-x.centre_, -x.slope1_, -x.slope2_}; }
  [[nodiscard]] friend MeanValueForm operator+(const MeanValueForm& x, const MeanValueForm& y) {
    return {x.centre_ + y.centre_, x.slope1_ + y.slope1_, x.slope2_ + y.slope2_};
  }
  [[nodiscard]] friend MeanValueForm operator-(const MeanValueForm& x, const MeanValueForm& y) { return x + (-y); }
  [[nodiscard]] friend MeanValueForm operator*(const Number& x, const MeanValueForm& y) {
    return {x * y.centre_, x * y.slope1_, x * y.slope2_};
  }
  // x y = x_c y_c + x (y - y_c) + (x - x_c) y_c
  [[nodiscard]] friend MeanValueForm operator*(const MeanValueForm& x, const MeanValueForm& y) {
    const Number range = x.range();
    return {x.centre_ * y.centre_, range * y.slope1_ + x.slope1_ * y.centre_,
            range * y.slope2_ + x.slope2_ * y.centre_};
  }
  // x/y = x_c/y_c + ((x - x_c) - (x_c/y_c) (y - y_c)) / y
  [[nodiscard]] friend MeanValueForm operator/(const MeanValueForm& x, const MeanValueForm& y) {
    const Number range = y.range(), quotient = x.centre_ / y.centre_;
    return {quotient, (x.slope1_ - quotient * y.slope1_) / range, (x.slope2_ - quotient * y.slope2_) / range};
  }

  MeanValueForm& operator+=(const MeanValueForm& y) { return *this = *this + y; }
  MeanValueForm& operator-=(const MeanValueForm& y) { return *this = *this - y; }
  MeanValueForm& operator*=(const MeanValueForm& y) { return *this = *this * y; }

  [[nodiscard]] friend MeanValueForm square(const MeanValueForm& x) {
    return of(x, square(x.centre_), x.range() + x.centre_);
  }
  [[nodiscard]] friend MeanValueForm exp(const MeanValueForm& x) { return of(x, exp(x.centre_), exp(x.range())); }

 private:
  static Number unit() { return {Scalar{0}, Scalar{1}}; }

  Number centre_{}, slope1_{}, slope2_{};
};

}  // namespace limpid

/// Matrices of forms, of fixed size.
template <typename Scalar>
struct Eigen::NumTraits<limpid::MeanValueForm<Scalar>> : Eigen::GenericNumTraits<limpid::MeanValueForm<Scalar>> {
  using Real = limpid::MeanValueForm<Scalar>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 6,
    AddCost = 18,
    MulCost = 90
  };
};
