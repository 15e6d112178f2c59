// SPDX-License-Identifier: MIT
// The whole loop on one page: a tissue that is computed ten times a second, a predictor that learns it, and an arm.
#include <limpid/limpid.hpp>

#include <cmath>
#include <cstdio>

using namespace limpid;
using namespace limpid::palpation;
using namespace std::chrono_literals;

using Arm = Omni<>;
using SoftTissue = KelvinVoigt<1>;  // the model that is estimated: F = k x + b v
using Model = ModelPredictor<SoftTissue>;
using Controller = SlotineLiAdaptive<Arm>;

int main() {
  const Arm arm;
  const Tool<1> tool{.mass = 0.1, .damping = 0.1};
  const auto start = SimulatedOmni<>::start_pose();
  const Arm::Parameters theta = Arm::table_5_2();

  auto loop = make_loop<wants<AllowedTorque<Arm>>,
                        inputs<OperatorForce<>, ForceOnArm<>, TrueTool<>, MeasuredState<Arm>>>(  // blocks in any order
      SamplingBlock<>{DelayedSampled<ToolState<1>>({.period = 100ms, .delay = 100ms})},
      AdaptationBlock<SoftTissue>{EnvironmentEstimator<SoftTissue>(
          {.environment = {},
           .law = {.lower = {200, 20}, .upper = {2000, 40}, .initial = {1100, 30}, .initial_gain = {1e9, 8e6}}})},
      AdaptivePredictionBlock<Model, SoftTissue>{
          Model({.environment = {}, .tool = tool, .theta = {1100, 30}, .gain = {-195.1, -4.89}})},
      KinematicsBlock<OmniKinematics<>, Arm>{OmniKinematics<>(arm), arm.at(start).position()},
      TrackingBlock<Controller, Arm>{Controller({.Lambda = {2.8, 3.0, 1.5},
                                                 .Kd = {0.4, 0.28, 0.1},
                                                 .Gamma = Arm::Parameters::Constant(0.001),
                                                 .theta0 = theta})},
      SafetyBlock<Arm>{SafetyLimiter<Arm>({})});

  VirtualTool<SoftTissue> tissue({.theta = {800, 30}, .tool = tool});  // the truth, which the loop sees late
  SimulatedOmni<> device({.theta = theta, .q0 = start});
  double error = 0;
  for (Time now = 0ms; now <= 5s; now += 1ms) {
    const Eigen::Vector3d F_h(0.5 * (1 - std::cos(3 * in_seconds(now))), 0, 0);  // measured at the tip
    const ToolState<1> truth = tissue.advance(now, Tool<1>::Vector(F_h[0])).value;
    (void)device.advance(now, F_h);
    const auto [torque, status] = loop.step(now, F_h, F_h, truth, device.read(now));
    (void)device.write(torque);  // takes nothing but what the limiter made
    if (has(status, Status::fault)) return 1;
    const double tip = arm.at(device.true_state().q).position()[0] - arm.at(start).position()[0];
    if (now > 2s) error = std::max(error, std::abs(tip - truth.x[0]));
  }
  std::printf("the tip follows the tool in the tissue within %.2f mm\n", 1e3 * error);
  return error < 1e-3 ? 0 : 1;
}
