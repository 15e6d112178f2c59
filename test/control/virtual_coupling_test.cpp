// SPDX-License-Identifier: MIT
#include <limpid/control/virtual_coupling.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <limits>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

using Coupling = VirtualCoupling<2>;

Coupling coupling() { return Coupling({.stiffness = {200, 100}, .damping = {0.5, 0.25}}); }

}  // namespace

TEST_CASE("the forces are those of spring and damper, equal and opposite") {
  Coupling pair = coupling();
  const auto out = pair.update(0ms, {{0.5, 0.25}, {1, 2}}, {{0.25, 0.5}, {-1, 0}});
  CHECK((out.on_tool == Eigen::Array2d{200 * 0.25 + 0.5 * 2, -100 * 0.25 + 0.25 * 2}).all());  // exact in binary
  CHECK((out.on_device == -out.on_tool).all());
  CHECK(out.status == Status::ok);
}

TEST_CASE("positions alone give Z_c = B_c + K_c T z/(z - 1): the damper has the backward difference") {
  Coupling pair = coupling();
  CHECK((pair.update_positions(0ms, {0.5, 0.5}, {0, 0}).on_tool == Eigen::Array2d{100, 50}).all());
  const auto out = pair.update_positions(500ms, {0.75, 0.25}, {0, 0});
  CHECK((out.on_tool == Eigen::Array2d{150 + 0.5 * 0.5, 25 - 0.25 * 0.5}).all());
}

TEST_CASE("an input that is not finite keeps the last forces and changes nothing") {
  Coupling pair = coupling(), undisturbed = coupling();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (auto* each : {&pair, &undisturbed}) (void)each->update_positions(0ms, {0.5, 0.5}, {0, 0});
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    const auto out = pair.update_positions(1ms, {0.25, bad}, {0, 0});
    CHECK((out.on_tool == Eigen::Array2d{100, 50}).all());
    CHECK(out.status == Status::not_finite);
    CHECK(pair.update(1ms, {{0, 0}, {0, 0}}, {{0, 0}, {bad, 0}}).status == Status::not_finite);
  }
  CHECK(
      (pair.update_positions(2ms, {1, 1}, {0, 0}).on_tool == undisturbed.update_positions(2ms, {1, 1}, {0, 0}).on_tool)
          .all());
}

TEST_CASE("an input that is not finite is seen even by a coupling without stiffness and damping") {
  Coupling pair({.stiffness = {0, 0}, .damping = {0, 0}});
  CHECK(pair.update_positions(0ms, {std::numeric_limits<double>::infinity(), 0}, {0, 0}).status == Status::not_finite);
}

TEST_CASE("a clock that does not advance keeps the last forces, and after a reset the next call is a first one") {
  Coupling pair = coupling();
  (void)pair.update_positions(2ms, {0.5, 0.5}, {0, 0});
  CHECK(pair.update_positions(2ms, {1, 1}, {0, 0}).status == Status::clock_backwards);
  CHECK((pair.update(1ms, {{1, 1}, {0, 0}}, {}).on_tool == Eigen::Array2d{100, 50}).all());
  pair.reset();
  CHECK((pair.update_positions(1ms, {1, 1}, {0, 0}).on_tool == Eigen::Array2d{200, 100}).all());
}

TEST_CASE("no call allocates") {
  Coupling pair = coupling();
  test::check_no_allocation([&] {
    for (int k = 0; k < 10; ++k) {
      (void)pair.update_positions(2 * k * 1ms, {0.5, 0.25}, {0, 0});
      (void)pair.update((2 * k + 1) * 1ms, {{0.5, 0.25}, {1, 2}}, {{0.25, 0.5}, {-1, 0}});
    }
  });
}

TEST_CASE("gains that are absent or below zero are refused by name") {
  CHECK_THROWS_WITH_AS(
      VirtualCoupling<1>({.stiffness = Eigen::Array<double, 1, 1>(-1.0), .damping = Eigen::Array<double, 1, 1>(0.0)}),
      "VirtualCoupling: stiffness: expected finite and >= 0, got -1", std::invalid_argument);
  CHECK_THROWS_AS(Coupling(Coupling::Settings{}), std::invalid_argument);
}
