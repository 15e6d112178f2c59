// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/loop/loop.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/scene/palpation_blocks.hpp>

#include "tick/inputs.hpp"
#include "tick/straightforward_tick.hpp"

#include <utility>
#include <vector>

namespace limpid::bench {

/// A tissue of each axis's own, N/m and N s/m.
[[nodiscard]] inline EnvironmentTheta<KelvinVoigt<3>> tick_tissue() {
  EnvironmentTheta<KelvinVoigt<3>> theta;
  theta << 900, 25, 600, 33, 1300, 29;
  return theta;
}

/// 1024 ticks of a press along three axes, periodic.
template <typename Scalar>
[[nodiscard]] std::vector<TickInput<3, Scalar>> tick_inputs() {
  std::vector<TickInput<3, Scalar>> inputs;
  for (const TickInput<3>& input :
       inputs_along(press, KelvinVoigt<3>{}, tick_tissue(), {.mass = 0.1, .damping = 0.1})) {
    inputs.push_back(input.template cast<Scalar>());
  }
  return inputs;
}

/// The tick's components as the library gives them, set as `StraightforwardTick` is.
template <typename Scalar>
struct TickParts {
  using Env = KelvinVoigt<3, Scalar>;
  using Arm = Omni<Scalar>;
  using Predictor = ModelPredictor<Env>;
  using Controller = SlotineLiAdaptive<Arm>;
  using Kinematics = OmniKinematics<Scalar>;

  [[nodiscard]] static StraightforwardTick::Settings settings() {
    StraightforwardTick::Settings s;
    s.tool = {.mass = 0.1, .damping = 0.1};
    s.L1 = -195.1;
    s.L2 = -4.89;
    s.period = s.delay = std::chrono::milliseconds{1};  // a fresh sample on every tick
    s.wall = Omni<>{}.at({0, 0.7853981633974483, -1.25}).position();
    s.Lambda << 2.8, 3.0, 1.5;
    s.Kd << 0.4, 0.28, 0.10;
    s.Gamma << 0.01, 0.002, 0.002, 0.0005, 0.001, 0.001, 0.02, 0.02, 0.02;
    s.theta0 = Omni<>::table_5_2();
    return s;
  }

  // In the body of functions: g++ 12 fails on such braces where members are declared.
  static auto make_estimator(const StraightforwardTick::Settings& s) {
    return EnvironmentEstimator<Env>({.environment = {},
                                      .law = {.lower = rows(s.lower),
                                              .upper = rows(s.upper),
                                              .initial = rows(s.initial),
                                              .initial_gain = rows(s.initial_gain),
                                              .forgetting = Scalar(s.alpha),
                                              .normalisation = Scalar(s.nu),
                                              .gain_limit = Scalar(s.rho_M)}});
  }

  static Predictor make_predictor(const StraightforwardTick::Settings& s) {
    return Predictor({.environment = {},
                      .tool = {.mass = Scalar(s.tool.mass), .damping = Scalar(s.tool.damping)},
                      .theta = rows(s.initial),
                      .gain = {Scalar(s.L1), Scalar(s.L2)}});
  }

  static Controller make_controller(const StraightforwardTick::Settings& s) {
    return Controller({.Lambda = s.Lambda.template cast<Scalar>(),
                       .Kd = s.Kd.template cast<Scalar>(),
                       .Gamma = s.Gamma.template cast<Scalar>(),
                       .theta0 = s.theta0.template cast<Scalar>()});
  }

  static EnvironmentTheta<Env> rows(const Eigen::Vector2d& value) {
    EnvironmentTheta<Env> theta;
    for (int axis = 0; axis < 3; ++axis) theta.row(axis) = value.transpose().array().template cast<Scalar>();
    return theta;
  }

  explicit TickParts(const StraightforwardTick::Settings& s = settings())
      : sampled({.period = s.period, .delay = s.delay}),
        estimator(make_estimator(s)),
        predictor(make_predictor(s)),
        kinematics(Arm{}),
        controller(make_controller(s)),
        limiter(typename SafetyLimiter<Arm>::Settings{}),
        wall(s.wall.template cast<Scalar>()) {}

  DelayedSampled<ToolState<3, Scalar>> sampled;
  EnvironmentEstimator<Env> estimator;
  Predictor predictor;
  Kinematics kinematics;
  Controller controller;
  SafetyLimiter<Arm> limiter;
  Eigen::Matrix<Scalar, 3, 1> wall;
};

/// The controller as a block for a loop without limiter, in which it has the torque that it wants.
template <typename Controller, Robot R>
struct UnlimitedTracking {
  using Scalar = RobotScalar<R>;
  using reads = signals<palpation::MeasuredState<R>, palpation::DesiredState<R>, palpation::ForceOnArm<Scalar>>;
  using writes = signals<palpation::WantedTorque<R>>;

  Controller component;

  Reported<JointVector<R>> operator()(Time now, const typename palpation::MeasuredState<R>::value_type& measured,
                                      const typename palpation::DesiredState<R>::value_type& desired,
                                      const Eigen::Matrix<Scalar, 3, 1>& F_h) noexcept {
    const auto [tau, status] = component.update(now, measured.joint_state(), desired, F_h);
    return {tau, status};
  }
};

/// A loop of these parts; of all in it but what tracks, in any order.
template <typename Wanted, typename Scalar, typename... Rest>
[[nodiscard]] auto tick_of(const TickParts<Scalar>& parts, Rest... rest) {
  using namespace palpation;
  using P = TickParts<Scalar>;
  using Arm = typename P::Arm;
  return make_loop<wants<Wanted>,
                   inputs<OperatorForce<Scalar>, ForceOnArm<Scalar>, TrueTool<3, Scalar>, MeasuredState<Arm>>>(
      std::move(rest)..., KinematicsBlock<typename P::Kinematics, Arm, 3>{parts.kinematics, parts.wall},
      AdaptivePredictionBlock<typename P::Predictor, typename P::Env>{parts.predictor},
      AdaptationBlock<typename P::Env>{parts.estimator}, SamplingBlock<3, Scalar>{parts.sampled});
}

/// The tick composed from blocks, up to the controller's torque.
template <typename Scalar>
[[nodiscard]] auto composed_tick(const StraightforwardTick::Settings& settings = TickParts<Scalar>::settings()) {
  using P = TickParts<Scalar>;
  using Arm = typename P::Arm;
  const P parts(settings);
  return tick_of<palpation::WantedTorque<Arm>>(parts, UnlimitedTracking<typename P::Controller, Arm>{parts.controller});
}

/// The tick composed from blocks, up to what the device may have.
template <typename Scalar>
[[nodiscard]] auto composed_safe_tick() {
  using P = TickParts<Scalar>;
  using Arm = typename P::Arm;
  const P parts;
  return tick_of<palpation::AllowedTorque<Arm>>(
      parts, palpation::SafetyBlock<Arm>{parts.limiter},
      palpation::TrackingBlock<typename P::Controller, Arm>{parts.controller});
}

/// The same calls written by hand.
template <typename Scalar>
struct HandWrittenTick : TickParts<Scalar> {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  struct Wanted {
    InverseMotion<3, Scalar> motion;
    Status status;
  };
  struct Output {
    Vector torque;
    Status status;
  };
  struct SafeOutput {
    SafeTorque<3, Scalar> torque;
    Status status;
  };

  explicit HandWrittenTick(const StraightforwardTick::Settings& settings = TickParts<Scalar>::settings())
      : TickParts<Scalar>(settings) {}

  [[gnu::always_inline]] Wanted wanted(Time now, const Vector& F_h, const ToolState<3, Scalar>& tool,
                                       const DeviceState<3, Scalar>& device) noexcept {
    const auto seen = this->sampled.update(now, tool);
    Status status = device.status | seen.status | this->estimator.update(now, seen);
    status |= this->predictor.use(this->estimator.estimate());
    if (seen.fresh) status |= this->predictor.observe({seen.value, seen.taken, seen.arrived});
    const auto [motion, predicted] = this->predictor.advance(now, F_h.array());
    const auto joints =
        this->kinematics.inverse(this->wall + motion.x.matrix(), motion.v.matrix(), motion.a.matrix(), device.q);
    return {joints, status | predicted | joints.status};
  }

  /// Up to the controller's torque.
  [[gnu::always_inline]] Output step(Time now, const Vector& F_h, const Vector& on_arm,
                                     const ToolState<3, Scalar>& tool, const DeviceState<3, Scalar>& device) noexcept {
    const auto [motion, status] = wanted(now, F_h, tool, device);
    const auto [tau, tracked] = this->controller.update(now, device.joint_state(), motion, on_arm);
    return {tau, status | tracked};
  }

  /// Up to what the device may have.
  [[gnu::always_inline]] SafeOutput safe_step(Time now, const Vector& F_h, const Vector& on_arm,
                                              const ToolState<3, Scalar>& tool,
                                              const DeviceState<3, Scalar>& device) noexcept {
    const auto [motion, status] = wanted(now, F_h, tool, device);
    const auto [tau, tracked] = this->controller.update(now, device.joint_state(), motion, on_arm, applied_);
    const auto [torque, limited] = this->limiter.limit(now, device.joint_state(), tau, status | tracked);
    applied_ = torque.value();
    return {torque, status | tracked | limited};
  }

 private:
  Vector applied_ = Vector::Zero();  // N m, in the last tick
};

}  // namespace limpid::bench
