// SPDX-License-Identifier: MIT
// Omni in double against differences taken in 50 digits of the two things it is derived from, the tip's position (3.2)
// and the energies (3.18), (3.19): on 1e5 random states, along a random direction xi of the joints each. Over a step of
// 1e-16 a quotient of differences truncates at 1e-14 of these values (rates up to 5 rad/s, accelerations up to 50
// rad/s^2) and a second one rounds at 1e-50 / 1e-32 = 1e-18, both far below the 1e-12 asked for.
//
// Angles enter through their cosines and sines, to long double's 19 digits at the state and turned from there in 50:
// a point that is off by 1e-19, but differences about it that are not.
#include <limpid/robot/omni.hpp>

#include "omni_states.hpp"
#include "support/precision.hpp"
#include "worst.hpp"

#include <doctest/doctest.h>

#include <cmath>

using Eigen::Matrix3d, Eigen::Vector3d;
using limpid::Omni;
using limpid::test::Fifty, limpid::test::OmniState, limpid::test::OmniStates, limpid::test::Worst;
using Wide = Eigen::Matrix<Fifty, 3, 1>;

namespace {

constexpr int states = 100'000;
constexpr double tolerance = 1e-12;
const Fifty h("1e-16"), per_h("1e16"), half("0.5");
const Fifty l2("0.135"), l3("0.130"), g("9.81");  // Table 5.2

struct Direction {
  Fifty c, s;

  static Direction of(long double angle) { return {Fifty(std::cos(angle)), Fifty(std::sin(angle))}; }
  /// Turned by an angle of the order of h; the series' next term is of the order of 1e-48.
  [[nodiscard]] Direction turned(const Fifty& angle) const {
    const Fifty less = half * angle * angle;
    return {c - c * less - s * angle, s - s * less + c * angle};
  }
};

/// The arm by its directions of q1, q2 and q2 + q3.
struct Arm {
  Direction one, two, three;

  static Arm at(const Vector3d& q) {
    return {Direction::of(q[0]), Direction::of(q[1]), Direction::of(static_cast<long double>(q[1]) + q[2])};
  }
  [[nodiscard]] Arm turned(const Wide& dq) const {
    return {one.turned(dq[0]), two.turned(dq[1]), three.turned(dq[1] + dq[2])};
  }
  [[nodiscard]] Wide position() const {  // (3.2)
    const Fifty r = l2 * two.c + l3 * three.c;
    return {r * one.c, r * one.s, l2 * two.s + l3 * three.s};
  }
};

/// Section 3.3.2: each link a rod, its centre of mass lc from its root.
struct Rods {
  double m2, m3, lc2, lc3, I1, I2, I3;  // kg, m, kg m^2

  static Rods any(OmniStates& random) {
    const auto mass = [&] { return random.uniform(0.02, 0.3); };
    const auto length = [&] { return random.uniform(0.02, 0.13); };
    const auto inertia = [&] { return random.uniform(1e-4, 5e-3); };
    return {mass(), mass(), length(), length(), inertia(), inertia(), inertia()};
  }
  [[nodiscard]] Eigen::Matrix<double, 9, 1> theta() const {  // (3.25), without friction
    const double l = 0.135;
    Eigen::Matrix<double, 9, 1> theta;
    theta << I1, m2 * lc2 * lc2 + I2 + m3 * l * l, m3 * lc3 * lc3 + I3, m3 * l * lc3, m2 * lc2 + m3 * l, m3 * lc3, 0, 0,
        0;
    return theta;
  }
};

/// The energies of an arm made of rods.
class Energies {
 public:
  Energies(const Rods& rods, const Arm& arm)
      : c2_{arm.two.c},
        c3_{arm.three.c},
        l2c2_{l2 * arm.two.c},
        l2s2_{l2 * arm.two.s},
        lc3c3_{rods.lc3 * arm.three.c},
        lc3s3_{rods.lc3 * arm.three.s},
        s2_{arm.two.s},
        m3_{rods.m3},
        first_{rods.I1},
        second_{rods.I2 + rods.m2 * rods.lc2 * rods.lc2},
        third_{rods.I3},
        weight2_{g * rods.m2 * rods.lc2},
        weight3_{g * rods.m3} {}

  /// 2 T of (3.18): each link turns in the arm's plane and, by its cosine, around the vertical axis.
  [[nodiscard]] Fifty twice_kinetic(const Wide& qdot) const {
    const Fifty &w1 = qdot[0], &w2 = qdot[1], w3 = qdot[1] + qdot[2];
    const Fifty turn2 = c2_ * w1, turn3 = c3_ * w1;
    const Fifty inward = l2s2_ * w2 + lc3s3_ * w3, upward = l2c2_ * w2 + lc3c3_ * w3, around = (l2c2_ + lc3c3_) * w1;
    return first_ * (w1 * w1) + second_ * (w2 * w2 + turn2 * turn2) + third_ * (w3 * w3 + turn3 * turn3) +
           m3_ * (inward * inward + upward * upward + around * around);
  }
  [[nodiscard]] Fifty potential() const { return weight2_ * s2_ + weight3_ * (l2s2_ + lc3s3_); }               // (3.19)
  [[nodiscard]] Fifty lagrangian(const Wide& qdot) const { return half * twice_kinetic(qdot) - potential(); }  // (3.17)
  /// xi' dL/dq': exact, since T is quadratic in q'.
  [[nodiscard]] Fifty momentum(const Wide& qdot, const Wide& xi) const {
    return half * half * (twice_kinetic(qdot + xi) - twice_kinetic(qdot - xi));
  }

 private:
  Fifty c2_, c3_, l2c2_, l2s2_, lc3c3_, lc3s3_, s2_;
  Fifty m3_, first_, second_, third_, weight2_, weight3_;
};

double difference(const Fifty& wide, double narrow) { return std::abs(static_cast<double>(wide - narrow)); }

double difference(const Wide& wide, const Vector3d& narrow) {
  return limpid::test::largest_entry((wide - narrow.cast<Fifty>()).cast<double>());
}

}  // namespace

TEST_CASE("J and its derivative are the differences of the tip's position") {
  OmniStates random(5009);
  Worst position, jacobian, jacobian_dot;
  for (int i = 0; i < states; ++i) {
    const OmniState state = random();
    const Vector3d xi = random().qdot;
    const Wide along = xi.cast<Fifty>() * h, motion = state.qdot.cast<Fifty>() * h;
    const Arm here = Arm::at(state.q), later = here.turned(motion);
    const Wide x = here.position();
    const Wide J_xi = (here.turned(along).position() - x) * per_h;
    const Wide J_xi_later = (later.turned(along).position() - later.position()) * per_h;

    const auto pose = Omni<>().at(state.q);
    position.see(difference(x, pose.position()), i);
    jacobian.see(difference(J_xi, pose.jacobian() * xi), i);
    jacobian_dot.see(difference((J_xi_later - J_xi) * per_h, pose.jacobian_dot(state.qdot) * xi), i);
  }
  CAPTURE(position);
  CAPTURE(jacobian);
  CAPTURE(jacobian_dot);
  CHECK(position.error() < tolerance);
  CHECK(jacobian.error() < tolerance);
  CHECK(jacobian_dot.error() < tolerance);
}

TEST_CASE("H, C, gravity and both regressors are Lagrange's equation, and H' - 2 C is skew") {
  OmniStates random(5020);
  Worst inertia, skew, lagrange, reference;
  for (int i = 0; i < states; ++i) {
    const OmniState state = random();
    const Vector3d xi = random().qdot / 5;
    const Rods rods = Rods::any(random);
    const Wide qdot = state.qdot.cast<Fifty>(), qddot = state.qddot.cast<Fifty>(), wide_xi = xi.cast<Fifty>();
    const Arm arm = Arm::at(state.q);
    const Energies here(rods, arm), later(rods, arm.turned(qdot * h)), aside(rods, arm.turned(wide_xi * h));
    const Fifty xi_H_xi = here.twice_kinetic(wide_xi);
    const Fifty xi_Hdot_xi = (later.twice_kinetic(wide_xi) - xi_H_xi) * per_h;
    const Fifty xi_torque = (later.momentum(qdot + qddot * h, wide_xi) - here.momentum(qdot, wide_xi)) * per_h -
                            (aside.lagrangian(qdot) - here.lagrangian(qdot)) * per_h;  // (3.20)

    const auto theta = rods.theta();
    const auto pose = Omni<>().at(state.q);
    inertia.see(difference(xi_H_xi, xi.dot(pose.H(theta) * xi)), i);
    skew.see(difference(xi_Hdot_xi, 2 * xi.dot(pose.C(theta, state.qdot) * xi)), i);
    lagrange.see(difference(xi_torque, xi.dot(pose.regressor(state.qdot, state.qddot) * theta)), i);
    reference.see(difference(xi_torque, xi.dot(pose.torque(theta, state.qdot, state.qdot, state.qddot))), i);
  }
  CAPTURE(inertia);
  CAPTURE(skew);
  CAPTURE(lagrange);
  CAPTURE(reference);
  CHECK(inertia.error() < tolerance);
  CHECK(skew.error() < tolerance);
  CHECK(lagrange.error() < tolerance);
  CHECK(reference.error() < tolerance);
}
