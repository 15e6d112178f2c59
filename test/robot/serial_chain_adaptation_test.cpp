// SPDX-License-Identifier: MIT
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/core/dormand_prince.hpp>
#include <limpid/robot/serial_chain.hpp>
#include <support/maximum.hpp>

#include "chains.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <chrono>
#include <cmath>

using limpid::DesiredJoints, limpid::DormandPrince, limpid::JointState, limpid::SerialChain, limpid::SlotineLiAdaptive,
    limpid::Status, limpid::Time;
using limpid::test::maximum;
using limpid::test::puma_560, limpid::test::puma_560_theta;
using namespace std::chrono_literals;

namespace {

using Six = Eigen::Matrix<double, 6, 1>;
using Parameters = SerialChain<6>::Parameters;

DesiredJoints<6> wanted(double t) {
  DesiredJoints<6> wanted;
  for (int i = 0; i < 6; ++i) {
    const double amplitude = 0.4, omega = 2 + 0.5 * i;  // rad, rad/s
    wanted.q[i] = amplitude * std::sin(omega * t + i);
    wanted.qdot[i] = amplitude * omega * std::cos(omega * t + i);
    wanted.qddot[i] = -amplitude * omega * omega * std::sin(omega * t + i);
  }
  return wanted;
}

struct Tracked {
  double early, late;  // largest |q - q_e| in the first and in the last second, rad
  Parameters theta_hat;
};

/// The PUMA 560 whose links carry their motors' inertias, by the same paper, about their joints' axes; with friction.
Parameters driven_puma() {
  const Six rotors = (Six() << 1.14, 4.71, 0.83, 0.200, 0.179, 0.193).finished();  // kg m^2, through the gears
  Parameters theta = puma_560_theta();
  for (int i = 0; i < 6; ++i) {
    theta[10 * i + 4] += rotors[i] / 2;  // I_xx and I_yy of a plate
    theta[10 * i + 7] += rotors[i] / 2;
    theta[10 * i + 9] += rotors[i];
  }
  theta.tail<6>().setConstant(0.5);
  return theta;
}

/// It for `seconds`, under a controller at 1 kHz that starts from 0.7 of its parameters.
Tracked track(double adaptation, int seconds) {
  const Parameters theta = driven_puma();
  SlotineLiAdaptive<SerialChain<6>> controller({.robot = puma_560(),
                                                .Lambda = Six::Constant(10),
                                                .Kd = (Six() << 60, 60, 30, 2, 2, 1).finished(),
                                                .Gamma = Parameters::Constant(adaptation),
                                                .theta0 = 0.7 * theta});
  using State = Eigen::Matrix<double, 12, 1>;
  const auto chain = puma_560();
  const DormandPrince<State> integrator({.absolute = 1e-8, .relative = 1e-6});
  State y;
  y << wanted(0).q, wanted(0).qdot;
  Tracked tracked{0, 0, theta};
  for (int tick = 0; tick < 1000 * seconds; ++tick) {
    const double t = tick * 1e-3;
    JointState<6> is;
    is.q = y.head<6>();
    is.qdot = y.tail<6>();
    const auto output = controller.update(Time(1ms * tick), is, wanted(t), Eigen::Vector3d::Zero());
    REQUIRE(output.status == Status::ok);
    const double error = (is.q - wanted(t).q).lpNorm<Eigen::Infinity>();
    if (tick < 1000) tracked.early = maximum(tracked.early, error);
    if (tick >= 1000 * (seconds - 1)) tracked.late = maximum(tracked.late, error);
    const auto motion = [&](double, const State& state) {
      const auto pose = chain.at(state.head<6>());
      const Six qdot = state.tail<6>();
      State slope;
      slope << qdot, pose.H(theta).llt().solve(output.tau - pose.torque(theta, qdot, qdot, Six::Zero()));
      return slope;
    };
    REQUIRE(integrator.advance(y, t, t + 1e-3, motion) == Status::ok);
  }
  tracked.theta_hat = controller.theta_hat();
  return tracked;
}

}  // namespace

TEST_CASE("adaptation makes a six-joint arm of unknown parameters follow its path") {
  const Tracked fixed = track(0, 4), adapted = track(2, 4);
  CAPTURE(fixed.late);
  CAPTURE(adapted.early);
  CAPTURE(adapted.late);
  CHECK(fixed.late > 0.01);  // the missing 30 % of 45 N m against gains of 600 N m/rad
  CHECK(adapted.late < adapted.early / 2);
  CHECK(adapted.late < fixed.late / 5);
  // theta_hat need not come to theta: what does not act stays where it was.
  CHECK(adapted.theta_hat[0] == 0);
  CHECK(adapted.theta_hat[11] != 0.7 * driven_puma()[11]);
}
