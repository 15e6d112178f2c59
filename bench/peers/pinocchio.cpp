// SPDX-License-Identifier: MIT
#include "peers/function.hpp"

#ifdef LIMPID_PINOCCHIO

#include <pinocchio/fwd.hpp>

#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>

#include <Eigen/Cholesky>

#include <memory>

namespace limpid::bench {

namespace {

namespace pin = ::pinocchio;
using Eigen::VectorXd;

pin::Model model_of(const ArmModel& arm, const Eigen::Vector3d& gravity) {
  pin::Model model;
  pin::JointIndex joint = 0;
  for (std::size_t i = 0; i < arm.bodies.size(); ++i) {
    const auto [R, p] = arm.placement(i);
    joint = model.addJoint(joint, pin::JointModelRZ(), pin::SE3(R, p), "joint" + std::to_string(i));
    const auto& [mass, centre, inertia] = arm.bodies[i];
    model.appendBodyToJoint(joint, pin::Inertia(mass, centre, inertia));
  }
  model.addFrame(pin::Frame("tip", joint, 0, pin::SE3(Eigen::Matrix3d::Identity(), arm.tip), pin::OP_FRAME));
  model.gravity.linear() = gravity;
  return model;
}

// Its model, without gravity too, and what its functions write to.
struct Arm {
  struct State {
    VectorXd q, qdot, qddot, near;
    Eigen::Vector3d x;
  };
  pin::Model model, weightless;
  pin::Data data{model};
  pin::FrameIndex tip = model.getFrameId("tip");
  std::vector<State> states;
  VectorXd parameters{10 * model.nv}, rest = VectorXd::Zero(model.nv), q{model.nq};
  pin::Data::Matrix6x J = pin::Data::Matrix6x::Zero(6, model.nv);

  Arm(const ArmModel& arm, const std::vector<Motion>& motions)
      : model{model_of(arm, arm.gravity)}, weightless{model_of(arm, Eigen::Vector3d::Zero())} {
    for (int i = 0; i < model.nv; ++i) {
      parameters.segment<10>(10 * i) = model.inertias[static_cast<std::size_t>(i) + 1].toDynamicParameters();
    }
    for (const Motion& m : motions) {
      move_to(m.q);
      states.push_back({m.q, m.qdot, m.qddot, m.near, position()});
    }
  }

  void move_to(const VectorXd& at) {
    pin::forwardKinematics(model, data, at);
    pin::updateFramePlacement(model, data, tip);
  }
  Eigen::Vector3d position() const { return data.oMf[tip].translation(); }

  // Pinocchio leaves it to its users: Newton's iteration, with steps of least norm.
  void invert(const State& s) {
    q = s.near;
    for (int step = 0; step < 50; ++step) {
      pin::computeJointJacobians(model, data, q);
      const Eigen::Vector3d e = s.x - pin::updateFramePlacement(model, data, tip).translation();
      if (e.norm() < 1e-12) return;
      pin::getFrameJacobian(model, data, tip, pin::LOCAL_WORLD_ALIGNED, J);
      const auto of_position = J.topRows<3>();
      const Eigen::Matrix3d square = of_position * of_position.transpose();
      q += of_position.transpose() * square.llt().solve(e);
    }
  }
};

std::vector<Function> functions_of(const ArmModel& model, const std::vector<Motion>& motions) {
  const auto arm = std::make_shared<Arm>(model, motions);
  const auto with = [&](const std::string& name, auto call, auto value) {
    return function(
        name, motions.size(),
        [arm, call](std::size_t i) -> Arm& {
          call(*arm, arm->states[i]);
          return *arm;
        },
        value);
  };
  using S = const Arm::State&;
  const auto tau = [](Arm& a) { return a.data.tau; };
  return {
      with(
          names::forward, [](Arm& a, S s) { a.move_to(s.q); }, [](Arm& a) { return a.position(); }),
      with(
          names::jacobian,
          [](Arm& a, S s) { pin::computeFrameJacobian(a.model, a.data, s.q, a.tip, pin::LOCAL_WORLD_ALIGNED, a.J); },
          [](Arm& a) { return a.J.topRows<3>(); }),
      with(
          names::inertia, [](Arm& a, S s) { pin::crba(a.model, a.data, s.q); },
          [](Arm& a) -> Eigen::MatrixXd { return a.data.M.selfadjointView<Eigen::Upper>(); }),
      with(
          names::coriolis_matrix, [](Arm& a, S s) { pin::computeCoriolisMatrix(a.model, a.data, s.q, s.qdot); },
          [](Arm& a) { return a.data.C; }),
      with(
          names::coriolis, [](Arm& a, S s) { pin::rnea(a.weightless, a.data, s.q, s.qdot, a.rest); }, tau),
      with(
          names::gravity, [](Arm& a, S s) { pin::computeGeneralizedGravity(a.model, a.data, s.q); },
          [](Arm& a) { return a.data.g; }),
      with(
          names::torque, [](Arm& a, S s) { pin::rnea(a.model, a.data, s.q, s.qdot, s.qddot); }, tau),
      with(
          names::regressor,
          [](Arm& a, S s) { pin::computeJointTorqueRegressor(a.model, a.data, s.q, s.qdot, s.qddot); },
          [](Arm& a) { return a.data.jointTorqueRegressor * a.parameters; }),
      with(
          names::inverse, [](Arm& a, S s) { a.invert(s); },
          [](Arm& a) {
            a.move_to(a.q);
            return a.position();
          })};
}

}  // namespace

Peer pinocchio() { return {"Pinocchio", "", functions_of}; }

}  // namespace limpid::bench

#else

namespace limpid::bench {

Peer pinocchio() { return {"Pinocchio", "was not found (pinocchio 3; Debian has no package of it)", {}}; }

}  // namespace limpid::bench

#endif
