// SPDX-License-Identifier: MIT
#include <limpid/design/passivity_limits.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>

using namespace limpid;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Complex = std::complex<double>;

// K + B (z - 1)/(T z), as Colgate and Schenkel's wall samples its velocity.
auto transfer(const VirtualWall<>& wall, double period) {
  return [=](Complex z) { return wall.stiffness + wall.damping * (z - 1.0) / (period * z); };
}

}  // namespace

TEST_CASE("the notes' wall asks for a damping of 1.5 N s/m") {
  CHECK(colgate_schenkel_damping(VirtualWall<>{1000, 1}, 1e-3) == doctest::Approx(1.5).epsilon(1e-15));
}

TEST_CASE("at each frequency K T/2 - B cos(omega T) is asked for, and no more than in the worst case") {
  const VirtualWall<> wall{1000, 1};
  CHECK(colgate_schenkel_damping_at(wall, 1e-3, 0.0) == doctest::Approx(-0.5));
  CHECK(colgate_schenkel_damping_at(wall, 1e-3, 500 * std::numbers::pi) == doctest::Approx(0.5));
  CHECK(colgate_schenkel_damping_at(wall, 1e-3, 1000 * std::numbers::pi) == doctest::Approx(1.5));
}

TEST_CASE_TEMPLATE("stiffness, damping and period are the same limit solved for each", Scalar, float, double,
                   long double, Fifty) {
  const Scalar T = Scalar(1) / Scalar(1000), b = Scalar(3) / Scalar(2), B{1};
  const Scalar K = colgate_schenkel_stiffness(b, B, T);
  const Scalar few = 8 * std::numeric_limits<Scalar>::epsilon();  // of roundings
  using std::abs;
  CHECK(abs(K - Scalar(1000)) <= few * Scalar(1000));
  CHECK(abs(colgate_schenkel_damping(VirtualWall<Scalar>{K, B}, T) - b) <= few * b);
  CHECK(abs(colgate_schenkel_period(b, VirtualWall<Scalar>{K, B}) - T) <= few * T);
}

TEST_CASE("a device with less damping than the wall has no passive stiffness and no period") {
  CHECK(colgate_schenkel_stiffness(0.5, 1.0, 1e-3) == 0);
  CHECK(colgate_schenkel_period(1.0, VirtualWall<>{1000, 1}) == 0);
  CHECK(colgate_schenkel_period(1.1, VirtualWall<>{0, 1}) == infinity);
}

TEST_CASE("the sweep over a transfer function finds the closed form, whatever the sign of the damping") {
  std::mt19937 random(1797);
  std::uniform_real_distribution<double> stiffness(0, 5000), damping(-3, 3), period(2e-4, 5e-3);
  for (int i = 0; i < 20; ++i) {
    const VirtualWall<> wall{stiffness(random), damping(random)};
    const double T = period(random), exact = colgate_schenkel_damping(wall, T);
    CAPTURE(wall.stiffness);
    CAPTURE(wall.damping);
    const auto found = sampled_wall_damping(transfer(wall, T), T, 1000);
    // toward omega = 0 the sweep ends at 1e-6 pi, where cos is off by 5e-12 and sin rounds to 1e-16/3e-6 of K T/2
    CHECK(found.damping == doctest::Approx(exact).epsilon(1e-9));
    CHECK(found.omega * T == doctest::Approx(wall.damping > 0 ? std::numbers::pi : 0).epsilon(1e-5));
  }
}

TEST_CASE("a sample of delay adds a period of stiffness: b > 3 K T/2") {
  // H = K/z: Re{(1 - 1/z)/z}/(1 - cos) = (cos t - cos 2t)/(1 - cos t) = 2 cos t + 1 -> 3
  const auto found = sampled_wall_damping([](Complex z) { return 1000.0 / z; }, 1e-3);
  CHECK(found.damping == doctest::Approx(1.5).epsilon(1e-9));
}

TEST_CASE("a filter's peak inside the sweep is refined to more than its steps") {
  // two samples of the past with weights; the reference is a sweep of a million points
  const double T = 1e-3;
  const auto H = [](Complex z) { return 1000.0 - 300.0 / (z * z) + 200.0 / (z * z * z); };
  double reference = -infinity;
  for (int i = 1; i <= 1'000'000; ++i) {
    const double t = std::numbers::pi * i / 1e6;
    const Complex z(std::cos(t), std::sin(t));
    reference = maximum(reference, T / 2 / (1 - std::cos(t)) * ((1.0 - 1.0 / z) * H(z)).real());
  }
  // sought to sqrt(epsilon) in omega, so to epsilon in the value; the reference's 1 - cos cancels to 1e-16/5e-12 at
  // its first points, which are not its highest
  CHECK(sampled_wall_damping(H, T, 200).damping == doctest::Approx(reference).epsilon(1e-9));
}

TEST_CASE("no damping makes a wall passive that integrates: it is told as infinite") {
  const auto found = sampled_wall_damping([](Complex z) { return 1000.0 + 10.0 * z / (z - 1.0); }, 1e-3);
  CHECK(found.damping == infinity);
}

TEST_CASE("the notes' device of Diolaiti et al. shows 1200 N/m, by damping and by friction alike") {
  const FrictionalDevice<> device{.damping = 0.6, .friction = 0.006, .resolution = 10e-6};
  CHECK(diolaiti_stiffness(device, 1e-3) == doctest::Approx(1200).epsilon(1e-14));
  CHECK(diolaiti_stiffness({0.6, 0.003, 10e-6}, 1e-3) == doctest::Approx(600).epsilon(1e-14));
  CHECK(diolaiti_stiffness({0.3, 0.006, 10e-6}, 1e-3) == doctest::Approx(600).epsilon(1e-14));
  CHECK(diolaiti_stiffness({0.6, 0, 0}, 1e-3) == doctest::Approx(1200).epsilon(1e-14));
}

TEST_CASE("the device and the period that a stiffness asks for give that stiffness back") {
  const auto device = diolaiti_device(1200.0, 10e-6, 1e-3);
  CHECK(device.damping == doctest::Approx(0.6).epsilon(1e-14));
  CHECK(device.friction == doctest::Approx(0.006).epsilon(1e-14));
  CHECK(diolaiti_stiffness(device, 1e-3) == doctest::Approx(1200).epsilon(1e-14));
  CHECK(diolaiti_period({0.6, 0.007, 10e-6}, 1200.0) == doctest::Approx(1e-3).epsilon(1e-14));
  CHECK(diolaiti_period({0.6, 0.005, 10e-6}, 1200.0) == 0);
}

TEST_CASE("what cannot be a wall, a device or a period is refused by name") {
  CHECK_THROWS_WITH_AS((void)colgate_schenkel_damping(VirtualWall<>{-1, 0}, 1e-3),
                       "passivity limit: wall.stiffness: expected finite and >= 0, got -1", std::invalid_argument);
  CHECK_THROWS_AS((void)colgate_schenkel_damping(VirtualWall<>{1, 0}, 0.0), std::invalid_argument);
  CHECK_THROWS_AS((void)colgate_schenkel_stiffness(infinity, 0.0, 1e-3), std::invalid_argument);
  CHECK_THROWS_AS((void)diolaiti_stiffness(FrictionalDevice<>{1, -1, 0}, 1e-3), std::invalid_argument);
  CHECK_THROWS_AS((void)sampled_wall_damping([](Complex) { return Complex(1); }, 1e-3, 1), std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      (void)sampled_wall_damping([](Complex) { return Complex(1); }, 1e-3, std::numeric_limits<int>::max()),
      "sampled_wall_damping: steps: expected 2 to 1e8, got 2147483647", std::invalid_argument);
}
