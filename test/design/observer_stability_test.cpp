// SPDX-License-Identifier: MIT
#include "eigen_instances.hpp"

#include <limpid/control/disturbance_observer.hpp>
#include <limpid/design/observer_stability.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace limpid;
using namespace std::chrono_literals;
using limpid::test::largest_entry;
using limpid::test::maximum;

namespace {

// The five-bar of the notes at the tip (0.08, 0.22), with its nominal plant.
template <Real Scalar>
ObservedPlant<2, Scalar> five_bar() {
  const auto micro = [](int number) { return Scalar(number) / Scalar(1'000'000); };
  ObservedPlant<2, Scalar> plant;
  plant.M << micro(14848), micro(-2748), micro(-2748), micro(7662);
  plant.B << micro(45845), micro(-11546), micro(-11546), micro(14866);
  plant.mass.setConstant(micro(10000));
  plant.damping.setConstant(micro(22000));
  return plant;
}

template <typename Q>
double limit(ObserverForm form) {
  return observer_cutoff_limit(five_bar<double>(), Q{.cutoff = 1}, form).cutoff;
}

}  // namespace

TEST_CASE("the limits of the notes' five-bar by Tustin's rule are theirs to 0.1 Hz") {
  CHECK(std::abs(limit<FirstOrderQ<>>(ObserverForm::tustin) - 214.27) < 0.05);
  CHECK(std::abs(limit<ButterworthQ<>>(ObserverForm::tustin) - 302.97) < 0.05);
  CHECK(std::abs(limit<UmenoHoriQ<>>(ObserverForm::tustin) - 184.71) < 0.05);
}

TEST_CASE("the closed form is the limit of first order by Tustin's rule") {
  const auto plant = five_bar<double>();
  const double closed = first_order_cutoff_limit(plant);
  CHECK(std::abs(closed - 214.27) < 0.05);
  // what damping adds, as told: (5.0 * .001/2)^2/3 = 2e-6; roots are told from 1 to sqrt(epsilon)
  const double searched = limit<FirstOrderQ<>>(ObserverForm::tustin);
  CHECK(searched >= closed * (1 - 1e-7));
  CHECK(searched <= closed * (1 + 3e-6));
}

TEST_CASE("the closed form is the limit for random plants of two axes") {
  constexpr unsigned seed = 20260101;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 10; ++i) {
    CAPTURE(i);
    ObservedPlant<2> plant;
    const Eigen::Matrix2d R = Eigen::Matrix2d::NullaryExpr([&] { return part(random); });
    const Eigen::Matrix2d M = 0.01 * (R * R.transpose() + Eigen::Matrix2d::Identity());
    plant.M = (M + M.transpose()) / 2;
    plant.B.setZero();
    plant.mass << 0.01, 0.02;
    plant.damping.setConstant(0.02);
    const auto searched = observer_cutoff_limit(plant, FirstOrderQ<>{.cutoff = 1}, ObserverForm::tustin);
    REQUIRE(searched.found());
    CHECK(searched.cutoff == doctest::Approx(first_order_cutoff_limit(plant)).epsilon(1e-4));
  }
}

TEST_CASE("the limit does not depend on the cut-off of the filter that is given, and scales with the rate") {
  auto plant = five_bar<double>();
  plant.B.setZero();
  plant.damping.setZero();
  const double at_1_kHz = observer_cutoff_limit(plant, UmenoHoriQ<>{.cutoff = 7}, ObserverForm::tustin).cutoff;
  plant.period = 2.5e-4;
  const double at_4_kHz = observer_cutoff_limit(plant, UmenoHoriQ<>{.cutoff = 900}, ObserverForm::tustin).cutoff;
  CHECK(at_4_kHz == doctest::Approx(4 * at_1_kHz).epsilon(1e-6));
}

// Beside the limit, the observer itself on the plant: 1 % below a disturbed start dies away, 1 % above it grows.
TEST_CASE_TEMPLATE("an observer in closed loop decays below its limit and grows above it", Q, FirstOrderQ<>,
                   ButterworthQ<>, UmenoHoriQ<>) {
  using Observer = DisturbanceObserver<Q, 2>;
  using Vector = typename Observer::Vector;
  const auto plant = five_bar<double>();
  const auto step = held_step(Eigen::Matrix2d(-plant.M.inverse() * plant.B), 1e-3);
  const Eigen::Matrix2d Gamma = step.Psi * plant.M.inverse();
  for (const auto form : {ObserverForm::tustin, ObserverForm::step_invariant, ObserverForm::backward_euler}) {
    CAPTURE(static_cast<int>(form));
    const auto limit = observer_cutoff_limit(plant, Q{.cutoff = 1}, form);
    REQUIRE(limit.found());
    for (const double factor : {0.98, 1.02}) {
      CAPTURE(factor);
      Observer observer(
          {.filter = {.cutoff = limit.cutoff * factor}, .mass = plant.mass, .damping = plant.damping, .form = form});
      Eigen::Vector2d v{0, 0};
      Vector F = Vector::Zero();
      const typename Observer::OperatorForce none(Vector::Zero());
      double early = 0, late = 0;
      for (int k = 0; k < 4000; ++k) {
        const Vector command = Vector(1e-6, -2e-6) * (k == 1);
        F = observer.update(k * 1ms, command, none, v.array(), typename Observer::AppliedForce(F)).force;
        if (k >= 1000 && k < 1500) early = maximum(early, largest_entry(F));
        if (k >= 3500) late = maximum(late, largest_entry(F));
        v = step.Phi * v + Gamma * F.matrix();
        if (!v.allFinite()) break;
      }
      CHECK((late > early || !v.allFinite()) == (factor > 1));
    }
  }
}

TEST_CASE("a plant that is unstable, and one that stays stable, are told apart from a limit") {
  auto plant = five_bar<double>();
  plant.M *= 100;  // far heavier than nominal: first order by Tustin is stable up to 21 kHz
  const auto high = observer_cutoff_limit(plant, FirstOrderQ<>{.cutoff = 1}, ObserverForm::tustin);
  CHECK_FALSE(high.found());
  CHECK(std::isinf(high.cutoff));
  plant = five_bar<double>();
  plant.B = -100 * Eigen::Matrix2d::Identity();
  const auto low = observer_cutoff_limit(plant, FirstOrderQ<>{.cutoff = 1}, ObserverForm::tustin);
  CHECK_FALSE(low.found());
  CHECK(low.cutoff == 0);
  CHECK(low.reason == "the lowest cut-off is unstable");
}

TEST_CASE("plants and cut-offs that cannot be are refused") {
  auto plant = five_bar<double>();
  plant.M(0, 1) = 1;
  CHECK_THROWS_WITH_AS(
      (void)first_order_cutoff_limit(plant),
      "ObservedPlant: M: expected finite, symmetric and positive definite, got 0.014848 -0.002748 1 0.007662",
      std::invalid_argument);
  plant = five_bar<double>();
  plant.mass[1] = 0;
  CHECK_THROWS_AS((void)limpid::observer_cutoff_limit(plant, FirstOrderQ<>{.cutoff = 1}, ObserverForm::tustin),
                  std::invalid_argument);
  CHECK_THROWS_AS((void)observed_radius(five_bar<double>(), FirstOrderQ<>{.cutoff = 1}, ObserverForm::tustin, 0.0),
                  std::invalid_argument);
}
