// SPDX-License-Identifier: MIT
#include <limpid/core/lane_exponential.hpp>
#include <limpid/core/lane_power.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace limpid;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

template <typename Scalar>
using Four = Eigen::Array<Scalar, 4, 1>;
template <typename Scalar>
using Three = Eigen::Array<Scalar, 3, 1>;

// Of `got`, in units in the last place of what it should be.
template <typename Scalar>
double units(const Scalar& got, const Fifty& wanted) {
  const Scalar size = std::abs(static_cast<Scalar>(wanted));
  const Scalar unit = std::nextafter(size, std::numeric_limits<Scalar>::infinity()) - size;
  return std::abs(static_cast<double>((Fifty(got) - wanted) / Fifty(unit)));
}

// Where the scalar's own function is taken, or the same number: to a unit in the last place, or both not a number.
template <typename Scalar>
bool as_libm(const Scalar& got, const Scalar& libm) {
  if (std::isnan(libm)) return std::isnan(got);
  return got == libm || std::abs(got - libm) <= 2 * std::numeric_limits<Scalar>::epsilon() * std::abs(libm);
}

class Random {
 public:
  template <typename Scalar>
  Four<Scalar> four(double low, double high) {
    Four<Scalar> values;
    for (auto& value : values) value = static_cast<Scalar>(std::uniform_real_distribution<double>(low, high)(random_));
    return values;
  }

 private:
  std::mt19937 random_{16140101};  // Napier's logarithms
};

template <typename Scalar>
constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
template <typename Scalar>
constexpr Scalar odd_ones[] = {Scalar(0),
                               -Scalar(0),
                               std::numeric_limits<Scalar>::denorm_min(),
                               std::numeric_limits<Scalar>::min(),
                               std::numeric_limits<Scalar>::max(),
                               -std::numeric_limits<Scalar>::max(),
                               infinity<Scalar>,
                               -infinity<Scalar>,
                               std::numeric_limits<Scalar>::quiet_NaN(),
                               Scalar(1),
                               Scalar(-1),
                               Scalar(0.5),
                               Scalar(-2),
                               Scalar(3),
                               Scalar(88.5),
                               Scalar(-104),
                               Scalar(709.5),
                               Scalar(-745),
                               Scalar(-0.99)};

}  // namespace

// The documentation's bounds, and for the logarithm below it; 20 000 arguments find the largest errors to about a
// tenth.
TEST_CASE_TEMPLATE("exponentials and logarithms lie within their bounds of 50 digits", Scalar, float, double) {
  Random random;
  double worst_exp = 0, worst_log = 0, worst_log1p = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto x = random.four<Scalar>(-40, 40), y = random.four<Scalar>(i % 2 == 0 ? 0.5 : 1e-6, i % 4 == 0 ? 2 : 9);
    const auto z = random.four<Scalar>(i % 2 == 0 ? -0.5 : -1e-3, i % 2 == 0 ? 1 : 1e-3);
    const auto e = exponential(x), l = logarithm(y), p = logarithm_of_one_plus(z);
    for (int k = 0; k < 4; ++k) {
      worst_exp = maximum(worst_exp, units(e[k], exp(Fifty(x[k]))));
      worst_log = maximum(worst_log, units(l[k], log(Fifty(y[k]))));
      worst_log1p = maximum(worst_log1p, units(p[k], log1p(Fifty(z[k]))));
    }
  }
  CHECK(worst_exp < 1.1);
  CHECK(worst_log < 0.8);
  CHECK(worst_log1p < 1.4);
}

TEST_CASE_TEMPLATE("a power of a depth lies within 1.4 units in the last place of 50 digits", Scalar, float, double) {
  Random random;
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    const Four<Scalar> x = random.four<Scalar>(-16, 1).exp(), p = random.four<Scalar>(0, 2);
    const auto powers = power(x, p);
    for (int k = 0; k < 4; ++k) worst = maximum(worst, units(powers[k], pow(Fifty(x[k]), Fifty(p[k]))));
  }
  CHECK(worst < 1.4);
}

TEST_CASE_TEMPLATE("a power at the border of its lanes lies within 4 units in the last place of 50 digits", Scalar,
                   float, double) {
  Random random;
  double worst = 0;
  for (int i = 0; i < 2500; ++i) {
    const Four<Scalar> x = random.four<Scalar>(-3, 3).exp(), y = random.four<Scalar>(-40, 40);
    const Four<Scalar> p = (y / x.log()).min(Scalar(16)).max(Scalar(-16));
    const auto powers = power(x, p);
    for (int k = 0; k < 4; ++k) worst = maximum(worst, units(powers[k], pow(Fifty(x[k]), Fifty(p[k]))));
  }
  CHECK(worst < 4);
}

TEST_CASE_TEMPLATE("three axes are taken as four lanes are", Scalar, float, double) {
  const Four<Scalar> x(Scalar(0.001), Scalar(0.5), Scalar(2), Scalar(2));
  const Three<Scalar> three = x.template head<3>();
  CHECK((power(three, Scalar(0.3)) == power(x, Scalar(0.3)).template head<3>()).all());
  CHECK((exponential(three) == exponential(x).template head<3>()).all());
  CHECK((logarithm(three) == logarithm(x).template head<3>()).all());
}

TEST_CASE_TEMPLATE("zero to the power of zero is one, to a positive one zero, beside others", Scalar, float, double,
                   long double) {
  const Three<Scalar> x(Scalar(0), Scalar(0), Scalar(4)), p(Scalar(0), Scalar(0.3), Scalar(0.5));
  CHECK((power(x, p) == Three<Scalar>(Scalar(1), Scalar(0), Scalar(2))).all());
}

TEST_CASE_TEMPLATE("zeros, denormals, infinities and NaN come out as the scalar's own functions say", Scalar, float,
                   double) {
  for (const Scalar& odd : odd_ones<Scalar>) {
    CAPTURE(odd);
    const Four<Scalar> x(Scalar(0.25), odd, Scalar(1.5), Scalar(0.75));
    CHECK(as_libm(exponential(x)[1], std::exp(odd)));
    CHECK(as_libm(logarithm(x)[1], std::log(odd)));
    CHECK(as_libm(logarithm_of_one_plus(x)[1], std::log1p(odd)));
    CHECK(as_libm(exponential(x)[2], std::exp(Scalar(1.5))));
    for (const Scalar& p : odd_ones<Scalar>) {
      CAPTURE(p);
      CHECK(as_libm(power(x, p)[1], std::pow(odd, p)));
    }
  }
}

TEST_CASE_TEMPLATE("one entry, and other scalars, go to the scalar's own functions", Scalar, float, double, long double,
                   Fifty) {
  using std::abs, std::exp, std::log1p, std::pow;
  using One = Eigen::Array<Scalar, 1, 1>;
  const Scalar x = Scalar(3) / 10,
               rounding = std::numeric_limits<Scalar>::epsilon();  // a compiler may know them nearer
  CHECK(abs(Scalar(exponential(One(x))[0] - exp(x))) <= rounding);
  CHECK(abs(Scalar(logarithm_of_one_plus(One(x))[0] - log1p(x))) <= rounding);
  CHECK(abs(Scalar(power(One(x), x)[0] - pow(x, x))) <= rounding);
}

TEST_CASE("powers and exponentials do not allocate") {
  Three<double> x = Three<double>::Constant(0.25);
  test::check_no_allocation([&] { x = power(exponential(logarithm(x)), 0.5); });
  CHECK(x.isApproxToConstant(0.5, 1e-15));
}
