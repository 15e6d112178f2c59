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

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::Coupled;
using limpid::Exponential;
using limpid::Fixed;
using limpid::HuntCrossley;
using limpid::KelvinVoigt;
using limpid::Layered;
using limpid::SmoothBilinear;
using limpid::Tangent;
using limpid::Unilateral;

namespace {

using One = Eigen::Array<double, 1, 1>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Fig. 3.4: k1 = 200 N/m, k2 = 2000 N/m, x_s = 2.84 mm, R = 20
SmoothBilinear<1> tissue_of_fig_3_4() { return SmoothBilinear<1>({.depth = 0.00284, .sharpness = 20}); }
const Eigen::Array<double, 1, 3> stiffnesses_of_fig_3_4{200.0, 2000.0, 0.0};

}  // namespace

TEST_CASE("Kelvin-Voigt is a spring and a damper (3.31)") {
  const KelvinVoigt<2> e;
  const Eigen::Array<double, 2, 2> theta{{800, 30}, {200, 20}};
  const auto force = e.force(theta, {0.5, -0.25}, {0.125, 1});  // exact in binary
  CHECK(force[0] == 403.75);
  CHECK(force[1] == -30);
}

TEST_CASE("the tangent model adds an offset (3.33)") {
  const Eigen::Array<double, 1, 3> theta{800, 30, -5};
  CHECK(Tangent<1>{}.force(theta, One(0.5), One(0.125))[0] == 398.75);
}

TEST_CASE("the smooth bilinear force is as (3.34) prints it") {
  const double x = 0.0031, k1 = 200, k2 = 2000, xs = 0.00284, R = 20;
  const double printed = k1 * x + (k2 - k1) * xs / R * std::log(1 + std::exp(R * (x / xs - 1)));
  const double force = tissue_of_fig_3_4().force(stiffnesses_of_fig_3_4, One(x), One(0))[0];
  CHECK(std::abs(force - printed) <=
        40 * epsilon * printed);  // x/xs - 1 loses 1/.09, R (x/xs - 1) stands in an exponent
}

TEST_CASE("the smooth bilinear force follows the piecewise linear one away from its corner") {
  const auto e = tissue_of_fig_3_4();
  // k1 x before it, with an error of (k2 - k1) x_s/R exp(-R (1 - x/x_s)): at half the depth .2556 exp(-10)
  const double before = e.force(stiffnesses_of_fig_3_4, One(0.00142), One(0))[0];
  CHECK(before - 200 * 0.00142 == doctest::Approx(0.2556 * std::log1p(std::exp(-10.0))).epsilon(1e-9));
  const double after =
      e.force(stiffnesses_of_fig_3_4, One(0.1), One(0))[0];  // R (x/x_s - 1) = 684: exp(-684) is nothing
  CHECK(std::abs(after - (200 * 0.00284 + 2000 * (0.1 - 0.00284))) <= 4 * epsilon * after);
}

TEST_CASE_TEMPLATE("the smooth bilinear force overflows at no depth", Scalar, float, double, long double) {
  using Vector = Eigen::Array<Scalar, 1, 1>;
  const SmoothBilinear<1, Scalar> e({.depth = Scalar(0.00284), .sharpness = Scalar(20)});
  const Eigen::Array<Scalar, 1, 3> theta{Scalar(0.5), Scalar(0.75), Scalar(0)};
  const Scalar deepest = std::numeric_limits<Scalar>::max();
  for (const Scalar x : {deepest, -deepest, Scalar(1e6), Scalar(-1e6)}) {
    CAPTURE(x);
    CHECK(limpid::is_finite(e.force(theta, Vector(x), Vector(Scalar{0}))));
    CHECK(limpid::is_finite(e.tangent(theta, Vector(x), Vector(Scalar{0})).stiffness));
  }
  CHECK(e.tangent(theta, Vector(deepest), Vector(Scalar{0})).stiffness[0] == Scalar(0.75));
  CHECK(e.tangent(theta, Vector(-deepest), Vector(Scalar{0})).stiffness[0] == Scalar(0.5));
}

TEST_CASE("at the depth of the corner the stiffness is the mean of the two") {
  CHECK(tissue_of_fig_3_4().tangent(stiffnesses_of_fig_3_4, One(0.00284), One(0)).stiffness[0] == 1100);
}

TEST_CASE("Hunt-Crossley is a power of the depth, odd in it, with two dampings") {
  const HuntCrossley<1> e({.exponent = 2});
  const Eigen::Array<double, 1, 3> theta{1500, 64, 30};
  CHECK(e.force(theta, One(0.5), One(0.25))[0] == 386.5);    // 1500/4 + 64/4/4 + 30/4
  CHECK(e.force(theta, One(-0.5), One(0.25))[0] == -363.5);  // -1500/4 + 64/4/4 + 30/4
}

TEST_CASE("the force of section 7.1.2 presses 21 mm deep at 10 N") {
  const HuntCrossley<1> e({.exponent = 1.3});
  const double depth = std::pow(10.0 / 1500.0, 1 / 1.3);
  const double force = e.force({1500.0, 0.0, 30.0}, One(depth), One(0))[0];
  CHECK(depth == doctest::Approx(0.0212).epsilon(0.005));  // printed to three digits
  CHECK(std::abs(force - 10) <= 10 * 10 * epsilon);        // a power of a power, each some roundings
}

TEST_CASE("Hunt-Crossley's tangent at the touch is its damping alone, and finite for an exponent of one") {
  const Eigen::Array<double, 1, 3> theta{1500, 64, 30};
  const auto soft = HuntCrossley<1>({.exponent = 1.3}).tangent(theta, One(0), One(2));
  CHECK(soft.stiffness[0] == 0);
  CHECK(soft.damping[0] == 30);
  const auto linear = HuntCrossley<1>({.exponent = 1}).tangent(theta, One(0), One(2));
  CHECK(linear.stiffness[0] == 1500);
}

TEST_CASE("the exponential force is A (exp(r x) - 1), to roundings also near the surface") {
  const Exponential<1> e({.growth = 600});
  const Eigen::Array<double, 1, 2> theta{0.5, 30};
  const double deep = 0.5 * (std::exp(1.2) - 1) + 30 * 0.25;
  CHECK(std::abs(e.force(theta, One(0.002), One(0.25))[0] - deep) <= 8 * epsilon * deep);
  // A r x (1 + r x / 2 + ...): the next term is (r x)^2 / 6 = 6e-18 of it
  const double shallow = 0.5 * 600e-11 * (1 + 300e-11);
  CHECK(std::abs(e.force(theta, One(1e-11), One(0))[0] - shallow) <= 8 * epsilon * shallow);
  CHECK(e.tangent(theta, One(0), One(1)).stiffness[0] == 300);
}

TEST_CASE("from r x = 64 on the exponential force goes on along its tangent") {
  const Exponential<1> e({.growth = 1024});
  const Eigen::Array<double, 1, 2> theta{2, 0};
  const double at = 64.0 / 1024, slope = 2 * 1024 * std::exp(64.0);
  const double from = e.force(theta, One(at), One(0))[0];
  CHECK(std::abs(from - 2 * std::exp(64.0)) <= 8 * epsilon * from);
  const double beyond = e.force(theta, One(4 * at), One(0))[0];
  CHECK(std::abs(beyond - from - slope * 3 * at) <= 8 * epsilon * beyond);
  CHECK(std::abs(e.tangent(theta, One(4 * at), One(0)).stiffness[0] - slope) <= 8 * epsilon * slope);
}

TEST_CASE("each layer adds its own stiffness over its own part of the depth") {
  const Layered<3> e({.depths = {0.25, 0.5}});
  const Eigen::Array<double, 1, 4> theta{400, 1500, 800, 32};
  const auto force = [&](double x) { return e.force(theta, One(x), One(0.125))[0]; };
  CHECK(force(-1) == -400 + 4);  // all exact in binary
  CHECK(force(0.125) == 50 + 4);
  CHECK(force(0.25) == 100 + 4);
  CHECK(force(0.375) == 100 + 187.5 + 4);
  CHECK(force(1) == 100 + 375 + 400 + 4);
  CHECK(e.tangent(theta, One(0.2), One(0)).stiffness[0] == 400);
  CHECK(e.tangent(theta, One(0.25), One(0)).stiffness[0] == 1500);  // of the layer below
  CHECK(e.tangent(theta, One(1), One(0)).stiffness[0] == 800);
  CHECK(e.tangent(theta, One(1), One(0)).damping[0] == 32);
}

TEST_CASE("fixed parameters leave the force as it is and take their columns from the regressor") {
  const Fixed<Tangent<2>, 1> e({.known = Eigen::Array2d{30, 20}});
  const Eigen::Array2d x{0.5, 0.25}, v{0.125, -1};
  const Eigen::Array22d theta{{800, -5}, {200, -1}};
  const Eigen::Array<double, 2, 3> whole{{800, 30, -5}, {200, 20, -1}};
  CHECK((e.force(theta, x, v) == Tangent<2>{}.force(whole, x, v)).all());
  CHECK((e.regressor(x, v).col(0) == x).all());
  CHECK((e.regressor(x, v).col(1) == 1).all());
  CHECK((e.tangent(theta, x, v).damping == Eigen::Array2d{30, 20}).all());
}

TEST_CASE("fixed parameters may be several") {
  const Fixed<HuntCrossley<1>, 1, 2> e({.environment = HuntCrossley<1>({.exponent = 2}), .known = {{64.0, 30.0}}});
  CHECK(e.parameters == 1);
  CHECK(e.force(One(1500), One(0.5), One(0.25))[0] == 386.5);
}

TEST_CASE("a unilateral contact has no force outside and never pulls") {
  const Unilateral<KelvinVoigt<1>> e({});
  const Eigen::Array<double, 1, 2> theta{800, 32};
  CHECK(e.force(theta, One(0.5), One(0.125))[0] == 404);
  CHECK(e.force(theta, One(-0.5), One(100))[0] == 0);  // outside, though the damper would push
  CHECK(e.force(theta, One(0.5), One(-100))[0] == 0);  // inside, but leaving so fast that the damper would pull
  CHECK(e.tangent(theta, One(0.5), One(-100)).stiffness[0] == 0);
  CHECK(e.tangent(theta, One(0.5), One(0)).stiffness[0] == 800);
  CHECK((e.regressor(One(-0.5), One(100)) == 0).all());
}

TEST_CASE("a coupled environment is a pair of matrices (3.30)") {
  const Coupled<2> e;
  Eigen::Array<double, 2, 4> theta;
  theta << 800, 100, 30, 5,  //
      50, 200, 2, 20;
  const Eigen::Array2d force = e.force(theta, {0.5, 0.25}, {0.125, -1});  // exact in binary
  CHECK(force[0] == 400 + 25 + 3.75 - 5);
  CHECK(force[1] == 25 + 50 + 0.25 - 20);
  CHECK((e.tangent(theta, {0, 0}, {0, 0}).stiffness == Eigen::Array2d{800, 200}).all());
  CHECK((e.tangent(theta, {0, 0}, {0, 0}).damping == Eigen::Array2d{30, 20}).all());
}

TEST_CASE("settings that no environment can have are refused") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(SmoothBilinear<1>({.depth = 0, .sharpness = 20}),
                       "SmoothBilinear: depth: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(SmoothBilinear<1>({.depth = 1, .sharpness = -1}),
                       "SmoothBilinear: sharpness: expected finite and > 0, got -1", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Exponential<1>({.growth = 0}), "Exponential: growth: expected finite and > 0, got 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Layered<3>({.depths = {0.5, 0.25}}),
                       "Layered: depths: expected finite, > 0 and ascending, got 0.25", std::invalid_argument);
  CHECK_THROWS_WITH_AS(HuntCrossley<1>({.exponent = 0.5}), "HuntCrossley: exponent: expected finite and >= 1, got 0.5",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((Fixed<Tangent<1>, 1>({.known = One(nan)})), "Fixed: known: expected finite, got nan",
                       std::invalid_argument);
}
