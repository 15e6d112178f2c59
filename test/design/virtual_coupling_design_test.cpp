// SPDX-License-Identifier: MIT
#include <limpid/design/virtual_coupling_design.hpp>
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

constexpr CoupledDevice<> device{.damping = 0.022, .period = 1e-3};

// The b at which Re(1/Z_c) = |ZOH| (1 - cos(angle ZOH))/(2 b), in complex numbers as it is printed.
double printed_damping_at(const CouplingGains<>& gains, double T, double omega) {
  using Complex = std::complex<double>;
  const Complex z = std::polar(1.0, omega * T), zoh = (z + 1.0) / (2.0 * z);
  const Complex Z_c = gains.damping + gains.stiffness * T * z / (z - 1.0);
  return std::abs(zoh) * (1 - std::cos(std::arg(zoh))) / 2 / (1.0 / Z_c).real();
}

// The highest of `count` frequencies.
double swept_damping(const CouplingGains<>& gains, double T, int count) {
  double worst = 0;
  for (int i = 1; i < count; ++i) {
    worst = maximum(worst, printed_damping_at(gains, T, std::numbers::pi / T * i / count));
  }
  return worst;
}

}  // namespace

TEST_CASE("without damping K_c may be 8 b/T, which is 176 N/m for the notes' device") {
  CHECK(largest_coupling_stiffness(0.0, device) == doctest::Approx(176).epsilon(1e-14));
}

TEST_CASE("the stiffest coupling is the notes': K_c = 9.350561 b/T = 205.712 N/m") {
  const auto gains = stiffest_coupling(device);
  CHECK(std::abs(gains.stiffness * device.period / device.damping - 9.350561) < 5e-7);  // to the digits given
  CHECK(std::abs(gains.stiffness - 205.712) < 5e-4);
  // the notes' B_c = 1.167042 b is where a flat maximum was sought; the cubic's root in 40 digits
  // gives 1.16704855191134
  CHECK(gains.damping / device.damping == doctest::Approx(1.16704855191134).epsilon(1e-13));
  CHECK(gains.damping / device.damping == doctest::Approx(1.167042).epsilon(1e-5));
  CHECK(largest_coupling_stiffness(1.167042 * device.damping, device) ==
        doctest::Approx(gains.stiffness).epsilon(1e-10));
}

TEST_CASE("the stiffest coupling is a maximum of the largest stiffness over the damping") {
  const auto best = stiffest_coupling(device);
  CHECK(largest_coupling_stiffness(best.damping, device) == doctest::Approx(best.stiffness).epsilon(1e-13));
  for (int i = 0; i <= 800; ++i) {
    CHECK(largest_coupling_stiffness(i * device.damping / 100, device) <= best.stiffness * (1 + 1e-14));
  }
}

TEST_CASE("what a coupling asks of the device is what the printed condition asks, at every frequency") {
  std::mt19937 random(1999);
  std::uniform_real_distribution<double> stiffness(0.1, 400), damping(0, 0.3), part(1e-3, 0.999);
  for (int i = 0; i < 2000; ++i) {
    const CouplingGains<> gains{stiffness(random), damping(random)};
    const double omega = part(random) * std::numbers::pi / device.period;
    // 1 - cos of the angle cancels to 1e-16/1e-6 at the lowest of the angles
    CHECK(coupling_damping_at(gains, device.period, omega) ==
          doctest::Approx(printed_damping_at(gains, device.period, omega)).epsilon(1e-8));
  }
}

TEST_CASE("stability is that of a sweep over the frequencies, and its damping the highest of them") {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> stiffness(0, 300), damping(0, 0.2);
  int stable = 0;
  for (int i = 0; i < 300; ++i) {
    const CouplingGains<> gains{stiffness(random), i % 10 == 0 ? 0 : damping(random)};
    CAPTURE(gains.stiffness);
    CAPTURE(gains.damping);
    const auto verdict = coupling_stability(gains, device);
    const double swept = swept_damping(gains, device.period, 2000);
    CHECK(verdict.needed_damping >= swept * (1 - 1e-9));
    // one step of the sweep, 1.6e-3 rad, from the highest point or from the end at omega = 0, where the curve falls
    // with x^2's 6e-7 times (r/u)^2, below 1e4 here but for the softest couplings
    if (gains.stiffness > 10) CHECK(swept >= verdict.needed_damping * (1 - 2e-3));
    CHECK(verdict.stable == (verdict.needed_damping <= device.damping));
    CHECK(coupling_damping_at(gains, device.period, verdict.omega) == doctest::Approx(verdict.needed_damping));
    stable += verdict.stable;
  }
  CHECK(stable > 30);
  CHECK(stable < 270);
}

TEST_CASE("just below the largest stiffness a coupling is stable, just above it is not") {
  for (const double beta : {0.0, 0.1, 0.5, 0.6, 1.0, 1.167, 2.0, 3.0, 5.0, 6.5, 7.9}) {
    CAPTURE(beta);
    const double B_c = beta * device.damping, K_c = largest_coupling_stiffness(B_c, device);
    CHECK(coupling_stability({K_c * (1 - 1e-9), B_c}, device).stable);
    CHECK_FALSE(coupling_stability({K_c * (1 + 1e-9), B_c}, device).stable);
  }
}

TEST_CASE("a coupling of 8 b takes no stiffness and one of more cannot be had") {
  CHECK(largest_coupling_stiffness(8 * device.damping, device) == doctest::Approx(0).epsilon(1e-12));
  CHECK(std::isnan(largest_coupling_stiffness(8.01 * device.damping, device)));
}

TEST_CASE_TEMPLATE("every scalar finds the same design to its own digits", Scalar, float, double, long double) {
  const auto exact = stiffest_coupling(CoupledDevice<Fifty>{Fifty(1), Fifty(1)});
  const auto found = stiffest_coupling(CoupledDevice<Scalar>{Scalar{1}, Scalar{1}});
  const Scalar few = 64 * std::numeric_limits<Scalar>::epsilon();  // r - u cancels five-fold, the rest few roundings
  CHECK(std::abs(found.stiffness - static_cast<Scalar>(exact.stiffness)) <= few * found.stiffness);
  CHECK(std::abs(found.damping - static_cast<Scalar>(exact.damping)) <= few * found.stiffness);
  // the cubic itself, in 50 digits
  const Fifty r = exact.damping + exact.stiffness / 2;
  CHECK(abs(2 * r * r * r - 9 * r * r - 15 * r - 4) < Fifty("1e-45"));
}

TEST_CASE("a coupling of any size asks for as much in its own units, and never for what is no number") {
  for (const CouplingGains<> gains : {CouplingGains<>{100, 0.1}, CouplingGains<>{400, 0}, CouplingGains<>{0, 1}}) {
    const auto usual = coupling_stability(gains, device);
    for (const double unit : {1e-290, 1e-200, 1e200, 1e290}) {
      CAPTURE(unit);
      const auto found = coupling_stability({gains.stiffness * unit, gains.damping * unit}, device);
      CHECK(found.needed_damping == doctest::Approx(usual.needed_damping * unit).epsilon(1e-14));
      CHECK(found.omega == doctest::Approx(usual.omega).epsilon(1e-7));  // the root of a flat top
    }
  }
  for (const double period : {std::numeric_limits<double>::denorm_min(), 1e300}) {
    const auto found = coupling_stability<double>({1e200, 1}, {1, period});
    CHECK_FALSE(std::isnan(found.needed_damping));
    CHECK(found.stable == (period < 1));
  }
}

TEST_CASE("a device without damping, without a period, and couplings below zero are refused") {
  CHECK_THROWS_WITH_AS((void)stiffest_coupling(CoupledDevice<>{0, 1e-3}),
                       "CoupledDevice: damping: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_AS((void)stiffest_coupling(CoupledDevice<>{1, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)largest_coupling_stiffness(-1.0, device), std::invalid_argument);
  CHECK_THROWS_AS((void)coupling_stability({-1, 0}, device), std::invalid_argument);
}
