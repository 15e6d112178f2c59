// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safety_limiter.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/loop/block.hpp>
#include <limpid/loop/signal.hpp>
#include <limpid/robot/inverse_kinematics.hpp>
#include <limpid/scene/palpation_signals.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <concepts>
#include <utility>

/// Components as blocks of a `Loop`: a line or two each, always inlined, so that the loop costs what the calls cost.
/// Each block holds its component by value, in the member `component`, and does not allocate where the component does
/// not.
namespace limpid::palpation {

/// A slow environment, as if it ran elsewhere: the true tool, sampled, delayed and held.
template <int Axes = 1, Real Scalar = double, std::size_t Capacity = 64>
struct SamplingBlock {
  using reads = signals<TrueTool<Axes, Scalar>>;
  using writes = signals<SeenTool<Axes, Scalar>>;

  DelayedSampled<ToolState<Axes, Scalar>, Capacity> component;

  [[gnu::always_inline]] const Held<ToolState<Axes, Scalar>>& operator()(Time now,
                                                                         const ToolState<Axes, Scalar>& tool) noexcept {
    return component.update(now, tool);
  }
};

/// The estimate of the environment's parameters, from the samples.
template <Environment Env>
struct AdaptationBlock {
  static constexpr int axes = EnvironmentTraits<Env>::axes;
  using Scalar = typename EnvironmentTraits<Env>::Scalar;
  using reads = signals<SeenTool<axes, Scalar>>;
  using writes = signals<Estimate<Env>>;

  EnvironmentEstimator<Env> component;

  [[gnu::always_inline]] Reported<typename Estimate<Env>::value_type> operator()(
      Time now, const Held<ToolState<axes, Scalar>>& seen) noexcept {
    const Status status = component.update(now, seen);
    return {component.estimate(), status};
  }
};

/// What is held as a sample, copied entry by entry: in larger pieces than it was stored in the copy would wait.
template <int Axes, Real Scalar>
[[nodiscard, gnu::always_inline]] inline ToolSample<Axes, Scalar> sample_of(
    const Held<ToolState<Axes, Scalar>>& held) noexcept {
  ToolSample<Axes, Scalar> sample;
  sample.value.x = held.value.x;
  sample.value.v = held.value.v;
  sample.value.a = held.value.a;
  sample.value.force = held.value.force;
  sample.taken = held.taken;
  sample.arrived = held.arrived;
  return sample;
}

/// Observes what is fresh and predicts to now.
template <typename P, int Axes, Real Scalar>
[[nodiscard, gnu::always_inline]] inline Prediction<Axes, Scalar> observe_and_advance(
    P& predictor, Time now, const Held<ToolState<Axes, Scalar>>& seen,
    const Eigen::Matrix<Scalar, 3, 1>& F_h) noexcept {
  Status status = Status::ok;
  if (seen.fresh) status = predictor.observe(sample_of(seen));
  auto predicted = predictor.advance(now, F_h.template head<Axes>().array());
  predicted.status |= status;
  return predicted;
}

/// A predictor that needs no estimate: hold, or a model whose parameters are known.
template <typename P, int Axes = 1, Real Scalar = double>
struct PredictionBlock {
  using reads = signals<SeenTool<Axes, Scalar>, OperatorForce<Scalar>>;
  using writes = signals<PredictedMotion<Axes, Scalar>>;

  P component;

  [[gnu::always_inline]] Prediction<Axes, Scalar> operator()(Time now, const Held<ToolState<Axes, Scalar>>& seen,
                                                             const Eigen::Matrix<Scalar, 3, 1>& F_h) noexcept {
    return observe_and_advance<P, Axes, Scalar>(component, now, seen, F_h);
  }
};

/// A predictor whose model is estimated as the loop runs.
template <typename P, Environment Env>
struct AdaptivePredictionBlock {
  static constexpr int axes = EnvironmentTraits<Env>::axes;
  using Scalar = typename EnvironmentTraits<Env>::Scalar;
  using reads = signals<SeenTool<axes, Scalar>, Estimate<Env>, OperatorForce<Scalar>>;
  using writes = signals<PredictedMotion<axes, Scalar>>;

  P component;

  [[gnu::always_inline]] Prediction<axes, Scalar> operator()(Time now, const Held<ToolState<axes, Scalar>>& seen,
                                                             const typename Estimate<Env>::value_type& estimate,
                                                             const Eigen::Matrix<Scalar, 3, 1>& F_h) noexcept {
    const Status used = component.use(estimate);
    auto predicted = observe_and_advance<P, axes, Scalar>(component, now, seen, F_h);
    predicted.status |= used;
    return predicted;
  }
};

/// Joints for the predicted motion; the axes of the tool are the first ones of the base frame, from the wall's origin.
template <typename K, Robot R, int Axes = 1>
struct KinematicsBlock {
  using Scalar = RobotScalar<R>;
  using Point = Eigen::Matrix<Scalar, 3, 1>;
  using reads = signals<PredictedMotion<Axes, Scalar>, MeasuredState<R>>;
  using writes = signals<DesiredState<R>>;

  K component;
  Point wall;  ///< origin of the wall in the base frame, m

  [[gnu::always_inline]] typename DesiredState<R>::value_type operator()(
      Time, const Prediction<Axes, Scalar>& predicted, const typename MeasuredState<R>::value_type& measured) noexcept {
    Point x = wall, v = Point::Zero(), a = Point::Zero();
    x.template head<Axes>() += predicted.motion.x.matrix();
    v.template head<Axes>() = predicted.motion.v.matrix();
    a.template head<Axes>() = predicted.motion.a.matrix();
    return InverseKinematicsTraits<K>::inverse(component, x, v, a, measured.q);
  }
};

/// A controller that adapts, and therefore must hear what torque the device had.
template <typename Controller, typename R>
concept HeedsAppliedTorque = requires(Controller controller, Time now, const typename MeasuredState<R>::value_type& is,
                                      const typename DesiredState<R>::value_type& desired,
                                      const Eigen::Matrix<RobotScalar<R>, 3, 1>& F_h, const JointVector<R>& applied) {
  controller.update(now, is.joint_state(), desired, F_h, applied);
};

/// Makes the device follow: ComputedTorque.
template <typename Controller, Robot R>
struct TrackingBlock {
  using Scalar = RobotScalar<R>;
  using reads = signals<MeasuredState<R>, DesiredState<R>, ForceOnArm<Scalar>>;
  using writes = signals<WantedTorque<R>>;

  Controller component;

  [[gnu::always_inline]] Reported<JointVector<R>> operator()(Time,
                                                             const typename MeasuredState<R>::value_type& measured,
                                                             const typename DesiredState<R>::value_type& desired,
                                                             const Eigen::Matrix<Scalar, 3, 1>& F_h) noexcept {
    const auto [tau, status] = component.update(measured.joint_state(), desired, F_h);
    return {tau, status};
  }
};

/// Makes the device follow: SlotineLiAdaptive, which adapts only while the device has the torque that it wants.
template <typename Controller, Robot R>
requires HeedsAppliedTorque<Controller, R>
struct TrackingBlock<Controller, R> {
  using Scalar = RobotScalar<R>;
  using reads = signals<MeasuredState<R>, DesiredState<R>, ForceOnArm<Scalar>, Previous<AllowedTorque<R>>>;
  using writes = signals<WantedTorque<R>>;

  Controller component;

  [[gnu::always_inline]] Reported<JointVector<R>> operator()(
      Time now, const typename MeasuredState<R>::value_type& measured,
      const typename DesiredState<R>::value_type& desired, const Eigen::Matrix<Scalar, 3, 1>& F_h,
      const typename AllowedTorque<R>::value_type& applied) noexcept {
    const auto [tau, status] = component.update(now, measured.joint_state(), desired, F_h, applied.value());
    return {tau, status};
  }
};

/// The last block before the device; hears of all that went before it in the tick.
template <Robot R>
struct SafetyBlock {
  using reads = signals<MeasuredState<R>, WantedTorque<R>, TickStatus>;
  using writes = signals<AllowedTorque<R>>;

  SafetyLimiter<R> component;

  [[gnu::always_inline]] Reported<typename AllowedTorque<R>::value_type> operator()(
      Time now, const typename MeasuredState<R>::value_type& measured, const JointVector<R>& wanted,
      Status upstream) noexcept {
    const auto [torque, status] = component.limit(now, measured.joint_state(), wanted, upstream);
    return {torque, status};
  }
};

}  // namespace limpid::palpation
