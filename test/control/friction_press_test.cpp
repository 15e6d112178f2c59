// SPDX-License-Identifier: MIT
// A hand presses the realistic Omni into tissue A of 6.2.2, 3 N at half a hertz, sampled every T_d and seen T_d later:
// what the tip makes of the true signal with friction compensated, beside what it makes of the held one at the gains
// that are best for that, without.
#include <limpid/control/compensated_tracking.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/evaluation/error_norms.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <functional>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

using Three = Eigen::Vector3d;
using Ones = Eigen::Array<double, 1, 1>;
using Force = std::function<double(double)>;

struct Scene {
  Force force;
  Time duration;
  Duration period;
  bool ideal;                // the true signal in place of the held one
  bool compensated;          // by CompensatedTracking; else SlotineLiAdaptive on the device's rates
  double Kd, Lambda, Gamma;  // times (5.6), (5.7)
};

struct Found {
  Norms<> total;   // error of the tip, m and m/s mixed
  double chatter;  // mean |change of a joint's torque| a tick, N m
  double motion;   // of a joint in the last 4 s, rad
  Eigen::Array3d friction;
};

SlotineLiAdaptive<Omni<>>::Settings controller_of(const Scene& scene) {
  Omni<>::Parameters Gamma;
  Gamma << 0.01, 0.002, 0.002, 0.0005, 0.001, 0.001, 0.02, 0.02, 0.02;
  return {.Lambda = scene.Lambda * Three(2.8, 3.0, 1.5),
          .Kd = scene.Kd * Three(0.4, 0.28, 0.10),
          .Gamma = scene.Gamma * Gamma,
          .theta0 = Omni<>::table_5_2()};
}

CompensatedTracking<Omni<>>::Settings compensated(const Scene& scene) {
  const Eigen::Array3d table_5_1 = Omni<>{}.limits().static_friction.array();
  return {.controller = controller_of(scene),
          .observer = {.theta = Omni<>::table_5_2(), .bandwidth = 110},
          .friction = {.identifier = {.largest = 1.5 * table_5_1, .start = table_5_1},
                       .presliding = Eigen::Array3d::Constant(6.2e-4),
                       .share = 0.95}};
}

Found press(const Scene& scene) {
  const Three start = SimulatedOmni<>::start_pose(), wall = Omni<>{}.at(start).position();
  EnvironmentTheta<SmoothBilinear<1>> theta;
  theta << 370, 1980, 30;
  VirtualTool<SmoothBilinear<1>> tissue({.environment = SmoothBilinear<1>({.depth = 0.0028, .sharpness = 20}),
                                         .theta = theta,
                                         .tool = {.mass = 0.1, .damping = 0.1}});
  DelayedSampled<ToolState<1>> sampled({.period = scene.period, .delay = scene.period});
  HoldPredictor<1> hold;
  SimulatedOmni<> arm({.realism = Realism::realistic});
  CompensatedTracking<Omni<>> tracking(compensated(scene));
  SlotineLiAdaptive<Omni<>> plain(controller_of(scene));
  SafetyLimiter<Omni<>> limiter({});
  const OmniKinematics<double> kinematics{Omni<>{}};
  ErrorNorms<3> total;
  Found found{};
  Three applied = Three::Zero(), least = start, most = start;
  for (Time now{0}; now <= scene.duration; now += 1ms) {
    const Three F_h(scene.force(in_seconds(now)), 0, 0);
    const ToolState<1> tool = tissue.advance(now, Ones(F_h[0])).value;
    const auto& seen = sampled.update(now, tool);
    if (seen.fresh) (void)hold.observe({seen.value, seen.taken, seen.arrived});
    const Motion<1> held = hold.advance(now, Ones(F_h[0])).motion;
    const Motion<1> signal = scene.ideal ? Motion<1>{tool.x, tool.v, tool.a} : held;

    (void)arm.advance(now, F_h);
    const auto measured = arm.read(now);
    const auto wanted = kinematics.inverse(wall + Three(signal.x[0], 0, 0), Three(signal.v[0], 0, 0),
                                           Three(signal.a[0], 0, 0), measured.q);
    const auto is = measured.joint_state();
    const Three tau = scene.compensated ? tracking.update(now, is, wanted, F_h, applied).tau
                                        : plain.update(now, is, wanted, F_h, applied).tau;
    const auto [torque, status] = limiter.limit(now, is, tau);
    REQUIRE(!has(status, Status::fault));
    (void)arm.write(torque);
    found.chatter += (torque.value() - applied).cwiseAbs().mean() * 1e-3 / in_seconds(scene.duration);
    applied = torque.value();

    const auto truth = arm.true_state();
    const auto pose = Omni<>{}.at(truth.q);
    const Three tip = pose.position() - wall, rate = pose.jacobian() * truth.qdot;
    (void)total.add(now, Three(tip - Three(tool.x[0], 0, 0)), Three(rate - Three(tool.v[0], 0, 0)));
    if (now <= scene.duration - 4s) least = most = truth.q;
    least = least.cwiseMin(truth.q);
    most = most.cwiseMax(truth.q);
  }
  found.total = total.total();
  found.motion = (most - least).maxCoeff();
  found.friction = tracking.friction().coulomb;
  return found;
}

double raised_cosine(double t) { return 1.5 * (1 - std::cos(std::acos(-1.0) * t)); }

// Four presses, and then half of their force, which stays.
Force presses_then(double newtons) {
  return [=](double t) { return newtons * (t < 8.5 ? (1 - std::cos(std::acos(-1.0) * t)) / 2 : 0.5); };
}

// Gains for which a search found the smallest total error of this press and of a recorded one.
Scene ours(const Force& force, Time duration, Duration period, bool ideal) {
  return {force, duration, period, ideal, true, 0.57, 4.45, 0.1};
}

Scene hold_at_its_best(const Force& force, Time duration, Duration period) {
  return {force, duration, period, false, false, 5.73, 0.07, 0.2};
}

}  // namespace

TEST_CASE("with the true signal the tip's error is at most .35 of hold's at its own best gains, and it chatters less") {
  const Found hold = press(hold_at_its_best(raised_cosine, 10s, 100ms));
  const Found compensated = press(ours(raised_cosine, 10s, 100ms, true));
  MESSAGE("total L2 ", compensated.total.l2, ", hold's ", hold.total.l2, "; chatter ", compensated.chatter, ", hold's ",
          hold.chatter, " N m");
  CHECK(compensated.total.l2 <= 0.35 * hold.total.l2);
  CHECK(compensated.total.max <= hold.total.max);
  CHECK(compensated.chatter < hold.chatter);
}

TEST_CASE("under a constant force after some presses the arm comes to rest: no limit cycle") {
  for (const double newtons : {1.0, 1.7, 2.0, 3.0}) {
    CAPTURE(newtons);
    const Found rest = press(ours(presses_then(newtons), 20s, 100ms, true));
    CHECK(rest.motion < 2e-4);  // in the last 4 s; half an encoder step
  }
}

TEST_CASE("the friction that is identified is the simulated arm's, where a joint moves") {
  const Found found = press(ours(raised_cosine, 10s, 100ms, true));
  const Eigen::Array3d simulated = Omni<>{}.limits().static_friction.array();
  CHECK(found.friction[1] == doctest::Approx(simulated[1]).epsilon(0.1));
  CHECK(found.friction[2] == doctest::Approx(simulated[2]).epsilon(0.1));
}
