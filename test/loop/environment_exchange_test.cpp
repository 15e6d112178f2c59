// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/loop/realtime/environment_link.hpp>
#include <limpid/loop/realtime/slow_environment.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

using Exchange = EnvironmentExchange<1>;
using Force = Exchange::Vector;

// Its position is the newest force; it keeps them all.
struct Recorder {
  struct Output {
    ToolState<1> value;
    Status status;
  };
  std::vector<std::pair<Time, double>>* forces;

  [[nodiscard]] Output advance(Time now, const Force& F_h) const {
    forces->emplace_back(now, F_h[0]);
    return {{.x = F_h}, std::isfinite(F_h[0]) ? Status::ok : Status::not_finite};
  }
};

// A loop at 1 kHz whose force at k ms is k N, with a slow environment that steps when it wants to.
struct Scene {
  Exchange exchange{};
  std::vector<std::pair<Time, double>> forces{};
  EnvironmentLink<Exchange> link;
  SlowEnvironment<Exchange, Recorder> slow;
  Time wakes{};

  explicit Scene(const SlowEnvironmentSettings& settings)
      : link{exchange, {.longest_age = 100ms}}, slow{exchange, Recorder{&forces}, settings} {}

  // The tick at k ms, after which the environment may step.
  Held<ToolState<1>> tick(int k) {
    const Time now = k * 1ms;
    CHECK(link.send(now, Force(static_cast<double>(k))) == Status::ok);
    const Held<ToolState<1>> seen = link.read(now);
    if (now >= wakes) wakes = slow.step(now);
    return seen;
  }
};

}  // namespace

TEST_CASE("the environment gets all forces since its last step, in order") {
  Scene scene({.period = 16ms});
  for (int k = 0; k <= 48; ++k) scene.tick(k);
  REQUIRE(scene.forces.size() == 49);
  for (std::size_t k = 0; k < 49; ++k) {
    CHECK(scene.forces[k].first == k * 1ms);
    CHECK(scene.forces[k].second == static_cast<double>(k));
  }
}

TEST_CASE("samples are seen a delay after they were taken, each once, with their instants") {
  Scene scene({.period = 16ms, .delay = 20ms});
  for (int k = 0; k <= 100; ++k) {
    CAPTURE(k);
    const auto seen = scene.tick(k);
    // taken at 0, 16, ... after the loop has read, handed on 20 ms later, again after the loop has read
    const bool arrives = k >= 21 && (k - 21) % 16 == 0;
    CHECK(seen.fresh == arrives);
    if (k < 21) {
      CHECK(seen.status == Status::no_sample);
      continue;
    }
    const int taken = (k - 21) / 16 * 16;
    CHECK(seen.status == Status::ok);
    CHECK(seen.taken == taken * 1ms);
    CHECK(seen.arrived == (taken + 21) * 1ms);
    CHECK(seen.value.x[0] == taken);
  }
}

TEST_CASE("a delay of many periods keeps as many samples on their way") {
  Scene scene({.period = 1ms, .delay = 63ms + 999us});
  for (int k = 0; k <= 300; ++k) {
    const auto seen = scene.tick(k);
    if (k >= 65) CHECK(seen.taken == (k - 65) * 1ms);
  }
}

TEST_CASE("an environment that wakes late takes what has come meanwhile, and stays on its grid") {
  std::vector<std::pair<Time, double>> forces;
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 1s});
  SlowEnvironment slow(exchange, Recorder{&forces}, {.period = 10ms});
  (void)link.send(0ms, Force(0.0));
  CHECK(slow.step(0ms) == 10ms);
  for (int k = 1; k <= 37; ++k) (void)link.send(k * 1ms, Force(0.0));
  CHECK(slow.step(37ms) == 40ms);
  CHECK(forces.size() == 38);
  CHECK(link.read(38ms).taken == 37ms);
}

TEST_CASE("where no force has come there is no sample, and what is held grows stale") {
  Scene scene({.period = 16ms});
  for (int k = 0; k <= 16; ++k) scene.tick(k);
  CHECK(scene.link.read(17ms).taken == 16ms);
  for (int k = 20; k < 200; ++k) (void)scene.slow.step(k * 1ms);
  const auto& seen = scene.link.read(116ms);
  CHECK(seen.status == Status::ok);
  CHECK(seen.taken == 16ms);
  CHECK(scene.link.read(116ms + 1ns).status == Status::stale);
}

TEST_CASE("without any sample the link is stale so long after the first read") {
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 100ms});
  CHECK(link.read(1s).status == Status::no_sample);
  CHECK(link.read(1100ms).status == Status::no_sample);
  CHECK(link.read(1101ms).status == (Status::no_sample | Status::stale));
}

TEST_CASE("forces that are more than there is room for are lost, and it is said; the newest are there") {
  std::vector<std::pair<Time, double>> forces;
  EnvironmentExchange<1, double, 8> exchange;
  EnvironmentLink link(exchange, {.longest_age = 1s});
  SlowEnvironment slow(exchange, Recorder{&forces}, {.period = 10ms});
  for (int k = 0; k < 20; ++k) (void)link.send(k * 1ms, Force(0.0));
  (void)slow.step(20ms);
  CHECK(slow.status() == Status::overflow);
  REQUIRE(forces.size() == 8);
  CHECK(forces.front().first == 12ms);
  CHECK(forces.back().first == 19ms);
}

TEST_CASE("an environment that comes later begins with the newest force") {
  std::vector<std::pair<Time, double>> forces;
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 1s});
  for (int k = 0; k < 20; ++k) (void)link.send(k * 1ms, Force(0.0));
  SlowEnvironment slow(exchange, Recorder{&forces}, {.period = 10ms});
  (void)slow.step(20ms);
  REQUIRE(forces.size() == 1);
  CHECK(forces.front().first == 19ms);
  CHECK(slow.status() == Status::ok);
}

TEST_CASE("a force that is not finite or not later than the last one is not sent") {
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 1s});
  CHECK(link.send(1ms, Force(std::numeric_limits<double>::quiet_NaN())) == Status::not_finite);
  CHECK(link.send(1ms, Force(1.0)) == Status::ok);
  CHECK(link.send(1ms, Force(1.0)) == Status::clock_backwards);
  CHECK(exchange.forces.written() == 1);
}

TEST_CASE("samples that cannot be are dropped, and what is held stays") {
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 1s});
  EnvironmentEnd end(exchange);
  end.publish(10ms, {.x = Force(1.0)});
  CHECK(link.read(20ms).status == Status::ok);
  end.publish(10ms, {.x = Force(2.0)});
  CHECK(link.read(21ms).status == Status::out_of_order);
  end.publish(23ms, {.x = Force(3.0)});
  CHECK(link.read(22ms).status == Status::clock_backwards);
  end.publish(20ms, {.force = Force(std::numeric_limits<double>::infinity())});
  CHECK(link.read(23ms).status == Status::not_finite);
  const auto& seen = link.read(24ms);
  CHECK(seen.status == Status::ok);
  CHECK(!seen.fresh);
  CHECK(seen.value.x[0] == 1);
  CHECK(seen.taken == 10ms);
}

TEST_CASE("three axes of float come through as they are") {
  using Float3 = EnvironmentExchange<3, float>;
  Float3 exchange;
  EnvironmentLink link(exchange, {.longest_age = 1s});
  EnvironmentEnd end(exchange);
  (void)link.send(1ms, {1, 2, 3});
  Float3::Vector force = Float3::Vector::Zero();
  end.forces([&](Time, const Float3::Vector& F_h) noexcept { force = F_h; });
  CHECK((force == Float3::Vector(1, 2, 3)).all());
  end.publish(1ms, {.x = {1, 2, 3}, .v = {4, 5, 6}, .a = {7, 8, 9}, .force = {10, 11, 12}});
  const auto& seen = link.read(2ms).value;
  CHECK((seen.x == Float3::Vector(1, 2, 3)).all());
  CHECK((seen.v == Float3::Vector(4, 5, 6)).all());
  CHECK((seen.a == Float3::Vector(7, 8, 9)).all());
  CHECK((seen.force == Float3::Vector(10, 11, 12)).all());
}

TEST_CASE("settings that cannot serve an exchange are refused") {
  Exchange exchange;
  CHECK_THROWS_WITH_AS(EnvironmentLink(exchange, {}), "EnvironmentLink: longest_age: expected > 0 s, got 0 s",
                       std::invalid_argument);
  const auto slow = [&](const SlowEnvironmentSettings& settings) {
    SlowEnvironment(exchange, Recorder{nullptr}, settings);
  };
  CHECK_THROWS_AS(slow({}), std::invalid_argument);
  CHECK_THROWS_AS(slow({.period = 1ms, .delay = -1ms}), std::invalid_argument);
  CHECK_THROWS_AS(slow({.period = 1ms, .delay = 64ms}), std::invalid_argument);
}

TEST_CASE("a tick of either side does not allocate") {
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 1s});
  SlowEnvironment slow(exchange, VirtualTool<KelvinVoigt<1>>({.theta = {800, 30}, .tool = {.mass = 0.1}}),
                       {.period = 16ms, .delay = 20ms});
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 100; ++k) {
      (void)link.send(k * 1ms, Force(1.0));
      (void)link.read(k * 1ms);
      (void)slow.step(k * 1ms);
    }
  });
}

TEST_CASE("on a thread of its own the tool is where the same forces bring one that is not slow") {
  const VirtualTool<KelvinVoigt<1>> tool({.theta = {800, 30}, .tool = {.mass = 0.1, .damping = 0.1}});
  const auto force = [](int k) { return Force(1 - std::cos(0.06 * k)); };
  VirtualTool<KelvinVoigt<1>> truth = tool;
  Exchange exchange;
  EnvironmentLink link(exchange, {.longest_age = 1h});
  SlowEnvironment slow(exchange, tool, {.period = 1ms});
  const std::jthread thread = slow.start();
  std::vector<double> x;
  int seen = 0, wrong = 0, newest = -1;
  for (int k = 0; k < 1000; ++k) {
    const Time now = k * 1ms;
    x.push_back(truth.advance(now, force(k)).value.x[0]);
    (void)link.send(now, force(k));
    do {  // however slow the machine is, no force is lost, and the last one is seen
      const auto& held = link.read(now);
      if (!held.fresh) continue;
      ++seen;
      newest = static_cast<int>(held.taken / 1ms);
      wrong += held.value.x[0] == x.at(static_cast<std::size_t>(newest)) ? 0 : 1;
    } while (k - newest > 500 || (k == 999 && newest < k));
  }
  CHECK(seen > 1);
  CHECK(wrong == 0);
}
