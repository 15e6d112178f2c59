// SPDX-License-Identifier: MIT
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include <benchmark/benchmark.h>

namespace {

using benchmark::DoNotOptimize;

template <limpid::Real Scalar>
struct Motion {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  Vector q{Scalar(0.1), Scalar(0.8), Scalar(-1.25)};
  Vector qdot{Scalar(0.3), Scalar(-0.2), Scalar(0.5)};
  Vector qddot{Scalar(-1), Scalar(2), Scalar(0.5)};
  Vector delta{Scalar(0.01), Scalar(0.02), Scalar(-0.03)};
};

template <limpid::Real Scalar>
void omni_inverse_position(benchmark::State& state) {
  const limpid::Omni<Scalar> robot;
  const limpid::OmniKinematics<Scalar> kinematics(robot);
  Eigen::Matrix<Scalar, 3, 1> x = robot.at(Motion<Scalar>().q).position();
  for (auto _ : state) {
    DoNotOptimize(x);
    DoNotOptimize(kinematics.inverse(x));
  }
}
BENCHMARK_TEMPLATE(omni_inverse_position, double);
BENCHMARK_TEMPLATE(omni_inverse_position, float);

template <limpid::Real Scalar>
void omni_inverse_motion(benchmark::State& state) {
  const limpid::Omni<Scalar> robot;
  const limpid::OmniKinematics<Scalar> kinematics(robot);
  Motion<Scalar> motion;
  Eigen::Matrix<Scalar, 3, 1> x = robot.at(motion.q).position();
  for (auto _ : state) {
    DoNotOptimize(x);
    DoNotOptimize(motion);
    DoNotOptimize(kinematics.inverse(x, motion.qdot, motion.qddot));
  }
}
BENCHMARK_TEMPLATE(omni_inverse_motion, double);
BENCHMARK_TEMPLATE(omni_inverse_motion, float);

template <limpid::Real Scalar>
void omni_pose_jacobian_and_derivative(benchmark::State& state) {
  const limpid::Omni<Scalar> robot;
  Motion<Scalar> motion;
  for (auto _ : state) {
    DoNotOptimize(motion);
    const auto pose = robot.at(motion.q);
    DoNotOptimize(pose.position());
    DoNotOptimize(pose.jacobian());
    DoNotOptimize(pose.jacobian_dot(motion.qdot));
  }
}
BENCHMARK_TEMPLATE(omni_pose_jacobian_and_derivative, double);
BENCHMARK_TEMPLATE(omni_pose_jacobian_and_derivative, float);

template <limpid::Real Scalar>
void omni_torque_and_adaptation_direction(benchmark::State& state) {
  const limpid::Omni<Scalar> robot;
  Motion<Scalar> motion;
  auto pose = robot.at(motion.q);
  auto theta = limpid::Omni<Scalar>::table_5_2();
  for (auto _ : state) {
    DoNotOptimize(pose);
    DoNotOptimize(motion);
    DoNotOptimize(theta);
    DoNotOptimize(pose.torque(theta, motion.qdot, motion.qdot, motion.qddot));
    DoNotOptimize(pose.adaptation_direction(motion.qdot, motion.qdot, motion.qddot, motion.delta));
  }
}
BENCHMARK_TEMPLATE(omni_torque_and_adaptation_direction, double);
BENCHMARK_TEMPLATE(omni_torque_and_adaptation_direction, float);

// What the sparse products replace.
template <limpid::Real Scalar>
void omni_dense_regressor_products(benchmark::State& state) {
  const limpid::Omni<Scalar> robot;
  Motion<Scalar> motion;
  auto pose = robot.at(motion.q);
  auto theta = limpid::Omni<Scalar>::table_5_2();
  for (auto _ : state) {
    DoNotOptimize(pose);
    DoNotOptimize(motion);
    DoNotOptimize(theta);
    const auto phi_r = pose.regressor(motion.qdot, motion.qdot, motion.qddot);
    DoNotOptimize((phi_r * theta).eval());
    DoNotOptimize((phi_r.transpose() * motion.delta).eval());
  }
}
BENCHMARK_TEMPLATE(omni_dense_regressor_products, double);
BENCHMARK_TEMPLATE(omni_dense_regressor_products, float);

}  // namespace
