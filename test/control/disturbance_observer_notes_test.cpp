// SPDX-License-Identifier: MIT
#include <limpid/control/disturbance_observer.hpp>
#include <support/disturbance_observer.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

// The notes' figures hold with these conventions: the plant M v' + B v = F exactly discretised for a force held over
// the period, the velocity sampled at the tick, the observer started at rest one period before the first force, and
// that force given as the command. Cut-offs are 1/(2 pi tau).
using namespace limpid;
using namespace limpid::test;
using namespace std::chrono_literals;

namespace {

// The notes' five-bar under observers, at 1 kHz.
template <typename Q>
class FiveBar {
 public:
  using Scalar = QFilterScalar<Q>;
  using Observer = DisturbanceObserver<Q, 2>;
  using Vector = typename Observer::Vector;

  FiveBar(const Scalar& cutoff, ObserverForm form) : observer_{observer_of<Q, 2>(cutoff, form)} {
    Matrix B, inverse;  // of M, by hand
    B << micro<Scalar>(45845), micro<Scalar>(-11546), micro<Scalar>(-11546), micro<Scalar>(14866);
    inverse << micro<Scalar>(7662), micro<Scalar>(2748), micro<Scalar>(2748), micro<Scalar>(14848);
    inverse /= inverse(0, 0) * inverse(1, 1) - inverse(0, 1) * inverse(1, 0);
    const auto exact = held_step(Matrix(-inverse.lazyProduct(B)), Scalar(1) / Scalar(1000));
    Phi_ = exact.Phi;
    Gamma_ = exact.Psi.lazyProduct(inverse);
    (void)tick(observer_, now_, Vector(Vector::Zero()), none_, v, force_);
  }

  void press(const Vector& command) {
    now_ += 1ms;
    force_ = tick(observer_, now_, command, none_, v, force_).force;
    v = (Phi_.lazyProduct(v.matrix()) + Gamma_.lazyProduct(force_.matrix())).array().eval();
  }

  Vector v = Vector::Zero();

 private:
  using Matrix = Eigen::Matrix<Scalar, 2, 2>;
  Observer observer_;
  Matrix Phi_, Gamma_;
  Vector none_ = Vector::Zero(), force_ = Vector::Zero();
  Time now_{};
};

// |vy/vx| at 5 Hz for a force along x, after 15 s, in which the slowest mode of 0.45 s dies away.
template <typename Q>
double coupling(double cutoff) {
  FiveBar<Q> device(cutoff, ObserverForm::tustin);
  std::complex<double> x = 0, y = 0;
  for (int k = 0; k < 15'200; ++k) {
    const std::complex<double> turn = std::polar(1.0, 2 * std::numbers::pi * k / 200);
    if (k >= 15'000) {
      x += device.v[0] * turn;
      y += device.v[1] * turn;
    }
    device.press({0.01 * turn.real(), 0});
  }
  return std::abs(y) / std::abs(x);
}

template <typename Q>
void check_couplings(const std::array<double, 6>& printed, const std::array<double, 6>& last_digit) {
  constexpr std::array cutoffs{5.0, 10.0, 20.0, 50.0, 100.0, 200.0};
  for (std::size_t i = 0; i < cutoffs.size(); ++i) {
    CAPTURE(cutoffs[i]);
    const double ratio = coupling<Q>(cutoffs[i]);
    if (printed[i] > 0) {
      CHECK(std::abs(ratio - printed[i]) < 0.51 * last_digit[i]);
    } else {
      CHECK_FALSE(ratio < 1e6);  // unstable
    }
  }
}

// One axis, the nominal plant itself, its v against the hand's: response to sin at 5 Hz, or end of a -5 N press on a
// wall of 1000 N/m, 15 N s/m.
struct Pressed {
  DisturbanceObserver<FirstOrderQ<>> observer = observer_of<FirstOrderQ<>>(50);
  using Vector = DisturbanceObserver<FirstOrderQ<>>::Vector;
  double decay = std::exp(-2.2e-3), x = 0, v = 0;
  Vector force = Vector::Zero();
  Time now{};

  void step(double command, double hand, double told) {
    now += 1ms;
    force = tick(observer, now, Vector(command), Vector(told), Vector(v), force).force;
    const double total = (force[0] + hand) / 0.022;  // v tends to it
    x += total * 1e-3 + (v - total) * (1 - decay) / 2.2;
    v = total + (v - total) * decay;
  }
};

double end_of_press(bool told) {
  Pressed device;
  for (int k = 0; k < 3000; ++k) device.step(-(1000 * device.x + 1 * device.v), -5, told ? -5 : 0);
  return device.x;
}

// The response to a hand of 5 Hz.
double response(bool told) {
  Pressed device;
  std::complex<double> sum = 0;
  for (int k = 0; k < 15'200; ++k) {
    const std::complex<double> turn = std::polar(1.0, 2 * std::numbers::pi * k / 200);
    if (k >= 15'000) sum += device.v * turn;
    device.step(0, turn.real(), told ? turn.real() : 0);
  }
  return std::abs(sum) / 100;
}

}  // namespace

TEST_CASE_TEMPLATE("the notes' sequence comes out to its digits", Scalar, float, double, long double) {
  FiveBar<FirstOrderQ<Scalar>> device(50, ObserverForm::tustin);
  // the notes print 12 digits and more; float has 100 ticks to round in
  const double tolerance = std::max(2e-13, 300 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
  const auto check = [&](double x, double y) {
    CHECK(static_cast<double>(device.v[0]) == doctest::Approx(x).epsilon(tolerance).scale(0.0));
    CHECK(static_cast<double>(device.v[1]) == doctest::Approx(y).epsilon(tolerance * x / y).scale(0.0));
  };
  for (int k = 1; k <= 100; ++k) {
    device.press({Scalar(1) / Scalar(100), Scalar(0)});
    if (k == 1) check(8.3350070345555e-4, 2.99275552490776e-4);
    if (k == 10) check(8.97004746171453e-3, 8.26196158849901e-4);
    if (k == 100) check(.0885987214469432, 8.41353732753181e-4);
  }
}

TEST_CASE("the notes' table of coupling ratios comes out to its digits") {
  check_couplings<FirstOrderQ<>>({.2222, .1302, .0682, .0276, .01383, .00692}, {1e-4, 1e-4, 1e-4, 1e-4, 1e-5, 1e-5});
  check_couplings<ButterworthQ<>>({.4417, .2161, .1010, .0394, .0196, .0098}, {1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4});
  check_couplings<UmenoHoriQ<>>({.3461, .1445, .0461, .00813, .00206, 0}, {1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1});
}

TEST_CASE("with the operator's force the -5 N press ends at -5 mm, without it at 0") {
  CHECK(end_of_press(true) == doctest::Approx(-5e-3).epsilon(1e-6));
  CHECK(std::abs(end_of_press(false)) < 1e-9);
}

TEST_CASE("without the operator's force the response to a hand of 5 Hz falls to 0.099 of nominal") {
  // |1 - Q| = 1/sqrt(1 + 10^2) = 0.0995, which the notes cut off to 0.099
  CHECK(std::abs(response(false) / response(true) - 1 / std::sqrt(101.0)) < 1e-4);
  // told of the hand, the device is its nominal plant, 1/|j w m + b|; that the hand is held for T looks like a
  // disturbance of w T/2 of it, of which w tau falls into phase: 1.6e-3
  CHECK(response(true) == doctest::Approx(1 / std::abs(std::complex(0.022, 0.1 * std::numbers::pi))).epsilon(2e-3));
}
