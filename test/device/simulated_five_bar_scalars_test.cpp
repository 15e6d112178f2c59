// SPDX-License-Identifier: MIT
#include <limpid/device/simulated_five_bar.hpp>

#include <conformance/haptic_device_suite.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

using limpid::HapticDevice;
using limpid::Realism;
using limpid::SimulatedFiveBar;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

static_assert(HapticDevice<SimulatedFiveBar<float>> && HapticDevice<SimulatedFiveBar<long double>>);

TEST_CASE_TEMPLATE("the simulated five-bar is a haptic device", Scalar, float, long double) {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedFiveBar<Scalar> device({.realism = realism});
    limpid::test::check_haptic_device(
        device, [&](Time now) { CHECK(device.advance(now, Eigen::Matrix<Scalar, 3, 1>::Zero()) == Status::ok); },
        [&] { device.disconnect(); });
  }
}

TEST_CASE("float tells the story of long double") {
  SimulatedFiveBar<float> device({.realism = Realism::realistic});
  SimulatedFiveBar<long double> reference({.realism = Realism::realistic});
  for (int k = 0; k <= 50; ++k) {
    const Eigen::Vector3d F_h(0.2 * std::sin(0.1 * k), 0.1, 0);
    (void)device.advance(k * 1ms, F_h.cast<float>());
    (void)reference.advance(k * 1ms, F_h.cast<long double>());
  }
  const Eigen::Matrix<long double, 2, 1> moved = reference.true_state().q - SimulatedFiveBar<long double>::start_pose();
  CHECK(moved.norm() > 0.01L);
  const Eigen::Matrix<long double, 2, 1> off = device.true_state().q.cast<long double>() - reference.true_state().q;
  CHECK(off.norm() < 1e-4L);  // 50 steps of float's tolerance of 2e-6
}
