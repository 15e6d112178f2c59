// SPDX-License-Identifier: MIT
#include <limpid/environment/coupled.hpp>
#include <limpid/environment/fixed.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/unilateral.hpp>

#include <conformance/environment_suite.hpp>

#include <doctest/doctest.h>

using namespace limpid;

namespace {

using Row2 = Eigen::Array<double, 1, 2>;
using One = Eigen::Array<double, 1, 1>;

// A foreign type, with names of its own.
struct Gel {
  double cubic_share = 1e4;
};

// Types that lack one thing each.
struct WithoutTangent {
  using Scalar = double;
  static constexpr int axes = 1, parameters = 2;
  static constexpr bool linear = true;
  Row2 regressor(const One&, const One&) const;
  One force(const Row2&, const One&, const One&) const;
};

struct WithoutFlag {
  using Scalar = double;
  static constexpr int axes = 1, parameters = 2;
  Row2 regressor(const One&, const One&) const;
  One force(const Row2&, const One&, const One&) const;
  Tangents<1> tangent(const Row2&, const One&, const One&) const;
};

struct WithoutParameters : WithoutFlag {
  static constexpr int parameters = 0;
  static constexpr bool linear = true;
};

struct OfIntegers : WithoutFlag {
  using Scalar = int;
  [[maybe_unused]] static constexpr bool linear = true;
};

}  // namespace

namespace limpid {

// F = k (x + s x^3) + b v
template <>
struct EnvironmentTraits<Gel> {
  using Scalar = double;
  static constexpr int axes = 1, parameters = 2;
  static constexpr bool linear = false, decoupled = true, bilateral = true;
  static Row2 regressor(const Gel& gel, const One& x, const One& v) noexcept {
    return {x[0] + gel.cubic_share * x[0] * x[0] * x[0], v[0]};
  }
  static One force(const Gel& gel, const Row2& theta, const One& x, const One& v) noexcept {
    return One((theta * regressor(gel, x, v)).sum());
  }
  static Tangents<1> tangent(const Gel& gel, const Row2& theta, const One& x, const One&) noexcept {
    return {One(theta[0] * (1 + 3 * gel.cubic_share * x[0] * x[0])), One(theta[1])};
  }
};

}  // namespace limpid

static_assert(LinearEnvironment<KelvinVoigt<3>> && DecoupledEnvironment<KelvinVoigt<3>>);
static_assert(LinearEnvironment<Coupled<3>> && !DecoupledEnvironment<Coupled<3>>);
static_assert(Environment<SmoothBilinear<2, float>> && !LinearEnvironment<SmoothBilinear<2, float>>);
static_assert(LinearEnvironment<Fixed<Tangent<3>, 1>> && !LinearEnvironment<Unilateral<Tangent<3>>>);
static_assert(EnvironmentTraits<Fixed<Tangent<3>, 1>>::parameters == 2);
static_assert(EnvironmentTraits<KelvinVoigt<3>>::bilateral &&
              !EnvironmentTraits<Unilateral<KelvinVoigt<3>>>::bilateral);
static_assert(Environment<Gel> && DecoupledEnvironment<Gel> && !LinearEnvironment<Gel>);
static_assert(Environment<Fixed<Gel, 1>> && Environment<Unilateral<Gel>>);

static_assert(!Environment<int> && !Environment<Row2>);
static_assert(!Environment<WithoutTangent>);
static_assert(!Environment<WithoutFlag>);
static_assert(!Environment<WithoutParameters>);
static_assert(!Environment<OfIntegers>);

TEST_CASE("a foreign type becomes an environment by its traits") {
  test::check_environment(Gel{}, {.deepest = 0.03, .fastest = 1, .lower = {200, 20}, .upper = {2000, 40}});
}

TEST_CASE("wrappers take a foreign type as they take ours") {
  const Fixed<Gel, 1> e({.environment = {}, .known = One(30)});
  test::check_environment(e, {.deepest = 0.03, .fastest = 1, .lower = One(200), .upper = One(2000)});
  CHECK(e.force(One(800), One(0.5), One(0.125))[0] == 800 * (0.5 + 1250) + 3.75);  // exact in binary
}
