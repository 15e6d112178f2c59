// SPDX-License-Identifier: MIT
#include "common/calibrate_ramp.hpp"
#include "common/calibrate_scale.hpp"
#include "common/calibrate_tuning.hpp"

#include <limpid/robot/omni_device.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

using namespace limpid;
using namespace limpid::examples;

namespace {

// A loop of the rigid joint: it sticks until the drive is beyond the friction. `A`: the command's amplitude.
std::vector<RampSample> stiff_loop(const RampResult& joint, double A) {
  std::vector<RampSample> loop;
  double measured = joint.offset;
  for (int i = 0; i < 5000; ++i) {
    const double way = i * 1e-3 * A, command = way < A ? way : way < 3 * A ? 2 * A - way : way - 4 * A;
    const double drive = std::clamp(joint.conversion * command, -joint.limit, joint.limit) + joint.offset;
    measured = std::clamp(measured, drive - joint.friction, drive + joint.friction);
    if (way >= A) loop.push_back({command, measured, way >= 3 * A});
  }
  return loop;
}

// The tuning run as an arm of these parameters would need it to be followed exactly.
std::vector<TuningSample> exact_run(const Omni<>::Parameters& theta, const Eigen::Vector3d& friction) {
  const auto torque = [&](double t) -> Eigen::Vector3d {
    const auto is = tuning_reference(t, tuning_pose());
    const Eigen::Vector3d sign = is.qdot.array().sign().matrix();
    return Omni<>{}.at(is.q).regressor(is.qdot, is.qddot) * theta + friction.cwiseProduct(sign);
  };
  std::vector<TuningSample> record;
  for (int i = 0; i <= 30'000; ++i) {
    const double t = 1e-3 * i;
    record.push_back({t, tuning_reference(t, tuning_pose()).q, torque(t + 5e-4), Eigen::Vector3d::Zero(), theta});
  }
  return record;
}

double largest_error(const Eigen::VectorXd& found, const Eigen::VectorXd& truth) {
  return ((found - truth).array() / truth.array()).abs().maxCoeff();
}

}  // namespace

TEST_CASE("the loop of a rigid joint gives conversion, limit, friction and weight back") {
  for (const RampResult& joint : {RampResult{-1, 0.3, 0.065, 0}, {1, 0.29, 0.065, -0.11}, {1.43, 0.2, 0.028, 0.05}}) {
    const RampResult found = evaluate_ramp(stiff_loop(joint, 0.5));
    CHECK(found.conversion == doctest::Approx(joint.conversion).epsilon(1e-12));  // rounding
    CHECK(found.limit == doctest::Approx(joint.limit).epsilon(1e-12));
    CHECK(found.friction == doctest::Approx(joint.friction).epsilon(1e-12));
    CHECK(std::abs(found.offset - joint.offset) < 1e-12);
  }
}

TEST_CASE("a ramp that ends below the motors' limit finds none, and the rest as well") {
  const RampResult found = evaluate_ramp(stiff_loop({1, 0.3, 0.02, 0}, 0.25));
  CHECK(std::isnan(found.limit));
  CHECK(found.conversion == doctest::Approx(1).epsilon(1e-12));
  CHECK(found.friction == doctest::Approx(0.02).epsilon(1e-12));
}

TEST_CASE("what is no loop is refused") {
  CHECK_THROWS_AS((void)evaluate_ramp({}), std::invalid_argument);
  auto loop = stiff_loop({1, 0.3, 0.02, 0}, 0.4);
  loop.resize(1500);  // falls only
  CHECK_THROWS_AS((void)evaluate_ramp(loop), std::invalid_argument);
}

// The weight changes as the sensor gives way: by 0.09 N m/rad over 0.3 N m / (17 N m/rad), half a per cent of the
// torque. The joint creeps at 0.04/17 rad/s, which adds 0.145 times that to the friction: another half, and as much by
// what the weight does on one way and not on the other.
TEST_CASE("ramps on the simulated arm find Table 5.1 and (5.5)") {
  const JointLimits<3> limits = Omni<>{}.limits();
  const Eigen::Vector3d gain = OmniDevice<>::torque(Eigen::Vector3d::Ones());
  const Eigen::Vector3d weight = Omni<>{}.at({0, 0.785398, -1.25}).tau_g(Omni<>::table_5_2());
  for (int i = 0; i < 3; ++i) {
    CAPTURE(i);
    const RampResult found = evaluate_ramp(simulate_ramp(i));
    CHECK(found.conversion == doctest::Approx(gain[i]).epsilon(0.01));
    CHECK(found.limit == doctest::Approx(limits.torque[i]).epsilon(0.01));
    CHECK(found.friction == doctest::Approx(limits.static_friction[i]).epsilon(0.02));
    CHECK(std::abs(found.offset + weight[i]) < 0.002);
  }
}

// A cubic over +-60 ms takes 3/14 (omega 0.06 s)^2 of a sine's second derivative, at 0.6 pi rad/s 0.3 %.
TEST_CASE("of an exact run the least squares give the parameters and the friction") {
  Omni<>::Parameters theta;
  theta << 0.005, 0.006, 0.007, 0.001, 0.01, 0.004, 0.1, 0.2, 0.05;
  const Eigen::Vector3d friction(0.03, 0.05, 0.02);
  const TuningResult found = evaluate_tuning(exact_run(theta, friction));
  CHECK(largest_error(found.fitted, theta) < 0.02);
  CHECK(largest_error(found.friction, friction) < 0.003);
  CHECK(largest_error(found.adapted, theta) < 1e-12);  // rounding of 10 000 sums
}

TEST_CASE("of the simulated tuning run the fit finds Table 5.2, and adaptation does not: 5.2.8") {
  const Omni<>::Parameters theta = Omni<>::table_5_2();
  TuningTask::Settings settings;
  settings.theta0 = 1.25 * theta;
  const TuningTask task = simulate_tuning(settings);
  const TuningResult found = evaluate_tuning(task.record());
  CHECK(!has(task.status(), Status::fault));
  // of gravity and viscous friction, which make the torque: 0.0004 N m are left of some 0.1
  CHECK(largest_error(found.fitted.tail<5>(), theta.tail<5>()) < 0.01);
  // inertias move 0.005 N m of it, less than a tenth of which is left
  CHECK(largest_error(found.fitted.head<4>(), theta.head<4>()) < 0.1);
  CHECK(largest_error(found.friction, Omni<>{}.limits().static_friction) < 0.01);
  CHECK(largest_error(found.adapted, theta) > 0.2);
}

TEST_CASE("a tuning run begins at rest where the arm is, without a step") {
  TuningTask::Settings settings;
  settings.blend = std::chrono::seconds(5);
  const TuningTask task = simulate_tuning(settings);
  CHECK(task.record().front().error.norm() == 0);
  CHECK(!has(task.status(), Status::fault));
}

TEST_CASE("a tuning run ends without torque where a reading is none") {
  TuningTask task({});
  DeviceState<3> seen;
  seen.q = tuning_pose();
  (void)task.tick(Time{0}, seen, Time{0});
  seen.q[1] = std::numeric_limits<double>::quiet_NaN();
  const auto result = task.tick(std::chrono::milliseconds(1), seen, std::chrono::milliseconds(1));
  CHECK(has(result.status, Status::fault));
  CHECK(result.torque.value() == Eigen::Vector3d::Zero());
}

TEST_CASE("full scale is the slope of measured torque over the part of the range, through (5.5)") {
  // joint 1: -0.35 N m at full scale; joint 2: 0.4 and a weight; joint 3: 1.43 x 0.2
  const std::vector<MeasuredTorque> measured{{0, 0.1, -0.035},     {0, -0.3, 0.105}, {1, 0.2, 0.08 - 0.1},
                                             {1, 0.4, 0.16 - 0.1}, {2, 0, 0},        {2, 0.5, 0.143}};
  CHECK((full_scale_of(measured) - Eigen::Vector3d(0.35, 0.4, 0.2)).norm() < 1e-12);
}

TEST_CASE("measured torques of the wrong sign, or too few, are refused by their joint") {
  const auto refused = [](const std::vector<MeasuredTorque>& measured, const std::string& joint) {
    try {
      (void)full_scale_of(measured);
      FAIL("accepted");
    } catch (const std::invalid_argument& error) {
      CHECK(std::string(error.what()).find(joint) != std::string::npos);
    }
  };
  refused({{0, 0, 0}, {0, 0.5, 0.1}, {1, 0, 0}, {1, 1, 1}, {2, 0, 0}, {2, 1, 1}}, "joint 1");
  refused({{0, 0, 0}, {0, 0.5, -0.1}, {1, 1, 1}, {2, 0, 0}, {2, 1, 1}}, "joint 2");
  refused({{0, 0, 0}, {0, 0.5, -0.1}, {1, 0, 0}, {1, 1, 1}, {2, 0.5, 0}, {2, 0.5, 1}}, "joint 3");
}

TEST_CASE("measured torques are read from lines, and wrong lines refused by their number") {
  const std::string path = (std::filesystem::temp_directory_path() / "limpid_measured_torques.csv").string();
  std::ofstream(path) << "# joint,part,torque\n\n1,0.5,-0.1\n3,-1,0.2\r\n";
  const auto measured = read_measured_torques(path);
  REQUIRE(measured.size() == 2);
  CHECK(measured[1].joint == 2);
  CHECK(measured[1].part == -1);
  CHECK(measured[1].torque == 0.2);
  for (const char* wrong : {"4,0.5,1", "1,2,1", "1,0.5", "1.5,0.5,1", "1,x,1", "1,0.5,nan"}) {
    std::ofstream(path) << "1,0.5,1\n" << wrong << "\n";
    CAPTURE(wrong);
    CHECK_THROWS_WITH_AS((void)read_measured_torques(path), doctest::Contains(":2: expected"), std::invalid_argument);
  }
  std::filesystem::remove(path);
}
