// SPDX-License-Identifier: MIT
#include <limpid/core/flat.hpp>
#include <limpid/core/lane_math.hpp>
#include <limpid/core/lanes.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace limpid;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

template <typename Scalar, int n>
using Entries = Eigen::Array<Scalar, n, 1, Eigen::DontAlign>;

// Of `got`, in units in the last place of what it should be.
template <typename Scalar>
double units(const Scalar& got, const Fifty& wanted) {
  const Scalar size = std::abs(static_cast<Scalar>(wanted));
  const Scalar unit = std::nextafter(size, std::numeric_limits<Scalar>::infinity()) - size;
  return std::abs(static_cast<double>((Fifty(got) - wanted) / Fifty(unit)));
}

// Of sizes from 1e-6 on, each decade as often as the others.
template <typename Scalar>
Scalar spread(std::mt19937& random, double largest) {
  std::uniform_real_distribution<double> exponent(-6, std::log10(largest)), sign(-1, 1);
  return static_cast<Scalar>(std::copysign(std::pow(10.0, exponent(random)), sign(random)));
}

}  // namespace

// The documentation's bounds, and its range for each angle; 20 000 angles find the largest errors to about a tenth.
TEST_CASE_TEMPLATE("sine and cosine lie within 1.5 units in the last place of 50 digits", Scalar, float, double) {
  constexpr unsigned seed = 17760401;
  CAPTURE(seed);
  std::mt19937 random(seed);
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    Entries<Scalar, 4> angle;
    for (int k = 0; k < 4; ++k) angle[k] = spread<Scalar>(random, i % 2 == 0 ? 4 : 1e5);
    const auto [sine, cosine] = sine_cosine(angle);
    for (int k = 0; k < 4; ++k) {
      worst = maximum(worst, units(sine[k], sin(Fifty(angle[k]))), units(cosine[k], cos(Fifty(angle[k]))));
    }
  }
  CHECK(worst < 1.5);
}

TEST_CASE_TEMPLATE("four angles of 1e5 rad are taken side by side", Scalar, float, double) {
  const Scalar most(1e5);
  const auto [sine, cosine] = sine_cosine(Entries<Scalar, 4>(most, -most, most, -most));
  const Entries<Scalar, 4> sign(Scalar(1), Scalar(-1), Scalar(1), Scalar(-1));
  CHECK((sine == sine[0] * sign).all());
  CHECK((cosine == cosine[0]).all());
  CHECK(units(sine[0], sin(Fifty(most))) < 1.5);
  CHECK(units(cosine[0], cos(Fifty(most))) < 1.5);
  static_assert(1e5 <= limpid::detail::largest_reduced_angle);
}

TEST_CASE_TEMPLATE("an arc tangent lies within 2.3 units in the last place of 50 digits", Scalar, float, double) {
  constexpr unsigned seed = 17760402;
  CAPTURE(seed);
  std::mt19937 random(seed);
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    Entries<Scalar, 4> y, x;
    for (int k = 0; k < 4; ++k) {
      y[k] = spread<Scalar>(random, 10);
      x[k] = spread<Scalar>(random, 10);
    }
    const auto angle = arc_tangent(y, x);
    for (int k = 0; k < 4; ++k) worst = maximum(worst, units(angle[k], atan2(Fifty(y[k]), Fifty(x[k]))));
  }
  CHECK(worst < 2.3);
}

TEST_CASE_TEMPLATE("on the axes an arc tangent is exact, and 0 at the origin", Scalar, float, double, long double) {
  const Entries<Scalar, 4> y(Scalar{0}, Scalar{0}, Scalar{2}, Scalar{-3}),
      x(Scalar{0}, Scalar{-1}, Scalar{0}, Scalar{0});
  const Scalar pi = std::numbers::pi_v<Scalar>;
  CHECK((arc_tangent(y, x) == Entries<Scalar, 4>(Scalar{0}, pi, pi / 2, -pi / 2)).all());
}

TEST_CASE_TEMPLATE("lanes do not know of each other", Scalar, float, double) {
  const Entries<Scalar, 4> angle(Scalar(0.3), Scalar(-2.9), Scalar(71), Scalar(1e-5));
  const auto together = sine_cosine(angle);
  for (int k = 0; k < 4; ++k) {
    const auto alone = sine_cosine(Entries<Scalar, 1>(angle[k]));
    // a compiler may contract the products of a lane alone otherwise: one unit in the last place
    CHECK(together.sine[k] == doctest::Approx(alone.sine[0]).epsilon(2 * std::numeric_limits<Scalar>::epsilon()));
    CHECK(together.cosine[k] == doctest::Approx(alone.cosine[0]).epsilon(2 * std::numeric_limits<Scalar>::epsilon()));
  }
}

TEST_CASE_TEMPLATE("angles beyond 1e5 rad, and other numbers of lanes, go to the scalar's own functions", Scalar, float,
                   double, long double) {
  const Entries<Scalar, 3> angle(Scalar(1e7), Scalar(0.5), Scalar(-4));
  const auto [sine, cosine] = sine_cosine(angle);
  for (int k = 0; k < 3; ++k) {
    CHECK(sine[k] == std::sin(angle[k]));
    CHECK(cosine[k] == std::cos(angle[k]));
  }
  const Entries<Scalar, 4> far = Entries<Scalar, 4>::Constant(Scalar(3e8));
  CHECK((sine_cosine(far).sine == std::sin(Scalar(3e8))).all());
}

TEST_CASE_TEMPLATE("what is not finite comes out as NaN", Scalar, float, double) {
  const Scalar infinity = std::numeric_limits<Scalar>::infinity(), nan = std::numeric_limits<Scalar>::quiet_NaN();
  for (const Scalar& bad : {infinity, -infinity, nan}) {
    const Entries<Scalar, 4> angle(Scalar(1), bad, Scalar(2), Scalar(3));
    CHECK(std::isnan(sine_cosine(angle).sine[1]));
    CHECK(std::isnan(sine_cosine(angle).cosine[1]));
    CHECK(sine_cosine(angle).sine[2] == std::sin(Scalar(2)));
  }
  const Entries<Scalar, 2> y(nan, Scalar(1)), x(Scalar(1), nan);
  CHECK(arc_tangent(y, x).isNaN().all());
}

TEST_CASE("sines and arc tangents do not allocate") {
  Entries<double, 4> angle = Entries<double, 4>::Constant(0.25), back;
  test::check_no_allocation([&] {
    const auto [sine, cosine] = sine_cosine(angle);
    back = arc_tangent(sine, cosine);
  });
  CHECK(back.isApproxToConstant(0.25, 1e-15));
}

TEST_CASE("three axes take a fourth lane, which repeats the third") {
  const auto lanes = to_lanes<3>(Eigen::Array3d(1, 2, 3));
  static_assert(decltype(lanes)::SizeAtCompileTime == 4);
  CHECK((lanes == Eigen::Array4d(1, 2, 3, 3)).all());
  CHECK(to_lanes<2>(Eigen::Array2d(1, 2)).size() == 2);
  using Wide = Eigen::Array<long double, 3, 1>;
  CHECK(to_lanes<3>(Wide(1, 2, 3)).size() == 3);
}

TEST_CASE_TEMPLATE("flat calls what it is given and hands its value on", Scalar, double, Fifty) {
  Scalar kept{0};
  CHECK(flat<Scalar>([&] { return kept = Scalar{3}; }) == Scalar{3});
  CHECK(kept == Scalar{3});
  static_assert(noexcept(flat<Scalar>([]() noexcept {})));
  static_assert(!noexcept(flat<Scalar>([] {})));
}
