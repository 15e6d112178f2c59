// SPDX-License-Identifier: MIT
#include <limpid/control/disturbance_observer.hpp>
#include <support/disturbance_observer.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <type_traits>

using namespace limpid;
using namespace limpid::test;
using namespace std::chrono_literals;

TEST_CASE_TEMPLATE("an estimate at rest stays at rest when the ticks change", Q, FirstOrderQ<>, ButterworthQ<>,
                   UmenoHoriQ<>) {
  for (const auto form : observer_forms) {
    CAPTURE(static_cast<int>(form));
    auto observer = observer_of<Q, 2>(50, form);
    using Vector = typename decltype(observer)::Vector;
    const Vector v(0.3, -0.2), hand(0.5, 0.1), disturbance(0.7, -0.4);
    const Vector force = 0.022 * v + disturbance - hand;
    Time now{};
    for (int k = 0; k < 400; ++k) {
      now += k < 300 ? Time(1ms) : Time(300us + k % 7 * 400us);
      const auto output = tick(observer, now, Vector(force - disturbance), hand, v, force);
      if (k > 300) REQUIRE((output.disturbance - disturbance).abs().maxCoeff() < 1e-12);
    }
  }
}

TEST_CASE("it starts at rest with what moves at that moment, and again after a long pause with its estimate") {
  auto observer = observer_of<UmenoHoriQ<>>(50);
  using Vector = decltype(observer)::Vector;
  const Vector v(0.3), force(0.022 * 0.3);
  for (int k = 0; k < 20; ++k) {
    const auto output = tick(observer, k * 1ms, force, Vector(0.0), v, force);
    REQUIRE(std::abs(output.disturbance[0]) < 1e-15);
  }
  const double before = tick(observer, 20ms, Vector(1.0), Vector(0.0), v, force).disturbance[0];
  CHECK(before != 0);
  const auto after = tick(observer, 20s, Vector(2.0), Vector(0.0), v, Vector(99.0));
  CHECK(after.disturbance[0] == before);
  CHECK(after.force[0] == 2 + before);
  const auto next = tick(observer, 20s + 1ms, Vector(2.0), Vector(0.0), v, Vector(force + before));
  CHECK(std::isfinite(next.force[0]));
}

// A disturbance of -3 N on a device that can give 1 N, held still by it for a second and then let go.
TEST_CASE("told of what was applied it does not wind up, told of what was asked it does") {
  const auto estimate = [](bool truth) {
    auto observer = observer_of<FirstOrderQ<>>(20);
    using Vector = decltype(observer)::Vector;
    Vector applied(0.0), asked(0.0);
    for (int k = 0; k < 1000; ++k) {
      asked = tick(observer, k * 1ms, Vector(1.5), Vector(0.0), Vector(0.0), truth ? applied : asked).force;
      applied = asked.min(1.0);
    }
    return asked[0] - 1.5;
  };
  // what is applied, 1 N, and of the force that is about to be, Q's direct part: told the truth it ends between
  CHECK(estimate(true) < 1.2);
  CHECK(estimate(true) > 0.99);
  CHECK(estimate(false) > 100);
}

TEST_CASE("a value that is not finite changes nothing, and the force is the command with the last estimate") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max()}) {
    for (const Time late : {Time(1ms), Time(2ms)}) {  // of the same length as the tick before, and of another
      for (int which = 0; which < 4; ++which) {
        CAPTURE(bad);
        CAPTURE(which);
        auto observer = observer_of<FirstOrderQ<>, 2>(50), undisturbed = observer;
        using Vector = decltype(observer)::Vector;
        Vector good(0.1, -0.2), broken(0.1, bad);
        typename decltype(observer)::Output last;
        for (auto* each : {&observer, &undisturbed}) {
          for (int k = 0; k < 3; ++k) last = tick(*each, k * 1ms, good, good, good, good);
        }
        const auto at = [&](int i) { return which == i ? broken : good; };
        const auto output = tick(observer, 2ms + late, at(0), at(1), at(2), at(3));
        CHECK(output.force.allFinite());
        if (!std::isfinite(bad)) {
          CHECK(has(output.status, Status::not_finite));
          CHECK((output.disturbance == last.disturbance).all());
          CHECK((output.force == (which == 0 ? last.force : Vector(good + last.disturbance))).all());
          const auto next = tick(observer, 5ms, good, good, good, good);
          CHECK((next.force == tick(undisturbed, 5ms, good, good, good, good).force).all());
          CHECK(next.status == Status::ok);
        }
      }
    }
  }
}

TEST_CASE("a command that is refused at a tick of another length leaves the state for the call that follows") {
  auto observer = observer_of<FirstOrderQ<>>(50);
  using Vector = decltype(observer)::Vector;
  const Vector good(0.3), none(0.0), bad(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 3; ++k) (void)tick(observer, k * 1ms, good, good, good, good);
  auto undisturbed = observer;
  CHECK(tick(observer, 5ms, bad, good, good, good).status == Status::not_finite);
  CHECK(tick(observer, 5ms, good, good, good, none).force[0] ==
        tick(undisturbed, 5ms, good, good, good, none).force[0]);
}

TEST_CASE("a call that is refused for a velocity beyond its range leaves no trace of what was applied") {
  using Observer = DisturbanceObserver<ButterworthQ<>>;
  using Vector = Observer::Vector;
  const Vector one(1.0), none(0.0), huge(1.7e308);
  // the step-invariant form takes a velocity in one tick later
  for (const auto form : {ObserverForm::tustin, ObserverForm::backward_euler}) {
    CAPTURE(static_cast<int>(form));
    Observer observer({.filter = {.cutoff = 50}, .mass = Vector(0.1), .damping = Vector(0.5), .form = form});
    for (int k = 0; k <= 50; ++k) (void)tick(observer, k * 1ms, one, none, none, one);
    Observer undisturbed = observer;
    CHECK(tick(observer, 50ms + 400us, one, none, huge, Vector(3.0)).status == Status::not_finite);
    for (const Time now : {Time(51ms), Time(52ms), Time(52ms + 300us)}) {
      const auto after = tick(observer, now, one, none, none, one);
      const auto without = tick(undisturbed, now, one, none, none, one);
      CHECK(after.force[0] == without.force[0]);
      CHECK(after.disturbance[0] == without.disturbance[0]);
    }
  }
}

TEST_CASE("a first call that is not finite does not start it, a clock that stands changes nothing") {
  auto observer = observer_of<ButterworthQ<>>(50), undisturbed = observer;
  using Vector = decltype(observer)::Vector;
  const Vector bad(std::numeric_limits<double>::quiet_NaN()), some(0.25);
  const auto first = tick(observer, 0ms, some, bad, some, some);
  CHECK(first.force[0] == 0.25);
  CHECK(first.status == Status::not_finite);
  for (auto* each : {&observer, &undisturbed}) {
    (void)tick(*each, 5ms, some, some, some, some);
    (void)tick(*each, 6ms, some, some, some, some);
  }
  const auto stale = tick(observer, 6ms, some, Vector(7.0), Vector(8.0), Vector(9.0));
  CHECK(stale.status == Status::clock_backwards);
  CHECK((tick(observer, 7ms, some, some, some, some).force == tick(undisturbed, 7ms, some, some, some, some).force)
            .all());
}

TEST_CASE_TEMPLATE("no call allocates, of equal or other length", Q, FirstOrderQ<>, ButterworthQ<float>,
                   UmenoHoriQ<long double>) {
  for (const auto form : observer_forms) {
    auto observer = observer_of<Q, 3>(50, form);
    using Vector = typename decltype(observer)::Vector;
    using Scalar = QFilterScalar<Q>;
    const Vector some = Vector::Constant(Scalar(0.25)), bad = some / Scalar(0);
    test::check_no_allocation([&] {
      for (int k = 0; k < 10; ++k) (void)tick(observer, k * k * 1ms, some, some, some, k == 5 ? bad : some);
      for (int k = 0; k < 10; ++k) (void)tick(observer, 1s + k * 1ms, some, some, some, some);
    });
  }
}

TEST_CASE("settings that cannot serve are refused, and the hand has no default") {
  using Observer = DisturbanceObserver<FirstOrderQ<>, 2>;
  static_assert(!std::is_default_constructible_v<Observer::OperatorForce>);
  static_assert(!std::is_convertible_v<Observer::Vector, Observer::OperatorForce>);
  static_assert(!std::is_default_constructible_v<Observer::AppliedForce>);
  Observer::Settings settings{.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {0, 0}};
  CHECK_NOTHROW(Observer{settings});
  settings.mass[1] = 0;
  CHECK_THROWS_WITH_AS(Observer{settings}, "DisturbanceObserver: mass: expected finite and > 0, got 0.01 0",
                       std::invalid_argument);
  settings = {.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {-1, 0}};
  CHECK_THROWS_AS(Observer{settings}, std::invalid_argument);
  settings = {.filter = {.cutoff = -50}, .mass = {0.01, 0.02}, .damping = {0, 0}};
  CHECK_THROWS_AS(Observer{settings}, std::invalid_argument);
  settings = {.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {0, 0}, .longest_step = 0ms};
  CHECK_THROWS_WITH_AS(Observer{settings}, "DisturbanceObserver: longest_step: expected > 0 s, got 0 s",
                       std::invalid_argument);
  settings = {.filter = {.cutoff = 1e17}, .mass = {0.01, 0.02}, .damping = {0, 0}};  // 1 - q_0 would be 0
  CHECK_THROWS_AS(Observer{settings}, std::invalid_argument);
  settings = {.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {0, 1.7e308}};
  CHECK_THROWS_WITH_AS(Observer{settings},
                       "DisturbanceObserver: damping: expected small enough to be squared, got 0 1.7e+308",
                       std::invalid_argument);
  settings = {.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {0, 0}, .form = static_cast<ObserverForm>(7)};
  CHECK_THROWS_WITH_AS(Observer{settings}, "DisturbanceObserver: form: expected one of ObserverForm, got 7",
                       std::invalid_argument);
}
