// SPDX-License-Identifier: MIT
#include <limpid/robot/cartesian_dynamics.hpp>
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/five_bar_kinematics.hpp>
#include <limpid/robot/omni.hpp>

#include <benchmark/benchmark.h>

namespace {

using benchmark::DoNotOptimize;

template <limpid::Real Scalar>
struct Motion {
  using Vector = Eigen::Matrix<Scalar, 2, 1>;
  Vector q{Scalar(1.75), Scalar(0.75)};
  Vector qdot{Scalar(0.3), Scalar(-0.2)};
  Vector qddot{Scalar(-1), Scalar(2)};
  Vector delta{Scalar(0.01), Scalar(0.02)};
};

template <limpid::Real Scalar>
void five_bar_baseline(benchmark::State& state) {
  Motion<Scalar> motion;
  for (auto _ : state) DoNotOptimize(motion);
}
BENCHMARK_TEMPLATE(five_bar_baseline, double);
BENCHMARK_TEMPLATE(five_bar_baseline, float);

template <limpid::Real Scalar>
void five_bar_inverse_motion(benchmark::State& state) {
  const limpid::FiveBar<Scalar> robot;
  const limpid::FiveBarKinematics<Scalar> kinematics(robot);
  Eigen::Matrix<Scalar, 3, 1> x = robot.at(Motion<Scalar>().q).position(), v(Scalar(0.1), Scalar(0.2), Scalar(0)),
                              a = v;
  for (auto _ : state) {
    DoNotOptimize(x);
    DoNotOptimize(v);
    DoNotOptimize(a);
    DoNotOptimize(kinematics.inverse(x, v, a));
  }
}
BENCHMARK_TEMPLATE(five_bar_inverse_motion, double);
BENCHMARK_TEMPLATE(five_bar_inverse_motion, float);

template <limpid::Real Scalar>
void five_bar_pose_jacobian_and_derivative(benchmark::State& state) {
  const limpid::FiveBar<Scalar> robot;
  Motion<Scalar> motion;
  for (auto _ : state) {
    DoNotOptimize(motion);
    const auto pose = robot.at(motion.q);
    DoNotOptimize(pose.position());
    DoNotOptimize(pose.jacobian());
    DoNotOptimize(pose.jacobian_dot(motion.qdot));
  }
}
BENCHMARK_TEMPLATE(five_bar_pose_jacobian_and_derivative, double);
BENCHMARK_TEMPLATE(five_bar_pose_jacobian_and_derivative, float);

template <limpid::Real Scalar>
void five_bar_torque_and_adaptation_direction(benchmark::State& state) {
  const limpid::FiveBar<Scalar> robot;
  Motion<Scalar> motion;
  auto pose = robot.at(motion.q);
  auto theta = robot.theta_of({});
  for (auto _ : state) {
    DoNotOptimize(pose);
    DoNotOptimize(motion);
    DoNotOptimize(theta);
    DoNotOptimize(pose.torque(theta, motion.qdot, motion.qdot, motion.qddot));
    DoNotOptimize(pose.adaptation_direction(motion.qdot, motion.qdot, motion.qddot, motion.delta));
  }
}
BENCHMARK_TEMPLATE(five_bar_torque_and_adaptation_direction, double);
BENCHMARK_TEMPLATE(five_bar_torque_and_adaptation_direction, float);

// What the products without phi_r replace.
template <limpid::Real Scalar>
void five_bar_dense_regressor_products(benchmark::State& state) {
  const limpid::FiveBar<Scalar> robot;
  Motion<Scalar> motion;
  auto pose = robot.at(motion.q);
  auto theta = robot.theta_of({});
  for (auto _ : state) {
    DoNotOptimize(pose);
    DoNotOptimize(motion);
    DoNotOptimize(theta);
    const auto phi_r = pose.regressor(motion.qdot, motion.qdot, motion.qddot);
    DoNotOptimize((phi_r * theta).eval());
    DoNotOptimize((phi_r.transpose() * motion.delta).eval());
  }
}
BENCHMARK_TEMPLATE(five_bar_dense_regressor_products, double);
BENCHMARK_TEMPLATE(five_bar_dense_regressor_products, float);

void cartesian_dynamics_five_bar(benchmark::State& state) {
  const limpid::FiveBar<> robot;
  auto theta = robot.theta_of({});
  limpid::JointState<2> is{{1.75, 0.75}, {0.3, -0.2}};
  for (auto _ : state) {
    DoNotOptimize(theta);
    DoNotOptimize(is);
    DoNotOptimize(limpid::cartesian_dynamics(robot, theta, is));
  }
}
BENCHMARK(cartesian_dynamics_five_bar);

void cartesian_dynamics_omni(benchmark::State& state) {
  const limpid::Omni<> robot;
  auto theta = limpid::Omni<>::table_5_2();
  limpid::JointState<3> is{{0.1, 0.8, -1.25}, {0.3, -0.2, 0.5}};
  for (auto _ : state) {
    DoNotOptimize(theta);
    DoNotOptimize(is);
    DoNotOptimize(limpid::cartesian_dynamics(robot, theta, is));
  }
}
BENCHMARK(cartesian_dynamics_omni);

}  // namespace
