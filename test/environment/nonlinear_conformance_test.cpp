// SPDX-License-Identifier: MIT
#include <limpid/environment/exponential.hpp>
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/layered.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/unilateral.hpp>

#include <conformance/environment_suite.hpp>

#include <doctest/doctest.h>

using namespace limpid;
using limpid::test::check_environment;
using limpid::test::EnvironmentRange;

namespace {

// 30 mm and 1 m/s, parameters of soft tissue
template <Environment E>
EnvironmentRange<E> range(std::initializer_list<double> lower, std::initializer_list<double> upper) {
  using Scalar = typename EnvironmentTraits<E>::Scalar;
  EnvironmentRange<E> range{Scalar(0.03), Scalar(1), {}, {}};
  for (int i = 0; i < EnvironmentTraits<E>::parameters; ++i) {
    range.lower.col(i).setConstant(Scalar(lower.begin()[i]));
    range.upper.col(i).setConstant(Scalar(upper.begin()[i]));
  }
  return range;
}

}  // namespace

TEST_CASE_TEMPLATE("the smooth bilinear tissue is an environment", Scalar, float, double, long double) {
  using E = SmoothBilinear<3, Scalar>;
  check_environment(E({.depth = Scalar(0.00284), .sharpness = Scalar(20)}), range<E>({200, 1000, 20}, {800, 2000, 40}));
}

TEST_CASE_TEMPLATE("Hunt-Crossley is an environment", Scalar, float, double, long double) {
  using E = HuntCrossley<3, Scalar>;
  check_environment(E({.exponent = Scalar(1.3)}), range<E>({200, 0, 20}, {2000, 500, 40}));
}

TEST_CASE_TEMPLATE("the exponential tissue is an environment", Scalar, float, double, long double) {
  using E = Exponential<3, Scalar>;
  check_environment(E({.growth = Scalar(150)}), range<E>({0.5, 20}, {2, 40}));
}

TEST_CASE_TEMPLATE("the layered tissue is an environment", Scalar, float, double, long double) {
  using E = Layered<3, 3, Scalar>;
  check_environment(E({.depths = {Scalar(0.0015), Scalar(0.0025)}}),
                    range<E>({200, 1000, 500, 20}, {800, 2000, 1500, 40}));
}

TEST_CASE_TEMPLATE("a unilateral environment is one", Scalar, float, double, long double) {
  using E = Unilateral<KelvinVoigt<3, Scalar>>;
  check_environment(E({}), range<E>({200, 20}, {2000, 40}));
}
