// SPDX-License-Identifier: MIT
#include <limpid/control/computed_torque.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/loop/diagram.hpp>
#include <limpid/loop/loop.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/scene/palpation_blocks.hpp>

#include "support/no_allocation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace limpid;
using namespace limpid::palpation;
using namespace std::chrono_literals;

namespace {

using Tissue = KelvinVoigt<1>;
using Arm = Omni<>;
using KnownModel = ModelPredictor<Tissue, Tool<1>, Known>;
using EstimatedModel = ModelPredictor<Tissue>;

const Tool<1> tool{.mass = 0.1, .damping = 0.1};

AdaptationBlock<Tissue> adaptation() {
  return {EnvironmentEstimator<Tissue>(
      {.environment = {},
       .law = {.lower = {200, 20}, .upper = {2000, 40}, .initial = {1100, 30}, .initial_gain = {1e9, 8e6}}})};
}

// Every block that a palpation may have, around those that predict.
template <typename... Predicting>
auto loop_of(Predicting... predicting) {
  using Controller = SlotineLiAdaptive<Arm>;
  return make_loop<wants<AllowedTorque<Arm>>, inputs<OperatorForce<>, ForceOnArm<>, TrueTool<1>, MeasuredState<Arm>>>(
      SafetyBlock<Arm>{SafetyLimiter<Arm>({})}, predicting..., adaptation(),
      KinematicsBlock<OmniKinematics<>, Arm, 1>{OmniKinematics<>(Arm{}), Arm{}.at({0, 0.785, -1.25}).position()},
      TrackingBlock<Controller, Arm>{Controller({.Lambda = {2.8, 3.0, 1.5},
                                                 .Kd = {0.4, 0.28, 0.1},
                                                 .Gamma = Arm::Parameters::Constant(0.001),
                                                 .theta0 = Arm::table_5_2()})},
      SamplingBlock<1>{DelayedSampled<ToolState<1>>({.period = 16ms, .delay = 16ms})});
}

auto known_loop() { return loop_of(PredictionBlock<KnownModel>{KnownModel({.tool = tool, .theta = {800, 30}})}); }

auto estimated_loop() {
  return loop_of(AdaptivePredictionBlock<EstimatedModel, Tissue>{EstimatedModel({.tool = tool, .theta = {1100, 30}})});
}

DeviceState<> resting_device(Time now) {
  DeviceState<> device;
  device.q = SimulatedOmni<>::start_pose();
  device.stamp = now;
  return device;
}

const Eigen::Vector3d none = Eigen::Vector3d::Zero();

}  // namespace

TEST_CASE("a loop whose tissue is known has no estimator, by type and by size") {
  auto known = known_loop();
  auto estimated = estimated_loop();
  static_assert(!decltype(known)::has<AdaptationBlock<Tissue>>);
  static_assert(decltype(estimated)::has<AdaptationBlock<Tissue>>);
  static_assert(sizeof(known) + sizeof(AdaptationBlock<Tissue>) <= sizeof(estimated) + alignof(std::max_align_t));
}

TEST_CASE("the diagram draws the unwanted estimator dashed") {
  const std::string dot = diagram(known_loop());
  CHECK(dot.find("AdaptationBlock\", shape=box, style=dashed") != std::string::npos);
  CHECK(dot.find("SafetyBlock\", shape=box]") != std::string::npos);
}

TEST_CASE("a whole tick allocates nothing") {
  auto known = known_loop();
  auto estimated = estimated_loop();
  ToolState<1> state;
  limpid::test::check_no_allocation([&] {
    for (Time now = 0ms; now < 200ms; now += 1ms) {
      (void)known.step(now, none, none, state, resting_device(now));
      (void)estimated.step(now, none, none, state, resting_device(now));
    }
  });
}

TEST_CASE("a device that answers with a number that is none gets zero torque in the same tick") {
  auto loop = known_loop();
  for (Time now = 0ms; now < 50ms; now += 1ms) (void)loop.step(now, none, none, {}, resting_device(now));
  DeviceState<> broken = resting_device(50ms);
  broken.q[1] = std::numeric_limits<double>::quiet_NaN();
  const auto [torque, status] = loop.step(50ms, none, none, {}, broken);
  CHECK(torque.value() == none);
  CHECK(has(status, Status::fault));
}

TEST_CASE("a device that is disconnected, or a tool that is not finite, gets zero torque in the same tick") {
  for (const bool device_fails : {true, false}) {
    CAPTURE(device_fails);
    auto loop = known_loop();
    for (Time now = 0ms; now < 49ms; now += 1ms) (void)loop.step(now, none, none, {}, resting_device(now));
    DeviceState<> device = resting_device(64ms);
    ToolState<1> state;
    if (device_fails) {
      device.status = Status::disconnected;
    } else {
      state.x[0] = std::numeric_limits<double>::infinity();  // at 64 ms a sample is due
    }
    for (Time now = 49ms; now < 64ms; now += 1ms) (void)loop.step(now, none, none, {}, resting_device(now));
    const auto [torque, status] = loop.step(64ms, none, none, state, device);
    CHECK(torque.value() == none);
    CHECK(has(status, Status::fault));
  }
}

TEST_CASE("the composed loop gives the torque of the same calls by hand") {
  auto loop = known_loop();
  DelayedSampled<ToolState<1>> sampled({.period = 16ms, .delay = 16ms});
  KnownModel predictor({.tool = tool, .theta = {800, 30}});
  OmniKinematics<> kinematics{Arm{}};
  SlotineLiAdaptive<Arm> controller({.Lambda = {2.8, 3.0, 1.5},
                                     .Kd = {0.4, 0.28, 0.1},
                                     .Gamma = Arm::Parameters::Constant(0.001),
                                     .theta0 = Arm::table_5_2()});
  SafetyLimiter<Arm> limiter({});
  VirtualTool<Tissue> truth({.theta = {800, 30}, .tool = tool});
  const Eigen::Vector3d wall = Arm{}.at({0, 0.785, -1.25}).position();
  Eigen::Vector3d by_hand = none;
  for (Time now = 0ms; now < 300ms; now += 1ms) {
    const Eigen::Vector3d F_h(1 - std::cos(6 * in_seconds(now)), 0, 0);
    const ToolState<1> state = truth.advance(now, Tool<1>::Vector(F_h[0])).value;
    const DeviceState<> device = resting_device(now);

    const auto seen = sampled.update(now, state);
    if (seen.fresh) (void)predictor.observe({seen.value, seen.taken, seen.arrived});
    const Motion<1> motion = predictor.advance(now, Tool<1>::Vector(F_h[0])).motion;
    const Eigen::Vector3d v(motion.v[0], 0, 0), a(motion.a[0], 0, 0);
    const auto wanted = kinematics.inverse(wall + Eigen::Vector3d(motion.x[0], 0, 0), v, a, device.q);
    const auto tau = controller.update(now, device.joint_state(), wanted, F_h, by_hand).tau;
    by_hand = limiter.limit(now, device.joint_state(), tau).torque.value();

    const auto [torque, status] = loop.step(now, F_h, F_h, state, device);
    REQUIRE(torque.value() == by_hand);  // the same operations in the same order
  }
}

TEST_CASE("a loop whose limiter gives nothing for minutes comes back without having wound up its parameters") {
  using Controller = SlotineLiAdaptive<Arm>;
  auto loop = known_loop();
  const auto theta_hat = [&] { return loop.block<TrackingBlock<Controller, Arm>>().component.theta_hat(); };
  const auto device = [](Time at) {  // 0.1 rad from where it should be
    DeviceState<> state = resting_device(at);
    state.q += Eigen::Vector3d(-0.1, -0.1, 0.1);
    return state;
  };
  Time now = 0ms;
  for (; now < 100ms; now += 1ms) (void)loop.step(now, none, none, {}, device(now));
  DeviceState<> lost = device(now);
  lost.status = Status::disconnected;
  (void)loop.step(now, none, none, {}, lost);
  CHECK(loop.block<SafetyBlock<Arm>>().component.reason() == FaultReason::disconnected);
  const Arm::Parameters before = theta_hat();
  for (const Time end = now + 60s; now < end;) {
    now += 1ms;
    const auto [torque, status] = loop.step(now, none, none, {}, device(now));
    REQUIRE(torque.value() == none);
  }
  CHECK(theta_hat() == before);
  loop.block<SafetyBlock<Arm>>().component.reset(now);
  Eigen::Vector3d largest = none;
  for (const Time end = now + 20ms; now < end;) {
    now += 1ms;
    const auto [torque, status] = loop.step(now, none, none, {}, device(now));
    REQUIRE(!has(status, Status::fault));
    largest = largest.cwiseMax(torque.value().cwiseAbs());
  }
  CHECK((theta_hat() - before).cwiseAbs().maxCoeff() < 1e-3);  // 20 ms of errors of 0.1 rad, Gamma 0.001
}

TEST_CASE("a controller that knows its parameters hears of no applied torque") {
  using Known = ComputedTorque<Arm>;
  using Adaptive = SlotineLiAdaptive<Arm>;
  static_assert(!HeedsAppliedTorque<Known, Arm> && HeedsAppliedTorque<Adaptive, Arm>);
  Known controller({.Lambda = {2.8, 3.0, 1.5}, .Kd = {0.4, 0.28, 0.1}, .theta = Arm::table_5_2()});
  auto loop = make_loop<wants<AllowedTorque<Arm>>, inputs<ForceOnArm<>, MeasuredState<Arm>, DesiredState<Arm>>>(
      SafetyBlock<Arm>{SafetyLimiter<Arm>({})}, TrackingBlock<Known, Arm>{controller});
  SafetyLimiter<Arm> limiter({});
  for (Time now = 0ms; now < 50ms; now += 1ms) {
    const DeviceState<> device = resting_device(now);
    InverseMotion<3> wanted{};
    wanted.q = device.q + Eigen::Vector3d(0.01, 0, -0.01);
    const auto tau = controller.update(device.joint_state(), wanted, none).tau;
    const auto [torque, status] = loop.step(now, none, device, wanted);
    REQUIRE(torque.value() == limiter.limit(now, device.joint_state(), tau).torque.value());
  }
}
