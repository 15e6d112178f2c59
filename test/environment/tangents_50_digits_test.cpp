// SPDX-License-Identifier: MIT
#include <limpid/environment/coupled.hpp>
#include <limpid/environment/exponential.hpp>
#include <limpid/environment/fixed.hpp>
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/layered.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/unilateral.hpp>

#include <conformance/environment_suite.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

using namespace limpid;
using limpid::test::check_tangent_is_the_derivative;
using limpid::test::EnvironmentRange;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

template <Environment E>
EnvironmentRange<E> range(std::initializer_list<int> lower, std::initializer_list<int> upper) {
  EnvironmentRange<E> range{Fifty(3) / 100, Fifty(1), {}, {}};  // 30 mm, 1 m/s
  for (int i = 0; i < E::parameters; ++i) {
    range.lower.col(i).setConstant(Fifty(lower.begin()[i]));
    range.upper.col(i).setConstant(Fifty(upper.begin()[i]));
  }
  return range;
}

const SmoothBilinear<1, Fifty> tissue({.depth = Fifty(284) / 100'000, .sharpness = Fifty(20)});

}  // namespace

TEST_CASE("each model's tangent is its force's derivative, in 50 digits") {
  using KV = KelvinVoigt<2, Fifty>;
  check_tangent_is_the_derivative(KV{}, range<KV>({200, 20}, {2000, 40}));
  using T = Tangent<2, Fifty>;
  check_tangent_is_the_derivative(T{}, range<T>({200, 20, -55}, {2000, 40, 0}));
  using HC = HuntCrossley<1, Fifty>;
  check_tangent_is_the_derivative(HC({.exponent = Fifty(13) / 10}), range<HC>({200, 0, 20}, {2000, 500, 40}));
  check_tangent_is_the_derivative(tissue, range<SmoothBilinear<1, Fifty>>({200, 1000, 20}, {800, 2000, 40}));
  using X = Exponential<1, Fifty>;
  check_tangent_is_the_derivative(X({.growth = Fifty(150)}), range<X>({1, 20}, {2, 40}));
  using L = Layered<3, 2, Fifty>;
  check_tangent_is_the_derivative(L({.depths = {Fifty(15) / 10'000, Fifty(25) / 10'000}}),
                                  range<L>({200, 1000, 500, 20}, {800, 2000, 1500, 40}));
  using C = Coupled<2, Fifty>;
  check_tangent_is_the_derivative(C{}, range<C>({200, -50, 20, -5}, {2000, 50, 40, 5}));
}

TEST_CASE("wrapping a model keeps its tangent a derivative, in 50 digits") {
  using F = Fixed<SmoothBilinear<1, Fifty>, 2>;
  check_tangent_is_the_derivative(F({.environment = tissue, .known = Eigen::Array<Fifty, 1, 1>(Fifty(30))}),
                                  range<F>({200, 1000}, {800, 2000}));
  using U = Unilateral<KelvinVoigt<2, Fifty>>;
  check_tangent_is_the_derivative(U({}), range<U>({200, 20}, {2000, 40}));
}

TEST_CASE("the smooth bilinear force in double is the one in 50 digits to some roundings") {
  const SmoothBilinear<1> rounded({.depth = 0.00284, .sharpness = 20});
  const SmoothBilinear<1, Fifty> exact({.depth = Fifty(0.00284), .sharpness = Fifty(20)});  // the same double
  const Eigen::Array<double, 1, 3> theta{200, 2000, 30};
  Fifty worst = 0;
  for (int i = -300; i <= 300; ++i) {
    const double x = i * 1e-4;
    const double force = rounded.force(theta, Eigen::Array<double, 1, 1>(x), Eigen::Array<double, 1, 1>(0.0))[0];
    const Fifty true_force =
        exact.force(theta.cast<Fifty>(), Eigen::Array<Fifty, 1, 1>(Fifty(x)), Eigen::Array<Fifty, 1, 1>(Fifty(0)))[0];
    // where x = 0 both are (k2 - k1) x_s/R ln(1 + exp(-20)) = 5e-10 N
    worst = maximum(worst, Fifty(abs(force - true_force) / abs(true_force)));
  }
  // two products, a sum and the s of the second, some half ulp each; the roundings of R (x/x_s - 1), up to 20 times
  // larger in the exponential near x = 0, meet a term that is exp(-20) small there
  CHECK(worst < 4 * std::numeric_limits<double>::epsilon());
}
