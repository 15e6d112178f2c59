// SPDX-License-Identifier: MIT
#include "peers/function.hpp"

#ifdef LIMPID_KDL

#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <memory>

namespace limpid::bench {

namespace {

KDL::Vector vector_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
Eigen::Vector3d vector_of(const KDL::Vector& v) { return {v.x(), v.y(), v.z()}; }

KDL::Frame frame_of(const RigidTransform<double>& t) {
  const auto& R = t.R;
  return {{R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)}, vector_of(t.p)};
}

KDL::JntArray joints_of(const Eigen::VectorXd& q) {
  KDL::JntArray joints(static_cast<unsigned>(q.size()));
  joints.data = q;
  return joints;
}

// A segment is a joint and, behind it, its link up to the next joint; the link's inertia is that in its far frame. The
// first joint lies in the base frame, in both models.
KDL::Chain chain_of(const ArmModel& model) {
  KDL::Chain chain;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const bool last = i + 1 == model.bodies.size();
    const KDL::Frame end = last ? KDL::Frame(vector_of(model.tip)) : frame_of(model.placement(i + 1));
    const auto& [mass, centre, I] = model.bodies[i];
    const KDL::RotationalInertia inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), end,
                                  end.Inverse() * KDL::RigidBodyInertia(mass, vector_of(centre), inertia)));
  }
  return chain;
}

// Its solvers, and what they write to.
struct Arm {
  struct State {
    KDL::JntArray q, qdot, qddot, near;
    KDL::Frame x;
  };
  KDL::Chain chain;
  unsigned joints = chain.getNrOfJoints();
  KDL::ChainFkSolverPos_recursive forward{chain};
  KDL::ChainJntToJacSolver jacobian{chain};
  KDL::ChainDynParam dynamics;
  KDL::ChainIdSolver_RNE newton_euler;
  // Of the position alone.
  KDL::ChainIkSolverPos_LMA inverse{chain, (Eigen::Matrix<double, 6, 1>() << 1, 1, 1, 0, 0, 0).finished(), 1e-12};
  KDL::Wrenches no_wrenches = KDL::Wrenches(chain.getNrOfSegments(), KDL::Wrench::Zero());
  std::vector<State> states;

  KDL::Frame x;
  KDL::Jacobian J{joints};
  KDL::JntSpaceInertiaMatrix H{static_cast<int>(joints)};
  KDL::JntArray q{joints}, tau{joints};

  Arm(const ArmModel& model, const std::vector<Motion>& motions)
      : chain{chain_of(model)},
        dynamics{chain, vector_of(model.gravity)},
        newton_euler{chain, vector_of(model.gravity)} {
    for (const Motion& m : motions) {
      forward.JntToCart(joints_of(m.q), x);
      states.push_back({joints_of(m.q), joints_of(m.qdot), joints_of(m.qddot), joints_of(m.near), x});
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
  const auto tau = [](Arm& a) { return a.tau.data; };
  const auto position = [](Arm& a) { return vector_of(a.x.p); };
  const auto reached = [](Arm& a) {
    a.forward.JntToCart(a.q, a.x);
    return vector_of(a.x.p);
  };
  return {with(
              names::forward, [](Arm& a, S s) { a.forward.JntToCart(s.q, a.x); }, position),
          with(
              names::jacobian, [](Arm& a, S s) { a.jacobian.JntToJac(s.q, a.J); },
              [](Arm& a) { return a.J.data.topRows<3>(); }),
          with(
              names::inertia, [](Arm& a, S s) { a.dynamics.JntToMass(s.q, a.H); }, [](Arm& a) { return a.H.data; }),
          with(
              names::coriolis, [](Arm& a, S s) { a.dynamics.JntToCoriolis(s.q, s.qdot, a.tau); }, tau),
          with(
              names::gravity, [](Arm& a, S s) { a.dynamics.JntToGravity(s.q, a.tau); }, tau),
          with(
              names::torque, [](Arm& a, S s) { a.newton_euler.CartToJnt(s.q, s.qdot, s.qddot, a.no_wrenches, a.tau); },
              tau),
          with(
              names::inverse, [](Arm& a, S s) { a.inverse.CartToJnt(s.near, s.x, a.q); }, reached)};
}

}  // namespace

Peer kdl() { return {"KDL", "", functions_of}; }

}  // namespace limpid::bench

#else

namespace limpid::bench {

Peer kdl() { return {"KDL", "was not found (orocos_kdl; on Debian liborocos-kdl-dev)", {}}; }

}  // namespace limpid::bench

#endif
