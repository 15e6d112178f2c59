// SPDX-License-Identifier: MIT
#include <limpid/robot/chain_kinematics.hpp>
#include <limpid/robot/serial_chain.hpp>

#include "robot/straightforward_chain.hpp"

#include <benchmark/benchmark.h>

#include <Eigen/Core>

#include <cmath>

namespace {

using benchmark::DoNotOptimize;
using Chain = limpid::SerialChain<6>;
using Joints = Chain::Joints;

// The PUMA 560 by Armstrong, Khatib and Burdick (1986).
Chain::Settings puma() {
  const double quarter = std::acos(0.0);
  return {.links = {{{.alpha = 0},
                     {.alpha = -quarter, .d = 0.2435},
                     {.a = 0.4318, .d = -0.0934},
                     {.alpha = quarter, .a = -0.0203, .d = 0.4331},
                     {.alpha = -quarter},
                     {.alpha = quarter}}},
          .tip = Eigen::Vector3d(0, 0, 0.1)};
}

struct Motion {
  Joints q = (Joints() << 0.3, -0.8, 1.2, 0.4, -0.7, 0.2).finished();
  Joints qdot = (Joints() << 0.3, -0.2, 0.5, 1.0, -0.6, 0.1).finished();
  Joints qdot_r = (Joints() << 0.2, -0.3, 0.6, 0.9, -0.5, 0.3).finished();
  Joints qddot_r = (Joints() << -1.0, 2.0, 0.5, 0.7, -0.4, 3.0).finished();
  Chain::Parameters theta = (Chain::Parameters::Random().array() + 2.0).matrix();
};

// What is around the calls below.
void serial_chain_baseline(benchmark::State& state) {
  Motion motion;
  for (auto _ : state) DoNotOptimize(motion);
}
BENCHMARK(serial_chain_baseline);

void serial_chain_pose(benchmark::State& state) {
  const Chain chain(puma());
  Motion motion;
  for (auto _ : state) {
    DoNotOptimize(motion);
    DoNotOptimize(chain.at(motion.q));
  }
}
BENCHMARK(serial_chain_pose);

void at_a_pose(benchmark::State& state, auto&& of_pose) {
  const Chain chain(puma());
  Motion motion;
  auto pose = chain.at(motion.q);
  for (auto _ : state) {
    DoNotOptimize(pose);
    DoNotOptimize(motion);
    DoNotOptimize(of_pose(pose, motion));
  }
}

void serial_chain_jacobian(benchmark::State& state) {
  at_a_pose(state, [](const auto& pose, const Motion&) { return pose.jacobian(); });
}
BENCHMARK(serial_chain_jacobian);

void serial_chain_H(benchmark::State& state) {
  at_a_pose(state, [](const auto& pose, const Motion& m) { return pose.H(m.theta); });
}
BENCHMARK(serial_chain_H);

void serial_chain_C(benchmark::State& state) {
  at_a_pose(state, [](const auto& pose, const Motion& m) { return pose.C(m.theta, m.qdot); });
}
BENCHMARK(serial_chain_C);

void serial_chain_torque(benchmark::State& state) {
  at_a_pose(state, [](const auto& pose, const Motion& m) { return pose.torque(m.theta, m.qdot, m.qdot_r, m.qddot_r); });
}
BENCHMARK(serial_chain_torque);

void serial_chain_adaptation_direction(benchmark::State& state) {
  at_a_pose(state, [](const auto& pose, const Motion& m) {
    return pose.adaptation_direction(m.qdot, m.qdot_r, m.qddot_r, Joints(m.qdot - m.qdot_r));
  });
}
BENCHMARK(serial_chain_adaptation_direction);

void serial_chain_regressor(benchmark::State& state) {
  at_a_pose(state, [](const auto& pose, const Motion& m) { return pose.regressor(m.qdot, m.qdot_r, m.qddot_r); });
}
BENCHMARK(serial_chain_regressor);

// What the regressor replaces: a recursion for each parameter. First with this library's recursion, then with a
// textbook's in 6 x 6 matrices; both must give the same matrix.
void serial_chain_regressor_by_columns(benchmark::State& state) {
  at_a_pose(state, [](const auto& pose, const Motion& m) {
    Chain::Pose::Regressor phi;
    for (int p = 0; p < Chain::parameters; ++p) {
      phi.col(p) = pose.torque(Chain::Parameters::Unit(p), m.qdot, m.qdot_r, m.qddot_r);
    }
    return phi;
  });
}
BENCHMARK(serial_chain_regressor_by_columns);

void serial_chain_regressor_straightforward(benchmark::State& state) {
  const auto settings = puma();
  limpid::bench::StraightforwardChain<6> straightforward(settings.links, settings.gravity);
  Motion motion;
  straightforward.move_to(motion.q);
  const auto expected = straightforward.regressor(motion.qdot, motion.qdot_r, motion.qddot_r);
  const auto actual = Chain(settings).at(motion.q).regressor(motion.qdot, motion.qdot_r, motion.qddot_r);
  if (!((actual - expected).cwiseAbs().maxCoeff() < 1e-13 * expected.cwiseAbs().maxCoeff())) {
    state.SkipWithError("the regressors differ");
    return;
  }
  for (auto _ : state) {
    DoNotOptimize(straightforward);
    DoNotOptimize(motion);
    DoNotOptimize(straightforward.regressor(motion.qdot, motion.qdot_r, motion.qddot_r));
  }
}
BENCHMARK(serial_chain_regressor_straightforward);

// The next tick of a path: 0.1 mm on.
void chain_inverse_motion_of_the_next_tick(benchmark::State& state) {
  const Chain chain(puma());
  const limpid::ChainKinematics<6> kinematics(chain);
  Motion motion;
  Eigen::Vector3d x = chain.at(motion.q).position() + Eigen::Vector3d(1e-4, 0, 0), v(0.1, 0, 0), a(0, 1, 0);
  for (auto _ : state) {
    DoNotOptimize(x);
    DoNotOptimize(motion);
    DoNotOptimize(kinematics.inverse(x, v, a, motion.q));
  }
}
BENCHMARK(chain_inverse_motion_of_the_next_tick);

// A target out of reach: every search is made, and in vain.
void chain_inverse_position_out_of_reach(benchmark::State& state) {
  const Chain chain(puma());
  const limpid::ChainKinematics<6> kinematics(chain);
  Motion motion;
  Eigen::Vector3d x(2, 1, 0.5);
  for (auto _ : state) {
    DoNotOptimize(x);
    DoNotOptimize(motion);
    DoNotOptimize(kinematics.inverse(x, motion.q));
  }
}
BENCHMARK(chain_inverse_position_out_of_reach);

}  // namespace
