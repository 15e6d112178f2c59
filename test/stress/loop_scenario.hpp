// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "trial.hpp"

#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/loop/loop.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/scene/palpation_blocks.hpp>

#include <chrono>
#include <cmath>
#include <vector>

namespace limpid::stress {

/// A whole palpation, as examples/08_palpation_loop.cpp composes it; after a fault it starts anew.
inline auto palpation_loop() {
  using namespace limpid::palpation;
  using std::chrono::milliseconds;
  using Arm = Omni<>;
  using Tissue = KelvinVoigt<1>;
  using Model = ModelPredictor<Tissue>;
  using Controller = SlotineLiAdaptive<Arm>;
  const Arm arm;
  const Tool<1> tool{.mass = 0.1, .damping = 0.1};
  return make_loop<wants<AllowedTorque<Arm>>, inputs<OperatorForce<>, ForceOnArm<>, TrueTool<>, MeasuredState<Arm>>>(
      SamplingBlock<>{DelayedSampled<ToolState<1>>({.period = milliseconds(16), .delay = milliseconds(16)})},
      AdaptationBlock<Tissue>{EnvironmentEstimator<Tissue>(
          {.environment = {},
           .law = {.lower = {200, 20}, .upper = {2000, 40}, .initial = {1100, 30}, .initial_gain = {1e9, 8e6}}})},
      AdaptivePredictionBlock<Model, Tissue>{
          Model({.environment = {}, .tool = tool, .theta = {1100, 30}, .gain = {-195.1, -4.89}})},
      KinematicsBlock<OmniKinematics<>, Arm>{OmniKinematics<>(arm), arm.at(SimulatedOmni<>::start_pose()).position()},
      TrackingBlock<Controller, Arm>{Controller({.Lambda = {2.8, 3.0, 1.5},
                                                 .Kd = {0.4, 0.28, 0.1},
                                                 .Gamma = Arm::Parameters::Constant(0.001),
                                                 .theta0 = Arm::table_5_2()})},
      SafetyBlock<Arm>{SafetyLimiter<Arm>({})});
}

class LoopStress {
 public:
  static std::vector<Choice> choices() {
    return {
        clock_choice(), corruption_choice(), {"tissue", {"800", "0", "2000"}}, {"device", {"there", "lost at times"}}};
  }

  static Outcome play(const Trial& trial) {
    LoopStress loop(trial);
    return play_ticks(trial, loop.watch_, [&](bool seen, Random& random) { loop.tick(seen, random); });
  }

 private:
  using Arm = Omni<>;
  using Loop = decltype(palpation_loop());

  explicit LoopStress(const Trial& trial)
      : clock_{trial.choices[0]},
        corruption_{trial.choices[1], 0.001},
        tissue_({.theta = {stiffness(trial.choices[2]), 30}, .tool = {.mass = 0.1, .damping = 0.1}}),
        lossy_{trial.choices[3] == 1} {}

  static double stiffness(int choice) { return choice == 0 ? 800 : choice == 1 ? 0 : 2000; }

  void tick(bool seen, Random& random) {
    const Time now = clock_.next(random);
    const Eigen::Vector3d F_h(corruption_(0.5 * (1 - std::cos(3 * in_seconds(now))), random), 0, 0);
    ToolState<1> truth = tissue_.advance(now, Tool<1>::Vector(F_h[0])).value;
    truth.x[0] = corruption_(truth.x[0], random);
    truth.force[0] = corruption_(truth.force[0], random);
    DeviceState<> device;
    device.stamp = now;
    device.q = SimulatedOmni<>::start_pose();
    for (int i = 0; i < 3; ++i) {
      device.q[i] += 0.02 * random.uniform(-1, 1);
      device.qdot[i] = corruption_(random.uniform(-1, 1), random);
    }
    if (random.chance(0.001) && lossy_) device.status = Status::disconnected;
    if (seen) judge(now, F_h, truth, device);
  }

  void judge(Time now, const Eigen::Vector3d& F_h, const ToolState<1>& truth, const DeviceState<>& device) {
    const auto [torque, status] = loop_.step(now, F_h, F_h, truth, device);
    const Eigen::Vector3d& tau = torque.value();
    const Eigen::Vector3d most = Arm{}.limits().torque / 1.3;
    for (int i = 0; i < 3; ++i) {
      watch_.at_most("torque over its limit", std::abs(tau[i]) / most[i], 1 + 1e-15);
    }
    const bool broken = !is_finite(device) || device.status != Status::ok;
    if (broken) watch_.require("a broken device is a fault", has(status, Status::fault));
    if (!has(status, Status::fault)) return;
    watch_.require("a fault has no torque", tau == Eigen::Vector3d::Zero());
    loop_ = fresh_;
  }

  Clock clock_;
  Corruption corruption_;
  VirtualTool<KelvinVoigt<1>> tissue_;
  bool lossy_;
  Loop fresh_ = palpation_loop(), loop_ = fresh_;
  Watch watch_;
};

inline std::vector<Scenario> loop_scenarios() {
  return {{"palpation loop", LoopStress::choices(), &LoopStress::play, 4}};
}

}  // namespace limpid::stress
