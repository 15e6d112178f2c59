// SPDX-License-Identifier: MIT
#include <limpid/control/disturbance_observer.hpp>
#include <support/no_allocation.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

// The notes' figures hold with these conventions: the plant M v' + B v = F exactly discretised for a force held over
// the period, the velocity sampled at the tick, the observer started at rest one period before the first force, and
// that force given as the command. Cut-offs are 1/(2 pi tau).
using namespace limpid;
using namespace std::chrono_literals;

namespace {

constexpr std::array forms{ObserverForm::tustin, ObserverForm::step_invariant, ObserverForm::backward_euler};

template <typename Scalar>
Scalar micro(int number) {
  return Scalar(number) / Scalar(1'000'000);
}

template <typename Q, int Axes = 1>
DisturbanceObserver<Q, Axes> observer_of(const QFilterScalar<Q>& cutoff, ObserverForm form = ObserverForm::tustin) {
  using Scalar = QFilterScalar<Q>;
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  return DisturbanceObserver<Q, Axes>({.filter = {.cutoff = cutoff},
                                       .mass = Vector::Constant(micro<Scalar>(10'000)),
                                       .damping = Vector::Constant(micro<Scalar>(22'000)),
                                       .form = form});
}

template <typename Observer>
typename Observer::Output tick(Observer& observer, Time now, const typename Observer::Vector& command,
                               const typename Observer::Vector& hand, const typename Observer::Vector& velocity,
                               const typename Observer::Vector& applied) {
  return observer.update(now, command, typename Observer::OperatorForce(hand), velocity,
                         typename Observer::AppliedForce(applied));
}

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

namespace {

// A polynomial in tau s, with s by the rule of a form, in powers of z^-1.
template <std::size_t order>
std::array<double, order> discrete(const auto& p, double k, bool tustin) {
  std::array<double, order> sum{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::array<double, order> term{};
    term[0] = p[i];
    for (std::size_t factor = 0; factor + 1 < order; ++factor) {  // k (1 - 1/z), or what Tustin's rule divides by
      const double now = factor < i ? k : 1, before = factor < i ? -k : (tustin ? 1 : 0);
      for (std::size_t j = order; j-- > 0;) term[j] = now * term[j] + (j > 0 ? before * term[j - 1] : 0);
    }
    for (std::size_t j = 0; j < order; ++j) sum[j] += term[j];
  }
  return sum;
}

}  // namespace

// The observer solves for its force; the filters' difference equations, given that force, must say the same d_hat.
TEST_CASE_TEMPLATE("the force solves the algebraic loop, for random plants and signals", Q, FirstOrderQ<>,
                   ButterworthQ<>, UmenoHoriQ<>) {
  constexpr unsigned seed = 19631207;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  constexpr std::size_t order = Q::order + 1;
  using Observer = DisturbanceObserver<Q>;
  using Vector = typename Observer::Vector;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    const bool tustin = i % 2 == 0;
    const Q q{.cutoff = 5 + 200 * part(random)};
    const double m = 0.001 + part(random), b = part(random), tau = q.time_constant(), k = (tustin ? 2 : 1) * tau / 1e-3;
    Observer observer({.filter = q,
                       .mass = Vector(m),
                       .damping = Vector(b),
                       .form = tustin ? ObserverForm::tustin : ObserverForm::backward_euler});
    std::array<double, order> inverse_N{};  // of N (m s + b)
    for (std::size_t j = 0; j < q.numerator().size(); ++j) {
      inverse_N[j] += b * q.numerator()[j];
      inverse_N[j + 1] += m / tau * q.numerator()[j];
    }
    const auto N = discrete<order>(q.numerator(), k, tustin), P = discrete<order>(inverse_N, k, tustin);
    const auto D = discrete<order>(q.denominator(), k, tustin);
    std::array<double, order> force{}, velocity{}, d_hat{};  // the newest first
    (void)tick(observer, 0ms, Vector(0.0), Vector(0.0), Vector(0.0), Vector(0.0));
    double applied = 0, asked = 0, largest = 1, worst = 0;
    for (int t = 1; t < 200; ++t) {
      force[0] += applied - asked;  // a limiter gave less
      d_hat[0] += N[0] / D[0] * (applied - asked);
      for (auto* past : {&force, &velocity, &d_hat}) std::copy_backward(past->begin(), past->end() - 1, past->end());
      const double hand = part(random) - 0.5, v = 0.1 * (part(random) - 0.5);
      const auto output = tick(observer, t * 1ms, Vector(part(random)), Vector(hand), Vector(v), Vector(applied));
      asked = output.force[0];
      applied = asked * part(random);
      force[0] = asked + hand;
      velocity[0] = v;
      d_hat[0] = N[0] * force[0] - P[0] * v;
      for (std::size_t j = 1; j < order; ++j) {
        d_hat[0] += N[j] * force[j] - P[j] * velocity[j] - D[j] * d_hat[j];
      }
      d_hat[0] /= D[0];
      largest = std::max(largest, std::abs(asked));
      worst = std::max(worst, std::abs(d_hat[0] - output.disturbance[0]));
    }
    // D's roots may lie as near to 1 as 1 - .03, three of them together: its sums cancel to .03^3 and less
    CHECK(worst < 1e-8 * largest);
  }
}

// A hand alone: Q's step response 1 - exp(-t/tau), which the held force makes exact at any spacing of the ticks.
TEST_CASE("step-invariant, a held force is followed exactly over irregular ticks") {
  constexpr unsigned seed = 18240626;
  CAPTURE(seed);
  auto observer = observer_of<FirstOrderQ<>>(50, ObserverForm::step_invariant);
  using Vector = decltype(observer)::Vector;
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> step(1'000, 3'000'000);
  Time now{};
  (void)tick(observer, now, Vector(0.0), Vector(2.0), Vector(0.0), Vector(0.0));
  for (int k = 0; k < 300; ++k) {
    now += Time(step(random));
    const double exact = -2 * std::expm1(-in_seconds(now) * 100 * std::numbers::pi);
    const auto output = tick(observer, now, Vector(0.0), Vector(2.0), Vector(0.0), Vector(0.0));
    REQUIRE(std::abs(output.disturbance[0] - exact) < 300 * std::numeric_limits<double>::epsilon());
  }
}

// tau y' = t - y: y = t - tau (1 - exp(-t/tau)). Tustin's rule is off by (h/tau)^2/12 of a lag of tau, Euler's by h/2.
TEST_CASE("by Tustin and Euler a ramp is followed to their order over irregular ticks") {
  for (const bool tustin : {true, false}) {
    CAPTURE(tustin);
    auto observer = observer_of<FirstOrderQ<>>(50, tustin ? ObserverForm::tustin : ObserverForm::backward_euler);
    using Vector = decltype(observer)::Vector;
    const double tau = 1 / (100 * std::numbers::pi), h = 2e-4;
    std::mt19937 random(17070415);
    std::uniform_int_distribution<int> step(50'000, 200'000);
    Time now{};
    double worst = 0;
    (void)tick(observer, now, Vector(0.0), Vector(0.0), Vector(0.0), Vector(0.0));
    for (int k = 0; k < 300; ++k) {
      now += Time(step(random));
      const double t = in_seconds(now), exact = t + tau * std::expm1(-t / tau);
      // a command that keeps the device's force at 0 but for the error, which the loop raises by 1/(1 - q_0)
      const auto output = tick(observer, now, Vector(-exact), Vector(t), Vector(0.0), Vector(0.0));
      worst = std::max(worst, std::abs(output.disturbance[0] - exact));
    }
    CHECK(worst < (1 + h / tau) * (tustin ? tau * (h / tau) * (h / tau) / 12 : h / 2));
  }
}

TEST_CASE_TEMPLATE("an estimate at rest stays at rest when the ticks change", Q, FirstOrderQ<>, ButterworthQ<>,
                   UmenoHoriQ<>) {
  for (const auto form : forms) {
    CAPTURE(static_cast<int>(form));
    auto observer = observer_of<Q, 2>(50, form);
    using Vector = typename decltype(observer)::Vector;
    const Vector v(0.3, -0.2), hand(0.5, 0.1), disturbance(0.7, -0.4);
    const Vector force = 0.022 * v + disturbance - hand;
    Time now{};
    for (int k = 0; k < 400; ++k) {
      now += k < 300 ? Time(1ms) : Time(300us + k % 7 * 400us);
      const auto output = tick(observer, now, Vector(force - disturbance), hand, v, force);
      if (k > 300) REQUIRE((output.disturbance - disturbance).abs().maxCoeff() < 1e-12);
    }
  }
}

TEST_CASE("it starts at rest with what moves at that moment, and again after a long pause with its estimate") {
  auto observer = observer_of<UmenoHoriQ<>>(50);
  using Vector = decltype(observer)::Vector;
  const Vector v(0.3), force(0.022 * 0.3);
  for (int k = 0; k < 20; ++k) {
    const auto output = tick(observer, k * 1ms, force, Vector(0.0), v, force);
    REQUIRE(std::abs(output.disturbance[0]) < 1e-15);
  }
  const double before = tick(observer, 20ms, Vector(1.0), Vector(0.0), v, force).disturbance[0];
  CHECK(before != 0);
  const auto after = tick(observer, 20s, Vector(2.0), Vector(0.0), v, Vector(99.0));
  CHECK(after.disturbance[0] == before);
  CHECK(after.force[0] == 2 + before);
  const auto next = tick(observer, 20s + 1ms, Vector(2.0), Vector(0.0), v, Vector(force + before));
  CHECK(std::isfinite(next.force[0]));
}

// A disturbance of -3 N on a device that can give 1 N, held still by it for a second and then let go.
TEST_CASE("told of what was applied it does not wind up, told of what was asked it does") {
  const auto estimate = [](bool truth) {
    auto observer = observer_of<FirstOrderQ<>>(20);
    using Vector = decltype(observer)::Vector;
    Vector applied(0.0), asked(0.0);
    for (int k = 0; k < 1000; ++k) {
      asked = tick(observer, k * 1ms, Vector(1.5), Vector(0.0), Vector(0.0), truth ? applied : asked).force;
      applied = asked.min(1.0);
    }
    return asked[0] - 1.5;
  };
  // what is applied, 1 N, and of the force that is about to be, Q's direct part: told the truth it ends between
  CHECK(estimate(true) < 1.2);
  CHECK(estimate(true) > 0.99);
  CHECK(estimate(false) > 100);
}

TEST_CASE("a value that is not finite changes nothing, and the force is the command with the last estimate") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max()}) {
    for (const Time late : {Time(1ms), Time(2ms)}) {  // of the same length as the tick before, and of another
      for (int which = 0; which < 4; ++which) {
        CAPTURE(bad);
        CAPTURE(which);
        auto observer = observer_of<FirstOrderQ<>, 2>(50), undisturbed = observer;
        using Vector = decltype(observer)::Vector;
        Vector good(0.1, -0.2), broken(0.1, bad);
        typename decltype(observer)::Output last;
        for (auto* each : {&observer, &undisturbed}) {
          for (int k = 0; k < 3; ++k) last = tick(*each, k * 1ms, good, good, good, good);
        }
        const auto at = [&](int i) { return which == i ? broken : good; };
        const auto output = tick(observer, 2ms + late, at(0), at(1), at(2), at(3));
        CHECK(output.force.allFinite());
        if (!std::isfinite(bad)) {
          CHECK(has(output.status, Status::not_finite));
          CHECK((output.disturbance == last.disturbance).all());
          CHECK((output.force == (which == 0 ? last.force : Vector(good + last.disturbance))).all());
          const auto next = tick(observer, 5ms, good, good, good, good);
          CHECK((next.force == tick(undisturbed, 5ms, good, good, good, good).force).all());
          CHECK(next.status == Status::ok);
        }
      }
    }
  }
}

TEST_CASE("a command that is refused at a tick of another length leaves the state for the call that follows") {
  auto observer = observer_of<FirstOrderQ<>>(50);
  using Vector = decltype(observer)::Vector;
  const Vector good(0.3), none(0.0), bad(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 3; ++k) (void)tick(observer, k * 1ms, good, good, good, good);
  auto undisturbed = observer;
  CHECK(tick(observer, 5ms, bad, good, good, good).status == Status::not_finite);
  CHECK(tick(observer, 5ms, good, good, good, none).force[0] ==
        tick(undisturbed, 5ms, good, good, good, none).force[0]);
}

TEST_CASE("a first call that is not finite does not start it, a clock that stands changes nothing") {
  auto observer = observer_of<ButterworthQ<>>(50), undisturbed = observer;
  using Vector = decltype(observer)::Vector;
  const Vector bad(std::numeric_limits<double>::quiet_NaN()), some(0.25);
  const auto first = tick(observer, 0ms, some, bad, some, some);
  CHECK(first.force[0] == 0.25);
  CHECK(first.status == Status::not_finite);
  for (auto* each : {&observer, &undisturbed}) {
    (void)tick(*each, 5ms, some, some, some, some);
    (void)tick(*each, 6ms, some, some, some, some);
  }
  const auto stale = tick(observer, 6ms, some, Vector(7.0), Vector(8.0), Vector(9.0));
  CHECK(stale.status == Status::clock_backwards);
  CHECK((tick(observer, 7ms, some, some, some, some).force == tick(undisturbed, 7ms, some, some, some, some).force)
            .all());
}

TEST_CASE_TEMPLATE("no call allocates, of equal or other length", Q, FirstOrderQ<>, ButterworthQ<float>,
                   UmenoHoriQ<long double>) {
  for (const auto form : forms) {
    auto observer = observer_of<Q, 3>(50, form);
    using Vector = typename decltype(observer)::Vector;
    using Scalar = QFilterScalar<Q>;
    const Vector some = Vector::Constant(Scalar(0.25)), bad = some / Scalar(0);
    test::check_no_allocation([&] {
      for (int k = 0; k < 10; ++k) (void)tick(observer, k * k * 1ms, some, some, some, k == 5 ? bad : some);
      for (int k = 0; k < 10; ++k) (void)tick(observer, 1s + k * 1ms, some, some, some, some);
    });
  }
}

TEST_CASE("in double it is itself in 50 digits to some roundings") {
  using test::Fifty;
  for (const auto form : forms) {
    CAPTURE(static_cast<int>(form));
    auto rounded = observer_of<UmenoHoriQ<>>(50, form);
    auto exact = DisturbanceObserver<UmenoHoriQ<Fifty>>({.filter = {.cutoff = Fifty(50)},
                                                         .mass = Eigen::Array<Fifty, 1, 1>(Fifty(0.01)),
                                                         .damping = Eigen::Array<Fifty, 1, 1>(Fifty(0.022)),
                                                         .form = form});
    using One = Eigen::Array<double, 1, 1>;
    using OneFifty = Eigen::Array<Fifty, 1, 1>;
    std::mt19937 random(16421225);
    std::uniform_real_distribution<double> part(-1, 1);
    double worst = 0;
    Time now{};
    for (int k = 0; k < 300; ++k) {
      now += k < 200 ? Time(1ms) : Time(700us + k % 3 * 300us);
      const double command = part(random), hand = part(random), v = 0.1 * part(random), applied = part(random);
      const auto d = tick(rounded, now, One(command), One(hand), One(v), One(applied)).disturbance[0];
      const auto reference = tick(exact, now, OneFifty(Fifty(command)), OneFifty(Fifty(hand)), OneFifty(Fifty(v)),
                                  OneFifty(Fifty(applied)));
      worst = std::max(worst, std::abs(static_cast<double>(Fifty(d - reference.disturbance[0]))));
    }
    // forces to 2 N, rounded some 12 times a tick and remembered for 1/(1 - exp(-h/tau)) = 4 ticks, thrice in a row
    CHECK(worst < 12 * 4 * 3 * 2 * std::numeric_limits<double>::epsilon());
  }
}

TEST_CASE("settings that cannot serve are refused, and the hand has no default") {
  using Observer = DisturbanceObserver<FirstOrderQ<>, 2>;
  static_assert(!std::is_default_constructible_v<Observer::OperatorForce>);
  static_assert(!std::is_convertible_v<Observer::Vector, Observer::OperatorForce>);
  static_assert(!std::is_default_constructible_v<Observer::AppliedForce>);
  Observer::Settings settings{.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {0, 0}};
  CHECK_NOTHROW(Observer{settings});
  settings.mass[1] = 0;
  CHECK_THROWS_WITH_AS(Observer{settings}, "DisturbanceObserver: mass: expected finite and > 0, got 0.01 0",
                       std::invalid_argument);
  settings = {.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {-1, 0}};
  CHECK_THROWS_AS(Observer{settings}, std::invalid_argument);
  settings = {.filter = {.cutoff = -50}, .mass = {0.01, 0.02}, .damping = {0, 0}};
  CHECK_THROWS_AS(Observer{settings}, std::invalid_argument);
  settings = {.filter = {.cutoff = 50}, .mass = {0.01, 0.02}, .damping = {0, 0}, .longest_step = 0ms};
  CHECK_THROWS_WITH_AS(Observer{settings}, "DisturbanceObserver: longest_step: expected > 0 s, got 0 s",
                       std::invalid_argument);
}
