// SPDX-License-Identifier: MIT
#include <limpid/environment/fixed.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/estimation/environment_estimator.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>

using limpid::EnvironmentEstimator;
using limpid::Held;
using limpid::KelvinVoigt;
using limpid::Status;
using limpid::Time;
using limpid::ToolState;
using namespace std::chrono_literals;

namespace {

using Linear = EnvironmentEstimator<KelvinVoigt<1>>;
using Pair = Linear::Law::Theta;
using One = Eigen::Array<double, 1, 1>;

Linear::Settings linear_model() {
  return {
      .environment = {},
      .law = {
          .lower = Pair(200, 20), .upper = Pair(2000, 40), .initial = Pair(1100, 30), .initial_gain = Pair(1e9, 8e6)}};
}

Held<ToolState<1>> held(double x, double v, double force, Time taken) {
  Held<ToolState<1>> sample;
  sample.value = {One::Constant(x), One::Constant(v), One::Zero(), One::Constant(force)};
  sample.taken = sample.arrived = taken;
  return sample;
}

}  // namespace

TEST_CASE("the law runs over each tick with the sample that was held before it") {
  Linear estimator(linear_model());
  Linear::Law law(linear_model().law);
  CHECK(estimator.update(1ms, held(0.01, 0.02, 9, 1ms)) == Status::ok);
  CHECK((estimator.estimate().theta_hat == Pair(1100, 30)).all());  // nothing was held before
  (void)estimator.update(3ms, held(0.02, -0.01, 15, 3ms));
  (void)law.update(0.002, Pair(0.01, 0.02), One::Constant(9));
  CHECK((estimator.estimate().theta_hat == law.theta()).all());
  (void)estimator.update(4ms, held(0.02, -0.01, 15, 3ms));
  (void)law.update(0.001, Pair(0.02, -0.01), One::Constant(15));
  CHECK((estimator.estimate().theta_hat == law.theta()).all());
  CHECK(estimator.estimate().stamp == 4ms);
}

TEST_CASE("before the first sample the estimate rests, and says so") {
  Linear estimator(linear_model());
  Held<ToolState<1>> nothing;
  nothing.status = Status::no_sample;
  for (int k = 1; k < 100; ++k) CHECK(estimator.update(k * 1ms, nothing) == Status::no_sample);
  CHECK(estimator.law().gain(0)(0, 0) == doctest::Approx(1e9).epsilon(1e-15));
}

// F = k x + 30 v + c: with b known, two parameters remain, and the known damping force is taken off.
TEST_CASE("a known parameter is not estimated, and its force is taken off") {
  using Model = limpid::Fixed<limpid::Tangent<1>, 1>;
  using Estimator = EnvironmentEstimator<Model>;
  static_assert(Estimator::parameters == 2);
  Estimator estimator({.environment = Model({.environment = {}, .known = One::Constant(30)}),
                       .law = {.lower = Pair(200, -55),
                               .upper = Pair(2000, 0),
                               .initial = Pair(1100, 0),
                               .initial_gain = Pair(1e9, 1e4),
                               .forgetting = 20}});
  for (int k = 0; k < 3000; ++k) {
    const double t = k * 1e-3, x = 0.01 * (1 - std::cos(M_PI * t)), v = 0.01 * M_PI * std::sin(M_PI * t);
    (void)estimator.update(k * 1ms, held(x, v, 700 * x + 30 * v - 1.5, k * 1ms));
  }
  CHECK(estimator.estimate().theta_hat(0) == doctest::Approx(700).epsilon(1e-6));  // forgotten by exp(-20 * 3)
  CHECK(estimator.estimate().theta_hat(1) == doctest::Approx(-1.5).epsilon(1e-6));
}

// A press of 10 mm once a second, out of the wall for half of it. While the tool leaves, inside the wall still but
// faster than the tissue follows, phi' theta would pull and the measured force is zero.
TEST_CASE("an estimator learns nothing while a one-sided contact is open") {
  using Wall = limpid::Unilateral<KelvinVoigt<1>>;
  const Wall wall({});
  const Pair truth(700, 33);
  EnvironmentEstimator<Wall> estimator({.environment = wall, .law = linear_model().law});
  for (int k = 0; k <= 5000; ++k) {
    const double t = k * 1e-3, x = 0.01 * std::sin(2 * M_PI * t), v = 0.02 * M_PI * std::cos(2 * M_PI * t);
    (void)estimator.update(k * 1ms, held(x, v, wall.force(truth, One::Constant(x), One::Constant(v))[0], k * 1ms));
  }
  CHECK(estimator.estimate().theta_hat(0) == doctest::Approx(700).epsilon(0.01));
  CHECK(estimator.estimate().theta_hat(1) == doctest::Approx(33).epsilon(0.01));
}

TEST_CASE("of several axes only those in contact learn") {
  using Wall = limpid::Unilateral<KelvinVoigt<2>>;
  using Estimator = EnvironmentEstimator<Wall>;
  const auto box = [](double k, double b) { return (Estimator::Law::Theta() << k, b, k, b).finished(); };
  Estimator estimator(
      {.environment = Wall({}),
       .law = {
           .lower = box(200, 20), .upper = box(2000, 40), .initial = box(1100, 30), .initial_gain = box(1e9, 8e6)}});
  Held<ToolState<2>> sample;
  sample.value = {{0.01, 0.01}, {-0.5, -0.5}, {0, 0}, {0, 1}};
  for (int k = 1; k < 10; ++k) (void)estimator.update(k * 1ms, sample);
  CHECK(estimator.estimate().theta_hat(0, 0) == 1100);
  CHECK(estimator.estimate().theta_hat(0, 1) == 30);
  CHECK(estimator.estimate().theta_hat(1, 0) != 1100);
  sample.taken = 10ms;
  sample.value.force[0] = -std::numeric_limits<double>::infinity();
  CHECK(estimator.update(10ms, sample) == Status::not_finite);
}

TEST_CASE("samples that are not finite are not taken over, and time that does not advance changes nothing") {
  Linear estimator(linear_model());
  (void)estimator.update(1ms, held(0.01, 0.02, 9, 1ms));
  (void)estimator.update(2ms, held(0.01, 0.02, 9, 1ms));
  Linear undisturbed = estimator;
  CHECK(estimator.update(2ms, held(0.02, 0, 9, 2ms)) == Status::clock_backwards);
  CHECK((estimator.estimate().theta_hat == undisturbed.estimate().theta_hat).all());
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Linear disturbed = undisturbed;
    CHECK(disturbed.update(3ms, held(bad, 0, 9, 3ms)) == Status::not_finite);
    CHECK(disturbed.update(4ms, held(0, bad, 9, 4ms)) == Status::not_finite);
    CHECK(disturbed.update(5ms, held(0, 0, bad, 5ms)) == Status::not_finite);
    Linear as_if_held = undisturbed;
    for (const Time now : {3ms, 4ms, 5ms}) (void)as_if_held.update(now, held(0.01, 0.02, 9, 1ms));
    CHECK((disturbed.estimate().theta_hat == as_if_held.estimate().theta_hat).all());
  }
}

TEST_CASE("a sample taken before the one that is held, or after the tick, is not taken over, and said so") {
  Linear estimator(linear_model());
  Linear::Law law(linear_model().law);
  const auto newest = held(0.01, 0.02, 9, 100ms);
  (void)estimator.update(100ms, newest);
  CHECK(estimator.update(101ms, held(0.02, 0.5, 1, 50ms)) == Status::out_of_order);
  CHECK(estimator.update(102ms, held(0.02, 0.5, 1, 102ms + 1ns)) == Status::out_of_order);
  CHECK(estimator.update(103ms, held(0.02, 0.5, 1, Time::max())) == Status::out_of_order);
  CHECK(estimator.update(104ms, newest) == Status::ok);
  for (int k = 0; k < 4; ++k) (void)law.update(0.001, Pair(0.01, 0.02), One::Constant(9));
  CHECK((estimator.estimate().theta_hat == law.theta()).all());

  Linear fresh(linear_model());
  CHECK(fresh.update(1ms, held(0.01, 0.02, 9, 2ms)) == Status::out_of_order);
  CHECK(fresh.update(2ms, held(0.01, 0.02, 9, 2ms)) == Status::ok);
}

// phi = 1e150 is finite, as is its square, but would take D below its floor.
TEST_CASE("while the law refuses the sample that is held every tick says so, and no axis learns") {
  using Estimator = EnvironmentEstimator<KelvinVoigt<2>>;
  const auto box = [](double k, double b) { return (Estimator::Law::Theta() << k, b, k, b).finished(); };
  const Estimator::Law::Settings law{
      .lower = box(200, 20), .upper = box(2000, 40), .initial = box(1100, 30), .initial_gain = box(1e9, 8e6)};
  Estimator estimator({.environment = {}, .law = law});
  Held<ToolState<2>> sample;
  sample.value = {{0.01, 1e150}, {0.02, 0}, {0, 0}, {9, 1}};
  sample.taken = 1ms;
  CHECK(estimator.update(1ms, sample) == Status::ok);
  for (const Time now : {2ms, 3ms}) {
    CHECK(estimator.update(now, sample) == Status::not_finite);
    CHECK((estimator.estimate().theta_hat == box(1100, 30)).all());
    CHECK(estimator.estimate().stamp == now);
  }
  sample.value.x[1] = 0.01;
  sample.taken = 4ms;
  CHECK(estimator.update(4ms, sample) == Status::not_finite);  // of the old one, up to here
  CHECK(estimator.update(5ms, sample) == Status::ok);
  Estimator::Law alone(law);
  (void)alone.update(0.001, (Estimator::Law::Regressor() << 0.01, 0.02, 0.01, 0).finished(), {9, 1});
  CHECK((estimator.estimate().theta_hat == alone.theta()).all());
}

TEST_CASE("a sample too large to be squared is not taken over") {
  Linear estimator(linear_model());
  (void)estimator.update(1ms, held(0.01, 0.02, 9, 1ms));
  CHECK(estimator.update(2ms, held(0.01, 0.02, 1e160, 2ms)) == Status::not_finite);
  CHECK(estimator.update(3ms, held(1e160, 0.02, 9, 3ms)) == Status::not_finite);
  CHECK(estimator.update(4ms, held(0.01, 0.02, 9, 4ms)) == Status::ok);  // the law went on with the first
}

TEST_CASE("an update asks for no memory") {
  Linear estimator(linear_model());
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 10; ++k) (void)estimator.update(k * 1ms, held(0.01, 0.001 * k, 9, k * 1ms));
  });
}
