// SPDX-License-Identifier: MIT
// Nominal mass and damping of an axis of the simulated five-bar, the other one locked, as section 2 of Eom, Suh and Yi
// has them measured. What they should be is M_xx and B_xx of (2) at that pose, by cartesian_dynamics.
#include <limpid/device/simulated_five_bar.hpp>
#include <limpid/estimation/frequency_identification.hpp>
#include <limpid/robot/cartesian_dynamics.hpp>

#include <support/permit.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace std::chrono_literals;
using limpid::FiveBar;
using limpid::IdentifiedAxis;
using limpid::Realism;
using limpid::ResponseSample;
using limpid::SimulatedFiveBar;
using limpid::Status;

namespace {

constexpr double T = 1e-3;
constexpr int ticks = 4'000;

struct Trial {
  Realism realism = Realism::ideal;
  int axis = 0;
  double amplitude = 1e-3;  // N
  std::vector<double> frequencies{2, 5, 10, 20};
};

// Motors that push along the axis, a cosine from rest, and the tip's velocity: as the ideal device tells it; on a
// realistic one by central differences of the angles, which have no lag, where its filtered rates would.
ResponseSample<double> response(const Trial& trial, double hertz) {
  const FiveBar<> robot;
  SimulatedFiveBar<> device({.realism = trial.realism, .locked = {trial.axis == 1, trial.axis == 0}});
  const double omega = 2 * std::numbers::pi * hertz, sine = omega * T / std::sin(omega * T);  // of the difference
  std::vector<double> force, x, velocity;
  for (int k = 0; k < ticks; ++k) {
    REQUIRE(device.advance(k * 1ms, {0, 0, 0}) == Status::ok);
    const auto seen = device.read(k * 1ms);
    const auto pose = robot.at(seen.q);
    const Eigen::RowVector2d J = pose.jacobian().row(trial.axis);
    force.push_back(trial.amplitude * std::cos(omega * k * T));
    x.push_back(pose.position()[trial.axis]);
    velocity.push_back(J * seen.qdot);
    (void)device.write(limpid::test::permit(robot, J.transpose() * force.back()));
  }
  if (trial.realism == Realism::realistic) {
    for (std::size_t k = 1; k + 1 < x.size(); ++k) velocity[k] = sine * (x[k + 1] - x[k - 1]) / (2 * T);
    for (auto* record : {&force, &velocity}) record->pop_back();
  }
  return limpid::response_of_record<double>(force, velocity, T, omega, static_cast<int>(hertz));
}

IdentifiedAxis<double> identified(const Trial& trial) {
  std::vector<ResponseSample<double>> samples;
  for (const double hertz : trial.frequencies) samples.push_back(response(trial, hertz));
  return limpid::identify_axis<double>(samples);
}

struct Axis {
  double mass, damping;
};

Axis told_by_dynamics(int axis) {
  const FiveBar<> robot;
  const auto tip = limpid::cartesian_dynamics(robot, robot.theta_of({}), {SimulatedFiveBar<>::start_pose(), {0, 0}});
  return {tip.M_x(axis, axis), tip.B_x(axis, axis)};
}

}  // namespace

TEST_CASE("the ideal device's nominal mass and damping are M_xx and B_xx at the notes' pose") {
  CHECK(told_by_dynamics(0).mass == doctest::Approx(0.014848).epsilon(4e-5));  // the notes' digits
  CHECK(told_by_dynamics(0).damping == doctest::Approx(0.045845).epsilon(2e-5));
  for (const int axis : {0, 1}) {
    const auto [mass, damping] = told_by_dynamics(axis);
    const auto found = identified({.axis = axis});
    CAPTURE(axis);
    CHECK(found.physical);
    // the tip moves up to 1.6 mm away, less than a hundredth of its distance from the base, and equally to and fro
    CHECK(std::abs(found.mass - mass) < 2e-4 * mass);
    CHECK(std::abs(found.damping - damping) < 1e-3 * damping);
    CHECK(found.misfit < 2e-4);
  }
}

namespace {

// The tip's Coulomb friction along x, y locked: the joints' f_s times how fast they turn for the tip.
double coulomb_force() {
  const FiveBar<> robot;
  const limpid::JointState<2> still{SimulatedFiveBar<>::start_pose(), {0, 0}};
  return 2e-3 * limpid::cartesian_dynamics(robot, robot.theta_of({}), still).J_inverse.col(0).cwiseAbs().sum();
}

}  // namespace

// A friction of constant size f, in phase with a sine of the velocity V, has 4 f/pi at its frequency.
TEST_CASE("Coulomb friction adds 4 f/(pi V) to the damping: the smaller the motion the more") {
  const auto [mass, damping] = told_by_dynamics(0);
  const double f = coulomb_force();  // 0.018 N
  double last = 10;
  for (const double amplitude : {0.05, 0.1, 0.2}) {
    CAPTURE(amplitude);
    const Trial trial{.realism = Realism::realistic, .amplitude = amplitude, .frequencies = {10}};
    const double V = amplitude * std::abs(response(trial, 10).response);
    const auto found = identified(trial);
    // the bending of the joints before they slip takes of the mass, more at small motion; the pose changes at large
    CHECK(found.mass == doctest::Approx(mass).epsilon(0.15));
    CHECK(found.damping == doctest::Approx(damping + 4 * f / (std::numbers::pi * V)).epsilon(0.06));
    CHECK(found.damping < last);
    last = found.damping;
  }
}

TEST_CASE("a force below the friction finds a spring, and the answer says that it is no axis of mass and damping") {
  const auto found = identified({.realism = Realism::realistic, .amplitude = 0.01, .frequencies = {10}});
  CHECK_FALSE(found.physical);
  CHECK(found.mass < 0);
}

TEST_CASE("over several frequencies the misfit shows that friction is not viscous") {
  const Trial trial{.realism = Realism::realistic, .amplitude = 0.05, .frequencies = {5, 10, 20}};
  CHECK(identified(trial).misfit > 0.05);
  CHECK(identified({.amplitude = 0.001, .frequencies = {5, 10, 20}}).misfit < 2e-4);
}
