// SPDX-License-Identifier: MIT
#include <limpid/control/compensated_tracking.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/scene/palpation_blocks.hpp>

#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>

using limpid::CompensatedTracking;
using limpid::DesiredJoints;
using limpid::JointState;
using limpid::Omni;
using limpid::Status;
using namespace std::chrono_literals;

namespace {

using Three = Eigen::Vector3d;
using Tracking = CompensatedTracking<Omni<>>;

static_assert(limpid::palpation::HeedsAppliedTorque<Tracking, Omni<>>);  // a TrackingBlock hears what it needs

Tracking::Settings some_settings() {
  Tracking::Settings settings;
  settings.controller.Lambda = Three(12, 12, 6);
  settings.controller.Kd = Three(0.2, 0.15, 0.05);
  settings.controller.Gamma.setConstant(1e-4);
  settings.controller.theta0 = Omni<>::table_5_2();
  settings.observer.theta = Omni<>::table_5_2();
  settings.friction.identifier.largest = Eigen::Array3d(0.1, 0.1, 0.05);
  settings.friction.identifier.start = Eigen::Array3d(0.065, 0.065, 0.028);
  return settings;
}

const Three centre(0.1, 0.8, -1.3), none = Three::Zero();

JointState<3> moved(int k) { return {centre + 1e-3 * k * Three(1, -1, 1), Three(9, 9, 9)}; }

DesiredJoints<3> wanted(int k) {
  return {centre + 1.1e-3 * k * Three(1, -1, 1), Three(1.1, -1.1, 1.1), Three(0, 0, 0)};
}

// Half a tick after tick k, with an entry of one input replaced.
Tracking::Output update_with(Tracking& tracking, int k, Three applied, std::size_t input, double entry) {
  auto is = moved(k);
  auto to = wanted(k);
  Three F_h(1, 0, 0);
  const std::array<Three*, 6> inputs{&is.q, &to.q, &to.qdot, &to.qddot, &F_h, &applied};
  (*inputs[input])[k % 3] = entry;
  return tracking.update(k * 1ms + 500us, is, to, F_h, applied);
}

}  // namespace

TEST_CASE("it is its parts, called by hand") {
  const auto settings = some_settings();
  Tracking tracking(settings);
  Tracking::Controller controller(settings.controller);
  Tracking::Observer observer(settings.observer);
  Tracking::Compensator compensator(settings.friction);
  Three tau = Three::Zero(), added = tau;
  for (int k = 0; k < 200; ++k) {
    const Three F_h(std::sin(0.1 * k), 0, 0.5);
    const Three sum = tau;
    tau = tracking.update(k * 1ms, moved(k), wanted(k), F_h, sum).tau;
    const auto observed = observer.update(k * 1ms, moved(k).q, sum, F_h);
    const Three own = controller.update(k * 1ms, observed.state, wanted(k), F_h, sum, added).tau;
    (void)compensator.identify(k * 1ms, observed.state, -observed.disturbance);
    added = compensator.update(wanted(k)).tau;
    REQUIRE(tau == own + added);
  }
  CHECK(tracking.theta_hat() == controller.theta_hat());
  CHECK(tracking.theta_hat() != settings.controller.theta0);  // its own compensation does not stop the adaptation
  CHECK(tracking.friction().coulomb[1] == compensator.friction().coulomb[1]);
}

TEST_CASE("an input that is not finite and a clock that stands change nothing") {
  Tracking tracking(some_settings()), twin(some_settings());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Three tau = Three::Zero();
  for (int k = 0; k < 30; ++k) {
    const Three before = tau;
    tau = tracking.update(k * 1ms, moved(k), wanted(k), {1, 0, 0}, before).tau;
    REQUIRE(tau == twin.update(k * 1ms, moved(k), wanted(k), {1, 0, 0}, before).tau);
    for (std::size_t input = 0; input < 6; ++input) {
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
        const auto [kept, status] = update_with(tracking, k, tau, input, bad);
        CHECK(status == Status::not_finite);
        CHECK(kept == tau);
      }
    }
    CHECK(tracking.update(k * 1ms, moved(k), wanted(k + 1), {1, 0, 0}, tau).status == Status::clock_backwards);
  }
}

TEST_CASE("while the joints are wanted to rest nothing is adapted, however far they are from there") {
  auto settings = some_settings();
  settings.rest = 0.01;
  Tracking tracking(settings);
  Three tau = Three::Zero();
  for (int k = 0; k < 100; ++k) {
    tau =
        tracking.update(k * 1ms, {centre, none}, {centre + Three(0.1, 0.1, 0.1), Three(0, 0.0099, 0), none}, none, tau)
            .tau;
  }
  CHECK(tracking.theta_hat() == settings.controller.theta0);
  for (int k = 100; k < 110; ++k) {
    tau = tracking.update(k * 1ms, {centre, none}, {centre + Three(0.1, 0.1, 0.1), Three(0, 0.02, 0), none}, none, tau)
              .tau;
  }
  CHECK(tracking.theta_hat() != settings.controller.theta0);
}

TEST_CASE("no call allocates") {
  Tracking tracking(some_settings());
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 50; ++k) (void)tracking.update(k * 1ms, moved(k), wanted(k), {1, 0, 0}, {0, 0, 0});
  });
}

TEST_CASE("what a part refuses is refused by the part's name") {
  auto settings = some_settings();
  settings.rest = -1;
  CHECK_THROWS_WITH_AS(Tracking{settings}, "CompensatedTracking: rest: expected finite and >= 0, got -1",
                       std::invalid_argument);
  settings.observer.bandwidth = -1;
  CHECK_THROWS_WITH_AS(Tracking{settings}, "VelocityObserver: bandwidth: expected finite and > 0, got -1",
                       std::invalid_argument);
}
