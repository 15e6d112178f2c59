// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/prediction/model_predictor.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <concepts>
#include <limits>

using limpid::ConstantGain;
using limpid::KelvinVoigt;
using limpid::Known;
using limpid::ModelPredictor;
using limpid::ScheduledGain;
using limpid::Status;
using limpid::Tool;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;
using Predictor = ModelPredictor<KelvinVoigt<1>, Tool<1>, Known>;

One one(double value) { return One::Constant(value); }

// At rest, with an error of -1 mm from 10 ms on.
Predictor with_error(double L1, double L2, double lost_beyond = 0.1) {
  Predictor predictor({.tool = {.mass = 0.1, .damping = 0.5, .stiffness = 200},
                       .theta = KelvinVoigt<1>::Theta(800, 1.5),
                       .gain = {L1, L2},
                       .lost_beyond = lost_beyond});
  for (int k = 0; k < 10; ++k) (void)predictor.advance(k * 1ms, one(0));
  REQUIRE(predictor.observe({{one(0.001), one(0), one(0), one(0)}, 5ms, 10ms}) == Status::ok);
  return predictor;
}

template <typename P>
concept TakesGain = requires(P predictor) {
  { predictor.replace_gain(ConstantGain<1>{}) } -> std::same_as<Status>;
};

}  // namespace

TEST_CASE("a new gain holds from the end of the next step on, as if it had been there from the first") {
  Predictor changed = with_error(-100, -2), other = with_error(-40, -1);
  REQUIRE(changed.replace_gain({-40.0, -1.0}) == Status::ok);
  for (int k = 10; k < 40; ++k) {
    CHECK((changed.advance(k * 1ms, one(1)).motion.x == other.advance(k * 1ms, one(1)).motion.x).all());
  }
}

TEST_CASE("a gain that comes while an error is held weighs that error") {
  Predictor predictor = with_error(0, 0);
  (void)predictor.advance(10ms, one(0));  // the sample is taken over: e_zd = -1 mm
  const double before = predictor.advance(11ms, one(0)).motion.a[0];
  REQUIRE(predictor.replace_gain({-100.0, -2.0}) == Status::ok);
  const auto after = predictor.advance(12ms, one(0)).motion;
  CHECK(before == 0);
  CHECK(after.x[0] == 0);                                                    // the step was still without feedback
  CHECK(after.a[0] == doctest::Approx(-100 * -0.001 / 0.1).epsilon(1e-14));  // L1 e / m_t
}

TEST_CASE("a gain that is not finite is not taken over") {
  Predictor predictor = with_error(-100, 0), same = with_error(-100, 0);
  (void)predictor.advance(10ms, one(0));
  (void)same.advance(10ms, one(0));
  CHECK(predictor.replace_gain({std::numeric_limits<double>::quiet_NaN(), 0.0}) == Status::not_finite);
  CHECK(predictor.replace_gain({0.0, std::numeric_limits<double>::infinity()}) == Status::not_finite);
  CHECK((predictor.advance(20ms, one(1)).motion.x == same.advance(20ms, one(1)).motion.x).all());
}

TEST_CASE("a gain that would make a force without bounds of the error that is held is not taken over") {
  Predictor predictor = with_error(0, 0, 1e11);
  REQUIRE(predictor.observe({{one(1e10), one(0), one(0), one(0)}, 9ms, 10ms}) == Status::ok);
  (void)predictor.advance(10ms, one(0));
  CHECK(predictor.replace_gain({1e300, 0.0}) == Status::not_finite);  // 1e300 * 1e10 / 0.1
  CHECK(predictor.replace_gain({1e200, 0.0}) == Status::ok);
}

TEST_CASE("a scheduled gain is not replaced: it would forget where its rate stood") {
  CHECK(TakesGain<Predictor>);
  CHECK_FALSE(TakesGain<ModelPredictor<KelvinVoigt<1>, Tool<1>, Known, ScheduledGain<1>>>);
}
