// SPDX-License-Identifier: MIT
#include <limpid/control/passivity_controller.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using One = Eigen::Array<double, 1, 1>;
using Controller = PassivityController<1>;

// A mass with damping is thrown on a sampled wall, at x > 0, whose force is held; its free motion is exact. The
// controller sees the velocity as the backward difference of the position.
struct Bounce {
  double mass = 0.01, damping = 0.022, stiffness = 1000, period = 1e-3;
  double x = 0, v = 0.1;
  double seen_v = v;

  // One period under the force f, held.
  void move(double f) {
    const double h = period, before = x;
    if (damping > 0) {
      const double decay = std::exp(-damping * h / mass), g = (1 - decay) * mass / damping, s = (h - g) / damping;
      x += g * v - s * f;
      v = decay * v - g * f / mass;
    } else {
      x += h * v - h * h / 2 * f / mass;
      v -= h * f / mass;
    }
    seen_v = (x - before) / h;
  }
  [[nodiscard]] double wall() const { return x > 0 ? stiffness * x : 0; }
};

// Speed over that of the throw at the `tick`-th tick outside the wall after contact, counted from one.
double exit_ratio(Bounce scene, Controller controller, int tick) {
  const double thrown = scene.v;
  bool touched = false;
  for (int k = 0, outside = 0; k < 1000; ++k) {
    touched = touched || scene.x > 0;
    outside += touched && scene.x <= 0;
    if (outside == tick) return -scene.v / thrown;
    const Time now = k * from_seconds(scene.period);
    scene.move(controller.update(now, One(scene.wall()), One(scene.x), One(scene.seen_v)).force[0]);
  }
  return 0;
}

Controller with(EnergyPairing pairing, double largest_damping) {
  return Controller({.pairing = pairing, .largest_damping = largest_damping});
}

}  // namespace

TEST_CASE("the example of Hannaford and Ryu comes out as printed") {
  Controller controller({.pairing = EnergyPairing::same_tick, .largest_damping = infinity});
  const double f[] = {1, 2, -3, -2, 1, -1}, v[] = {.5, .25, .5, .5, .5, .25};
  const double W[] = {.5, 1, -.5, -1, .5, .25}, alpha[] = {0, 0, 2, 4, 0, 0}, f1[] = {1, 2, -2, 0, 1, -1};
  (void)controller.update(0s, One(0.0), One(0.0), One(0.0));  // starts the clock: a period has to be known
  for (int k = 0; k < 6; ++k) {
    CAPTURE(k);
    const auto out = controller.update((k + 1) * 1s, One(f[k]), One(0.0), One(v[k]));
    CHECK(out.energy == W[k]);  // all exact in binary
    CHECK(out.alpha == alpha[k]);
    CHECK(out.force[0] == f1[k]);
    CHECK(out.status == Status::ok);
  }
}

TEST_CASE("a bounce of the notes gains 1.261 by the classical pairing and keeps 0.983 by the held force") {
  // thrown at 0.1 m/s from the wall's face on a tick; the speed at the second tick outside, once the controller has
  // taken out what the last period inside let out
  CHECK(std::abs(exit_ratio({}, with(EnergyPairing::same_tick, infinity), 2) - 1.261) < 5e-4);
  CHECK(std::abs(exit_ratio({}, with(EnergyPairing::held_force, infinity), 2) - 0.983) < 5e-4);
}

TEST_CASE("whatever its speed and phase, a bounce lets no energy out, and by the classical pairing it does") {
  std::mt19937 random(20021018);
  std::uniform_real_distribution<double> speed(0.01, 2), phase(0, 1), stiffness(100, 2000), part(0.3, 1);
  for (int i = 0; i < 500; ++i) {
    Bounce scene{.damping = 0, .stiffness = stiffness(random), .v = speed(random)};
    scene.seen_v = scene.v;
    scene.x = -phase(random) * scene.v * scene.period;
    CAPTURE(scene.stiffness);
    CAPTURE(scene.v);
    CAPTURE(scene.x);
    const double m_over_T = scene.mass / scene.period;
    // a damper of up to m/T, held for a period, takes at least half of what it asks for: six ticks leave 1/64 of the
    // last period's energy, and the account gives back no more than came in
    CHECK(exit_ratio(scene, with(EnergyPairing::held_force, part(random) * m_over_T), 40) <= 1 + 1e-12);
    CHECK(exit_ratio(scene, with(EnergyPairing::same_tick, m_over_T), 40) > 1.02);
  }
}

TEST_CASE("with the held force the account is the work on the port, to the last tick") {
  Bounce scene;
  Controller controller = with(EnergyPairing::held_force, 10);
  double work = 0, force = 0, x = scene.x;
  for (int k = 0; k < 40; ++k) {
    work += force * (scene.x - x);
    x = scene.x;
    const auto out = controller.update(k * 1ms, One(scene.wall()), One(x), One(scene.seen_v));
    REQUIRE(std::abs(out.energy - work) < 1e-18);  // 40 roundings of energies below 5e-5 J
    force = out.force[0];
    scene.move(force);
  }
}

TEST_CASE("what the largest damping leaves stays owed, and is said") {
  Controller controller = with(EnergyPairing::held_force, 2);
  (void)controller.update(0s, One(-1.0), One(0.0), One(1.0));
  auto out = controller.update(1s, One(0.0), One(4.0), One(0.5));  // 4 J came out; alpha = 16 would take them
  CHECK(out.energy == -4);
  CHECK(out.alpha == 2);
  CHECK(out.force[0] == 1);
  CHECK(out.status == Status::at_bound);
  out = controller.update(2s, One(0.0), One(4.5), One(2.0));  // 1 N took 0.5 J of them
  CHECK(out.energy == -3.5);
  CHECK(out.alpha == 3.5 / 4);
  CHECK(out.status == Status::ok);
}

TEST_CASE("below its smallest speed nothing is dissipated and the debt is kept") {
  Controller controller({.largest_damping = 100, .smallest_speed = 0.1});
  (void)controller.update(0s, One(-1.0), One(0.0), One(0.0));
  const auto slow = controller.update(1s, One(0.0), One(1.0), One(0.05));
  CHECK(slow.alpha == 0);
  CHECK(slow.status == Status::at_bound);
  CHECK(controller.update(2s, One(0.0), One(1.0), One(0.0)).energy == -1);
  CHECK(controller.update(3s, One(0.0), One(1.0), One(0.2)).alpha == doctest::Approx(25));
}

TEST_CASE("energy above the bound of the store licenses nothing") {
  Controller controller({.largest_damping = 100, .most_stored = 1});
  (void)controller.update(0s, One(5.0), One(0.0), One(1.0));
  CHECK(controller.update(1s, One(-2.0), One(1.0), One(1.0)).energy == 1);  // 5 J went in
  const auto out = controller.update(2s, One(0.0), One(2.0), One(1.0));
  CHECK(out.energy == -1);
  CHECK(out.alpha == 1);
}

TEST_CASE("one account serves all axes, and the damper acts along the motion") {
  PassivityController<2> controller({.largest_damping = 100});
  (void)controller.update(0s, {-3, 1}, {0, 0}, {0, 0});
  const auto out = controller.update(1s, {0, 0}, {2, 1}, {1, -2});  // -6 + 1
  CHECK(out.energy == -5);
  CHECK(out.alpha == 1);
  CHECK((out.force == Eigen::Array2d{1, -2}).all());
}

TEST_CASE("the force that a limiter left is the one that counts") {
  Controller controller = with(EnergyPairing::held_force, 100);
  (void)controller.update(0s, One(-4.0), One(0.0), One(1.0));
  CHECK(controller.update(1s, One(0.0), One(1.0), One(1.0), One(-1.0)).energy == -1);
}

TEST_CASE("an input that is not finite, or a clock that stands, keeps the last answer and changes nothing") {
  Controller controller = with(EnergyPairing::held_force, 100), undisturbed = controller;
  for (auto* each : {&controller, &undisturbed}) {
    (void)each->update(0s, One(-1.0), One(0.0), One(1.0));
    (void)each->update(1s, One(0.0), One(1.0), One(1.0));
  }
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    const One wrong(bad), good(2.0);
    for (const auto& out : {controller.update(2s, wrong, good, good), controller.update(2s, good, wrong, good),
                            controller.update(2s, good, good, wrong), controller.update(2s, good, good, good, wrong)}) {
      CHECK(out.force[0] == 1);
      CHECK(out.status == Status::not_finite);
    }
  }
  CHECK(controller.update(1s, One(2.0), One(2.0), One(2.0)).status == Status::clock_backwards);
  const auto a = controller.update(3s, One(2.0), One(3.0), One(1.0));
  const auto b = undisturbed.update(3s, One(2.0), One(3.0), One(1.0));
  CHECK(a.energy == b.energy);
  CHECK(a.force[0] == b.force[0]);
}

TEST_CASE("after a reset nothing is owed and the next call is a first one") {
  Controller controller = with(EnergyPairing::held_force, 100);
  (void)controller.update(0s, One(-1.0), One(0.0), One(1.0));
  (void)controller.update(1s, One(-1.0), One(5.0), One(0.0));
  controller.reset();
  CHECK(controller.update(0s, One(1.0), One(50.0), One(1.0)).energy == 0);
}

TEST_CASE_TEMPLATE("every scalar takes the same path through a bounce", Scalar, float, long double) {
  using Vector = Eigen::Array<Scalar, 1, 1>;
  PassivityController<1, Scalar> controller({.largest_damping = Scalar(10)});
  (void)controller.update(0s, Vector(Scalar(-3)), Vector(Scalar(0)), Vector(Scalar(1)));
  const auto out = controller.update(1s, Vector(Scalar(0)), Vector(Scalar(1)), Vector(Scalar(1)));
  CHECK(out.alpha == Scalar(3));
}

TEST_CASE("no call allocates") {
  PassivityController<3> controller({.largest_damping = 10});
  test::check_no_allocation([&] {
    for (int k = 0; k < 10; ++k) {
      const Eigen::Array3d x = Eigen::Array3d::Constant(k * (k % 3 - 1));
      (void)controller.update(k * k * 1ms, {-1, 0.5, 2}, x, x);
    }
  });
}

TEST_CASE("settings that are absent or cannot serve are refused by name") {
  CHECK_THROWS_WITH_AS(Controller({}), "PassivityController: largest_damping: expected >= 0, got nan",
                       std::invalid_argument);
  CHECK_THROWS_AS(Controller({.largest_damping = 1, .smallest_speed = -1}), std::invalid_argument);
  CHECK_THROWS_AS(Controller({.largest_damping = 1, .most_stored = -1}), std::invalid_argument);
}

TEST_CASE("an infinite force that is said to be applied gives no credit") {
  Controller controller({.pairing = EnergyPairing::held_force, .largest_damping = 10, .most_stored = 1});
  (void)controller.update(0ms, One(0.0), One(0.0), One(1.0));
  const auto refused = controller.update(1ms, One(0.0), One(0.1), One(1.0), One(infinity));
  CHECK(refused.status == Status::not_finite);
  CHECK(refused.energy == 0);
  CHECK(controller.update(2ms, One(0.0), One(0.2), One(1.0), One(0.0)).energy == 0);
}
