// SPDX-License-Identifier: MIT
// A million random states and torques, judged by formulas that share nothing with the limiter but the pose.
#include <limpid/control/safety_limiter.hpp>
#include <limpid/robot/omni.hpp>
#include <support/maximum.hpp>

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using limpid::JointState;
using limpid::Omni;
using limpid::SafetyLimiter;
using limpid::Status;
using limpid::Time;
using limpid::test::largest_entry;
using limpid::test::maximum;

namespace {

template <typename Scalar>
using Vector = Eigen::Matrix<Scalar, 3, 1>;

struct Broken {
  int torque = 0, joint = 0, elbow = 0, radius = 0, reach = 0, slew = 0;
};

struct Near {
  int joint = 0, elbow = 0, radius = 0, reach = 0;
};

template <typename Scalar>
void judge_rules(const Vector<Scalar>& q, const Vector<Scalar>& tau, Broken& broken, Near& near) {
  const Scalar margin = Scalar(0.1L), eps = std::numeric_limits<Scalar>::epsilon();
  const Scalar most[] = {Scalar(0.30L), Scalar(0.29L), Scalar(0.20L)};
  const Scalar lower[] = {Scalar(-1.0471975511965977L), Scalar(0), Scalar(-2.45L)};
  const Scalar upper[] = {Scalar(1.0471975511965977L), Scalar(1.79L), Scalar(-0.25L)};
  const Scalar edge = 4 * eps;  // states within some roundings of where a rule begins are not judged by it
  for (int i = 0; i < 3; ++i) {
    broken.torque += std::abs(tau[i]) > most[i] / Scalar(1.3L) * (1 + 2 * eps);
    const bool high = q[i] > upper[i] - margin + edge, low = q[i] < lower[i] + margin - edge;
    near.joint += high || low;
    broken.joint += (high && tau[i] > 0) || (low && tau[i] < 0);
  }
  if (q[1] + q[2] > Scalar(0.214L) - margin + edge) {
    ++near.elbow;
    broken.elbow += tau[1] > 0 || tau[2] > 0;
  }
  const auto pose = Omni<Scalar>{}.at(q);
  const Vector<Scalar> x = pose.position();
  const Scalar radius = std::hypot(x[0], x[1]), reach = x.norm();
  const Vector<Scalar> toward_reach = pose.jacobian().transpose() * x / reach;
  if (radius < Scalar(0.13L) - edge) {
    ++near.radius;
    // the force at the tip that holds tau in balance, J' F = tau, times det J / r to be rid of its division
    using Long = Eigen::Matrix<long double, 3, 1>;
    const auto precise = Omni<long double>{}.at(q.template cast<long double>());
    const auto J = precise.jacobian();
    const Long F = J.transpose().partialPivLu().solve(tau.template cast<long double>()), tip = precise.position();
    const long double r = std::hypot(tip[0], tip[1]);
    const long double pressed = (F[0] * tip[0] + F[1] * tip[1]) / r * std::abs(J.determinant()) / r;
    broken.radius += pressed < -8 * eps * 0.1L;  // roundings of three products below 0.06
  }
  if (reach > Scalar(0.25L) + edge) {
    ++near.reach;
    broken.reach += toward_reach.dot(tau) > 8 * eps * Scalar(0.1);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("over a million random states and torques no rule and no slew rate is ever broken", Scalar, float,
                   double) {
  constexpr unsigned seed = 20170602;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<Scalar> uniform(-1, 1);
  std::uniform_int_distribution<int> step(100'000, 2'000'000);  // ns
  const auto draw = [&] { return Vector<Scalar>(uniform(random), uniform(random), uniform(random)); };
  const Vector<Scalar> slew(20, 30, 10), middle(0, Scalar(0.895), Scalar(-1.35));
  const Vector<Scalar> span(Scalar(1.14), Scalar(0.99), Scalar(1.19));  // 0.09 rad beyond every joint limit
  SafetyLimiter<Omni<Scalar>> limiter({.slew = slew});
  Broken broken;
  Near near;
  int moved = 0;
  Time now{0};
  Vector<Scalar> last = Vector<Scalar>::Zero(), wanted = last, q = middle;
  (void)limiter.limit(now, {q, last}, wanted);
  for (int i = 0; i < 1'000'000; ++i) {
    const Time dt{step(random)};
    now += dt;
    if (i % 4 == 0) q = middle + span.cwiseProduct(draw());  // four ticks at each pose, so that torque can build up
    if (i % 2 == 0) wanted = draw();                         // to 1 N m, far beyond any limit
    const auto [torque, status] = limiter.limit(now, {q, draw()}, wanted);
    REQUIRE(!has(status, Status::fault));
    const Vector<Scalar>& tau = torque.value();
    judge_rules<Scalar>(q, tau, broken, near);
    const Vector<Scalar> most = slew * limpid::in_seconds<Scalar>(dt) +
                                Vector<Scalar>::Constant(Scalar(0.25)) * std::numeric_limits<Scalar>::epsilon();
    for (int j = 0; j < 3; ++j) {  // a rule may take torque away faster, but only toward zero
      broken.slew += tau[j] > std::max(last[j], Scalar(0)) + most[j] || tau[j] < std::min(last[j], Scalar(0)) - most[j];
    }
    moved += tau != last;
    last = tau;
  }
  CHECK(broken.torque == 0);
  CHECK(broken.joint == 0);
  CHECK(broken.elbow == 0);
  CHECK(broken.radius == 0);
  CHECK(broken.reach == 0);
  CHECK(broken.slew == 0);
  // that the rules were put to the test
  CHECK(near.joint > 100'000);
  CHECK(near.elbow > 10'000);
  CHECK(near.radius > 10'000);
  CHECK(near.reach > 10'000);
  CHECK(moved > 100'000);
}

TEST_CASE("the torque that passes is continuous in q: less than 20 N m per rad, anywhere within the limits") {
  // The largest slopes: a joint's band takes 0.31 N m / 1.3 over 0.05 rad, 4.6 N m/rad; that of the radius lets the
  // half-space's offset go over 5 mm, of which a rad of joint 2 or 3 is up to 0.2 m, and meets that of (5.4).
  constexpr unsigned seed = 54;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&] { return Vector<double>(uniform(random), uniform(random), uniform(random)); };
  const auto limits = Omni<>{}.limits();
  const Vector<double> middle = (limits.lower + limits.upper) / 2, span = (limits.upper - limits.lower) / 2;
  const auto settled = [](const Vector<double>& q, const Vector<double>& wanted) {
    SafetyLimiter<Omni<>> limiter({.slew = Vector<double>::Constant(1e9)});
    (void)limiter.limit(Time{0}, {q, Vector<double>::Zero()}, wanted);
    return limiter.limit(Time{1'000'000}, {q, Vector<double>::Zero()}, wanted).torque.value();
  };
  double steepest = 0;
  for (int i = 0; i < 300'000; ++i) {
    const Vector<double> q = middle + span.cwiseProduct(draw()), wanted = (i % 2 == 0 ? 0.3 : 1.0) * draw();
    if (q[1] + q[2] > 0.214) continue;
    const double step = 1e-6;
    const Vector<double> moved = q + step * draw().normalized();
    steepest = maximum(steepest, largest_entry(settled(moved, wanted) - settled(q, wanted)) / step);
  }
  MESSAGE("steepest ", steepest, " N m/rad");
  CHECK(steepest < 20);
  CHECK(steepest > 8);  // the bands were met
}

TEST_CASE("over random torques what is not near any limit passes whole") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  SafetyLimiter<Omni<>> limiter({.slew = Eigen::Vector3d(1e6, 1e6, 1e6)});
  const JointState<3> is{{0.1, 0.7, -1.4}, {0, 0, 0}};
  (void)limiter.limit(Time{0}, is, {0, 0, 0});
  for (int i = 1; i < 1000; ++i) {
    const Eigen::Vector3d wanted(uniform(random), uniform(random), uniform(random));
    const auto [torque, status] = limiter.limit(i * Time{1'000'000}, is, wanted);
    REQUIRE(status == Status::ok);
    REQUIRE(torque.value() == wanted);
  }
}
