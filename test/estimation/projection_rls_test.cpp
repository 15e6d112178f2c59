// SPDX-License-Identifier: MIT
#include <estimation/press.hpp>
#include <limpid/estimation/projection_rls.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::ProjectionRLS;
using limpid::Status;
using limpid::test::force;
using limpid::test::Linear;
using limpid::test::linear_model;
using limpid::test::Pair;
using limpid::test::press;

TEST_CASE("exact data lead to the true parameters") {
  Linear rls(linear_model());
  const Pair truth(800, 33);
  press(rls, truth, 3);
  CHECK((rls.theta() - truth).abs().maxCoeff() < 1e-4);  // forgetting for 3 s leaves exp(-2 * 3 * 2) of the start
}

TEST_CASE("a parameter beyond the box is held on the face, and comes back from it") {
  Linear rls(linear_model());
  press(rls, Pair(2600, 30), 1);
  CHECK(rls.theta()(0) == 2000.0);
  CHECK(rls.update(0.001, Pair(0.01, 0), force(26)) == Status::at_bound);
  press(rls, Pair(1500, 30), 3);
  CHECK(rls.theta()(0) == doctest::Approx(1500).epsilon(1e-3));
}

TEST_CASE("axes do not feel each other, whether or not a lane is idle") {
  using Three = ProjectionRLS<2, 3>;
  auto box = [](double k, double b) { return (Three::Theta() << k, b, k, b, k, b).finished(); };
  Three rls({.lower = box(200, 20), .upper = box(2000, 40), .initial = box(1100, 30), .initial_gain = box(1e9, 8e6)});
  Linear alone(linear_model());
  for (int k = 0; k < 100; ++k) {
    Three::Regressor phi = Three::Regressor::Zero();
    phi.row(1) << 0.005 + 1e-5 * k, 0.01;
    (void)rls.update(0.001, phi, {0, 4, 0});
    (void)alone.update(0.001, phi.row(1), force(4));
  }
  // the same operations, of which a compiler may fuse others in lanes
  CHECK(rls.theta()(1, 0) == doctest::Approx(alone.theta()(0)).epsilon(1e-12));
  CHECK(rls.theta()(0, 0) == 1100);
  CHECK(rls.theta()(2, 1) == 30);
}

TEST_CASE("what is not finite, or does not advance, changes nothing") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Linear rls(linear_model());
  press(rls, Pair(800, 33), 0.1);
  const Pair theta = rls.theta();
  const auto gain = rls.gain(0);
  for (const double bad : {nan, inf, -inf}) {
    CHECK(rls.update(bad, Pair(0.01, 0.01), force(1)) == Status::not_finite);
    CHECK(rls.update(0.001, Pair(bad, 0.01), force(1)) == Status::not_finite);
    CHECK(rls.update(0.001, Pair(0.01, bad), force(1)) == Status::not_finite);
    CHECK(rls.update(0.001, Pair(0.01, 0.01), force(bad)) == Status::not_finite);
  }
  CHECK(rls.update(0.001, Pair(1e200, 0.01), force(1)) == Status::not_finite);  // its square is infinite
  CHECK(rls.update(0.001, Pair(1e150, 0.01), force(1)) == Status::not_finite);  // D would be as good as 0
  for (const double large : {1e160, 1.7e308, -1e160}) {                         // so are theirs; the box would hide it
    CHECK(rls.update(0.001, Pair(0.01, 0.01), force(large)) == Status::not_finite);
    CHECK(rls.update(0.001, Pair(0, 0), force(large)) == Status::not_finite);
    CHECK(rls.update(0.001, Pair(0.01, large), force(1)) == Status::not_finite);
  }
  CHECK(rls.update(0, Pair(0.01, 0.01), force(1)) == Status::clock_backwards);
  CHECK(rls.update(-0.001, Pair(0.01, 0.01), force(1)) == Status::clock_backwards);
  CHECK((rls.theta() == theta).all());
  CHECK(rls.gain(0) == gain);
}

// D at its floor beside a U of -1e22 was a gain of 1976 rho_M.
TEST_CASE("in float, a regressor that would take D below its floor changes nothing, and Gamma stays below its limit") {
  using Float = ProjectionRLS<2, 1, float>;
  const Float::Settings settings{
      .lower = {200, 20}, .upper = {2000, 40}, .initial = {1100, 30}, .initial_gain = {1e9F, 8e6F}, .normalisation = 0};
  Float rls(settings);
  CHECK(rls.update(0.001F, {0, 1e15F}, Float::Vector::Zero()) == Status::at_bound);  // D_2 8e6 to 1e-27
  CHECK(rls.update(0.001F, {0, 1e17F}, Float::Vector::Zero()) == Status::at_bound);  // to 1e-31, by its floor
  const auto before = rls.factors(0);
  CHECK(rls.update(0.001F, {1, 1e22F}, Float::Vector::Zero()) == Status::not_finite);  // to 1e-35, and U to -1e22
  const auto [U, D] = rls.factors(0);
  CHECK(U == before.U);
  CHECK(D == before.D);
  const double u = double(U(0, 1)), trace = double(D[0]) + double(D[1]) * (1 + u * u);  // of U D U', >= lambda_max
  CHECK(trace <= double(settings.gain_limit));
}

TEST_CASE("an update asks for no memory") {
  Linear rls(linear_model());
  limpid::test::check_no_allocation([&] {
    (void)rls.update(0.001, Pair(0.01, 0.1), force(8));  // short step
    (void)rls.update(10, Pair(0.01, 0.1), force(8));     // long step, by libm
    (void)rls.update(1, Pair(0, 0), force(0));           // at the gain's limit
    (void)rls.update(0.01, Pair(0.01, 0), force(1000));  // onto the box
    (void)rls.theta();
    (void)rls.gain(0);
  });
}

TEST_CASE("impossible settings are refused with their values") {
  const auto refused = [](auto change, const char* text) {
    auto settings = linear_model();
    change(settings);
    CHECK_THROWS_WITH_AS(Linear{settings}, text, std::invalid_argument);
  };
  refused([](auto& s) { s = {}; }, "ProjectionRLS: lower: expected finite, got nan nan");
  refused([](auto& s) { s.upper = Linear::Settings{}.upper; },
          "ProjectionRLS: upper: expected finite and >= lower, got nan nan");
  refused([](auto& s) { s.initial = Linear::Settings{}.initial; },
          "ProjectionRLS: initial: expected within lower and upper, got nan nan");
  refused([](auto& s) { s.initial_gain = Linear::Settings{}.initial_gain; },
          "ProjectionRLS: initial_gain: expected > 0 and <= gain_limit, got nan nan");
  refused([](auto& s) { s.lower(0) = -std::numeric_limits<double>::infinity(); },
          "ProjectionRLS: lower: expected finite, got -inf 20");
  refused([](auto& s) { s.upper(1) = 19; }, "ProjectionRLS: upper: expected finite and >= lower, got 2000 19");
  refused([](auto& s) { s.initial(0) = 100; }, "ProjectionRLS: initial: expected within lower and upper, got 100 30");
  refused([](auto& s) { s.initial_gain(1) = 0; },
          "ProjectionRLS: initial_gain: expected > 0 and <= gain_limit, got 1e+09 0");
  refused([](auto& s) { s.initial_gain(1) = 1e-292; },  // min / epsilon = 2^-1022 / 2^-52 = 2^-970
          "ProjectionRLS: initial_gain: expected >= 1.00208e-292 (the floor of the factors), got 1e+09 1e-292");
  refused([](auto& s) { s.gain_limit = 0; }, "ProjectionRLS: gain_limit: expected finite and > 0, got 0");
  // Gamma's trace is up to N rho_M, and its forgetting comes on top
  refused([](auto& s) { s.gain_limit = 1e308; },
          "ProjectionRLS: gain_limit: expected so far from the largest number that N gains add up, got 1e+308");
  refused([](auto& s) { s.forgetting = -1; }, "ProjectionRLS: forgetting: expected finite and >= 0, got -1");
  refused([](auto& s) { s.normalisation = 0.5; },
          "ProjectionRLS: normalisation: expected finite, >= 0 and < 1 / forgetting (else no excitation bounds the "
          "gain), got 0.5");
}
