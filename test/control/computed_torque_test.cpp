// SPDX-License-Identifier: MIT
#include <limpid/control/computed_torque.hpp>
#include <limpid/robot/omni.hpp>

#include <support/maximum.hpp>
#include <support/no_allocation.hpp>
#include <support/pendulum.hpp>

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <limits>
#include <random>

using limpid::ComputedTorque;
using limpid::DesiredJoints;
using limpid::JointState;
using limpid::Omni;
using limpid::Status;
using limpid::test::largest_entry;
using limpid::test::maximum;
using limpid::test::Pendulum;

namespace {

template <typename Scalar>
using Vector = Eigen::Matrix<Scalar, 3, 1>;

template <typename Scalar>
ComputedTorque<Omni<Scalar>> omni_controller() {
  return ComputedTorque<Omni<Scalar>>({.Lambda = Vector<Scalar>(Scalar(2.8), Scalar(3.0), Scalar(1.5)),
                                       .Kd = Vector<Scalar>(Scalar(0.4), Scalar(0.28), Scalar(0.10)),
                                       .theta = Omni<Scalar>::table_5_2()});
}

template <typename Scalar>
class Draw {  // joints within Table 5.1, rates to 3 rad/s, accelerations to 20 rad/s^2, forces to 3 N
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  Vector<Scalar> around(const Vector<Scalar>& middle, double most) {
    std::uniform_real_distribution<double> uniform(-most, most);
    return middle + Vector<Scalar>(Scalar(uniform(random_)), Scalar(uniform(random_)), Scalar(uniform(random_)));
  }
  JointState<3, Scalar> state() { return {around({0, Scalar(0.9), Scalar(-1.35)}, 0.9), around(zero, 3)}; }
  DesiredJoints<3, Scalar> desired() {
    return {around({0, Scalar(0.9), Scalar(-1.35)}, 0.9), around(zero, 3), around(zero, 20)};
  }
  Vector<Scalar> force() { return around(zero, 3); }

 private:
  std::mt19937 random_;
  Vector<Scalar> zero = Vector<Scalar>::Zero();
};

}  // namespace

TEST_CASE_TEMPLATE("under its torque the arm obeys (4.4): H delta' + (C + B + Kd) delta = 0", Scalar, float, double,
                   long double) {
  auto controller = omni_controller<Scalar>();
  const auto theta = Omni<Scalar>::table_5_2();
  const Vector<Scalar> Lambda(Scalar(2.8), Scalar(3.0), Scalar(1.5)), Kd(Scalar(0.4), Scalar(0.28), Scalar(0.10));
  Draw<Scalar> draw(42);
  Scalar worst(0);
  for (int i = 0; i < 1000; ++i) {
    const auto is = draw.state();
    const auto wanted = draw.desired();
    const Vector<Scalar> F_h = draw.force();
    const auto [tau, status] = controller.update(is, wanted, F_h);
    REQUIRE(status == Status::ok);
    const auto arm = Omni<Scalar>{}.at(is.q);
    const Eigen::Matrix<Scalar, 3, 3> H = arm.H(theta), C = arm.C(theta, is.qdot), B = arm.B(theta);
    const Vector<Scalar> qddot =
        H.inverse() * (tau + arm.jacobian().transpose() * F_h - (C + B) * is.qdot - arm.tau_g(theta));  // (3.15)
    const Vector<Scalar> delta = is.qdot - wanted.qdot + Lambda.cwiseProduct(is.q - wanted.q);          // (4.1), (4.3)
    const Vector<Scalar> delta_dot = qddot - wanted.qddot + Lambda.cwiseProduct(is.qdot - wanted.qdot);
    const Vector<Scalar> left = H * delta_dot + (C + B) * delta + Kd.cwiseProduct(delta);
    worst = maximum(worst, largest_entry(left));
  }
  // some 100 roundings of torques below 8 N m, through an H of condition 10
  CHECK(worst < 1000 * std::numeric_limits<Scalar>::epsilon());
}

TEST_CASE("the torque of a pendulum is the one worked out by hand") {
  ComputedTorque<Pendulum<>> controller(
      {.Lambda = Eigen::Matrix<double, 1, 1>(4.0), .Kd = Eigen::Matrix<double, 1, 1>(2.0), .theta = {0.5, 8.0, 0.25}});
  const JointState<1> is{Eigen::Matrix<double, 1, 1>(0.0), Eigen::Matrix<double, 1, 1>(1.0)};
  const DesiredJoints<1> wanted{Eigen::Matrix<double, 1, 1>(0.5), Eigen::Matrix<double, 1, 1>(2.0),
                                Eigen::Matrix<double, 1, 1>(16.0)};
  // q_r' = 2 + 4 * .5 = 4, q_r'' = 16 + 4 * 1 = 20, delta = 1 - 4 = -3, J = (1, 0, 0)
  // tau = .5 * 20 + 8 * 0 + .25 * 4 + 2 * 3 - 7 = 10; exact in binary
  CHECK(controller.update(is, wanted, {7.0, 5.0, 3.0}).tau[0] == 10.0);
}

TEST_CASE("a non-finite entry of any input keeps the last good torque and says so") {
  auto controller = omni_controller<double>();
  Draw<double> draw(7);
  const auto is = draw.state();
  const auto wanted = draw.desired();
  const Vector<double> F_h = draw.force(), good = controller.update(is, wanted, F_h).tau;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (int input = 0; input < 6; ++input) {
      for (int i = 0; i < 3; ++i) {
        auto bad_is = is;
        auto bad_wanted = wanted;
        auto bad_F_h = F_h;
        Vector<double>* const inputs[] = {&bad_is.q,        &bad_is.qdot,      &bad_wanted.q,
                                          &bad_wanted.qdot, &bad_wanted.qddot, &bad_F_h};
        (*inputs[input])[i] = bad;
        const auto [tau, status] = controller.update(bad_is, bad_wanted, bad_F_h);
        CHECK(status == Status::not_finite);
        CHECK(tau == good);
      }
    }
  }
}

TEST_CASE("finite inputs whose torque overflows keep the last good torque") {
  auto controller = omni_controller<double>();
  const auto [tau, status] = controller.update({}, {.qddot = Vector<double>::Constant(1e308)}, {1e308, 1e308, 1e308});
  CHECK(status == Status::not_finite);
  CHECK(tau == Vector<double>::Zero());
}

TEST_CASE("an update does not allocate") {
  auto controller = omni_controller<double>();
  Draw<double> draw(3);
  const auto is = draw.state();
  const auto wanted = draw.desired();
  const Vector<double> F_h = draw.force();
  limpid::test::check_no_allocation([&] { (void)controller.update(is, wanted, F_h); });
}

TEST_CASE("gains and parameters that cannot serve are refused with their field") {
  using Controller = ComputedTorque<Pendulum<>>;
  using One = Eigen::Matrix<double, 1, 1>;
  CHECK_THROWS_WITH_AS(Controller({.Kd = One(1.0), .theta = {1, 1, 1}}),
                       "ComputedTorque: Lambda: expected finite and > 0, got nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Controller({.Lambda = One(1.0), .theta = {1, 1, 1}}),
                       "ComputedTorque: Kd: expected finite and > 0, got nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Controller({.Lambda = One(1.0), .Kd = One(1.0)}),
                       "ComputedTorque: theta: expected finite, got nan nan nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Controller({.Lambda = One(0.0), .Kd = One(1.0), .theta = {1, 1, 1}}),
                       "ComputedTorque: Lambda: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Controller({.Lambda = One(1.0), .Kd = One(-2.0), .theta = {1, 1, 1}}),
                       "ComputedTorque: Kd: expected finite and > 0, got -2", std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      Controller({.Lambda = One(1.0), .Kd = One(1.0), .theta = {1, 1, std::numeric_limits<double>::infinity()}}),
      "ComputedTorque: theta: expected finite, got 1 1 inf", std::invalid_argument);
}
