// SPDX-License-Identifier: MIT
#include <limpid/environment/coupled.hpp>
#include <limpid/environment/fixed.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/tangent_model.hpp>

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

TEST_CASE_TEMPLATE("Kelvin-Voigt is an environment", Scalar, float, double, long double) {
  using E = KelvinVoigt<3, Scalar>;
  check_environment(E{}, range<E>({200, 20}, {2000, 40}));
}

TEST_CASE_TEMPLATE("the tangent model is an environment", Scalar, float, double, long double) {
  using E = Tangent<3, Scalar>;
  check_environment(E{}, range<E>({200, 20, -55}, {2000, 40, 0}));
}

TEST_CASE_TEMPLATE("an environment with fixed parameters is one", Scalar, float, double, long double) {
  using E = Fixed<Tangent<3, Scalar>, 1>;
  check_environment(E({.known = Eigen::Array<Scalar, 3, 1>::Constant(Scalar(30))}), range<E>({200, -55}, {2000, 0}));
}

TEST_CASE_TEMPLATE("the coupled environment is one", Scalar, float, double, long double) {
  using E = Coupled<2, Scalar>;
  check_environment(E{}, range<E>({200, -50, 20, -5}, {2000, 50, 40, 5}));
}
