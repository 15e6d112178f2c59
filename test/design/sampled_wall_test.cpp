// SPDX-License-Identifier: MIT
#include "eigen_instances.hpp"

#include <limpid/design/sampled_wall.hpp>
#include <limpid/design/sampled_wall_interval.hpp>
#include <limpid/design/sampled_wall_proof.hpp>
#include <limpid/signal/filtered_derivative.hpp>
#include <limpid/signal/low_pass.hpp>

#include "support/precision.hpp"

#include <Eigen/Eigenvalues>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <deque>
#include <random>

using namespace limpid;
using limpid::test::Fifty;

namespace {

// The wall of Eom, Suh and Yi, section 4.
const HapticPlant<> nominal{.mass = 0.01, .damping = 0.022};
constexpr double K = 1000, T = 0.001;
const PlantBox<> uncertain = PlantBox<>::around(nominal, {.alpha = 0.5, .beta = 0.5});

SampledWall<> loop_with(VelocitySource velocity, double delay = 0) {
  return {.period = T, .delay = delay, .velocity = velocity};
}

/// The loop ticked through, from any state: every part of it written anew.
struct TickedLoop {
  using Number = long double;
  SampledWall<> loop;
  HapticPlant<> plant;
  WallFeedback<> gains;

  Number x = 0, v = 0;
  std::deque<Number> forces{};    // F_d, newest first
  Number last_x = 0, filter = 0;  // of the velocity's estimate

  void move(Number force, Number h) {
    const Number b = plant.damping, m = plant.mass, rate = b / m;
    const Number g = -std::expm1(-rate * h) / rate, s = (h - g) / rate;
    x += g * v - s * force / m;
    v += -rate * g * v - g * force / m;
  }

  Number velocity() {
    if (loop.velocity == VelocitySource::sampled) {
      last_x = filter = 0;  // no states of this loop
      return v;
    }
    const Number decay = loop.filtered() ? std::exp(-2 * std::acos(-1.0L) * loop.cutoff * loop.period) : 0;
    const Number slope = (x - last_x) / loop.period;
    last_x = x;
    return filter = decay * filter + (1 - decay) * slope;
  }

  void tick() {
    forces.push_front(gains.K_c * x + gains.B_c * velocity());
    const auto n = static_cast<std::size_t>(loop.periods());
    const Number fraction = loop.fraction();
    if (fraction > 0) move(forces.at(n + 1), fraction);
    move(forces.at(n), loop.period - fraction);
    forces.pop_back();
  }

  /// Largest eigenvalue of the map of a tick, by its action on unit states.
  double radius() {
    const auto memory = static_cast<Eigen::Index>(loop.periods() + 1);
    const Eigen::Index N = 4 + memory;
    Eigen::MatrixXd map(N, N);
    for (Eigen::Index j = 0; j < N; ++j) {
      x = j == 0, v = j == 1, last_x = j == 2, filter = j == 3;
      forces.assign(static_cast<std::size_t>(memory), 0);
      if (j >= 4) forces[static_cast<std::size_t>(j - 4)] = 1;
      tick();
      map.col(j).head<4>() << double(x), double(v), double(last_x), double(filter);
      for (Eigen::Index i = 0; i < memory; ++i) map(4 + i, j) = double(forces[static_cast<std::size_t>(i)]);
    }
    return map.eigenvalues().cwiseAbs().maxCoeff();
  }
};

template <Real Scalar>
void check_interval(const std::vector<GainInterval<Scalar>>& found, double lower, double upper, double tolerance) {
  REQUIRE(found.size() == 1);
  CHECK(double(found[0].lower) == doctest::Approx(lower).epsilon(tolerance));
  CHECK(double(found[0].upper) == doctest::Approx(upper).epsilon(tolerance));
}

}  // namespace

TEST_CASE("the nominal loop is stable for the gains that the notes give") {  // to their printed digits
  check_interval(stable_gains(loop_with(VelocitySource::sampled), nominal, K), 0.478, 20.000, 1e-3);
  check_interval(stable_gains(loop_with(VelocitySource::backward_difference), nominal, K), 0.504, 19.004, 1e-3);
  check_interval(stable_gains(loop_with(VelocitySource::sampled, T), nominal, K), 1.60, 9.39, 2e-3);
  check_interval(stable_gains(loop_with(VelocitySource::backward_difference, T), nominal, K), 1.88, 6.54, 2e-3);
}

TEST_CASE("without damping and with a sampled velocity the interval is K T/2 to 2 m/T") {
  // p(z) = z^2 - (2 - a) z + 1 - a + c, a = (K T/2 + B) T/m, c = K T^2/m: Jury by hand, both ends exact
  const auto found = stable_gains(loop_with(VelocitySource::sampled), HapticPlant<>{.mass = 0.01, .damping = 0}, K);
  check_interval(found, K * T / 2, 2 * 0.01 / T, 1e-12);
}

TEST_CASE("B_c = 15 is unstable when sampled at half the mass, with the radius of the notes") {
  const HapticPlant<> light{.mass = 0.005, .damping = 0.022};
  const WallFeedback<> gains{.K_c = K, .B_c = 15};
  CHECK(sampled_wall_radius(loop_with(VelocitySource::sampled), light, gains) == doctest::Approx(2.03).epsilon(2e-3));
  CHECK(sampled_wall_radius(loop_with(VelocitySource::backward_difference), light, gains) ==
        doctest::Approx(1.26).epsilon(4e-3));
  CHECK(sampled_wall_radius(loop_with(VelocitySource::sampled), nominal, gains) < 1);
}

TEST_CASE("the radius is that of the loop ticked through, whatever its delay, velocity and filter") {
  std::mt19937 random(41);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    SampledWall<> loop = loop_with(i % 2 ? VelocitySource::backward_difference : VelocitySource::sampled);
    loop.delay = std::array{0.0, T, 0.37 * T, 2.6 * T, 3 * T}[std::size_t(i % 5)];
    if (i % 3 == 0 && loop.velocity == VelocitySource::backward_difference) loop.cutoff = uniform(20, 400);
    const HapticPlant<> plant{.mass = uniform(0.004, 0.02), .damping = uniform(0.01, 2)};
    const WallFeedback<> gains{.K_c = uniform(10, 1500), .B_c = uniform(0, 12)};
    // eigenvalues of a matrix with entries up to 1e3 in double: multiple ones to the root of the rounding
    CHECK(sampled_wall_radius(loop, plant, gains) ==
          doctest::Approx(TickedLoop{loop, plant, gains}.radius()).epsilon(1e-6));
  }
}

TEST_CASE("the filters of the loop are those of LowPass and FilteredDerivative") {
  using namespace std::chrono_literals;
  const double cutoff = 60, pi = std::acos(-1.0), angle = 2 * pi * cutoff * T, decay = std::exp(-angle);
  LowPass<> low_pass({.cutoff = cutoff});
  FilteredDerivative<> derivative({.time_constant = 1 / (2 * pi * cutoff)});
  const auto of_velocity = detail::velocity_filter(VelocitySource::sampled, decay, angle, 1.0);
  const auto of_position = detail::velocity_filter(VelocitySource::backward_difference, decay, angle, 1.0);
  double u = 0, y = 0, w = 0;
  const auto tick = [&](int k, double input) {
    const double from_velocity = low_pass.update(k * 1ms, Eigen::Array<double, 1, 1>(input)).value[0];
    const double from_position = derivative.update(k * 1ms, Eigen::Array<double, 1, 1>(input)).value[0];
    if (k > 0) {
      y = of_velocity.pole * y + of_velocity.gain * input + of_velocity.rest * u;
      w = of_position.pole * w + (of_position.gain * input + of_position.rest * u) / T;
    }
    u = input;
    CHECK(from_velocity == doctest::Approx(y).epsilon(1e-13));  // a few roundings of values near one
    CHECK(from_position == doctest::Approx(w).epsilon(1e-12));
  };
  tick(0, 0);
  for (int k = 1; k < 40; ++k) tick(k, std::sin(0.3 * k));
}

TEST_CASE("every end of an interval has a root on the circle and the intervals are all there are") {
  std::mt19937 random(42);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    SampledWall<> loop = loop_with(i % 2 ? VelocitySource::backward_difference : VelocitySource::sampled);
    loop.delay = uniform(0, 3) * T;
    if (i % 3 == 0) loop.cutoff = uniform(20, 400);
    const HapticPlant<> plant{.mass = uniform(0.004, 0.02), .damping = uniform(0, 2)};
    const double K_c = uniform(1, 600), bound = i % 4 ? 1 : 0.97;
    const auto intervals = stable_gains(loop, plant, K_c, bound);
    for (const auto& [lower, upper] : intervals) {
      for (const double end : {lower, upper}) {
        if (end == 0) continue;
        // simple roots move by some units of the coefficients' rounding
        CHECK(sampled_wall_radius(loop, plant, WallFeedback<>{K_c, end}) == doctest::Approx(bound).epsilon(1e-9));
      }
    }
    for (double B_c = 0.013; B_c < 45; B_c += 0.31) {
      CAPTURE(B_c);
      bool inside = false;
      for (const auto& interval : intervals) inside = inside || interval.contains(B_c);
      CHECK(inside == (sampled_wall_radius(loop, plant, WallFeedback<>{K_c, B_c}) < bound));
    }
  }
}

TEST_CASE("a delay that is a number of periods but for its rounding has no fraction") {
  const SampledWall<> loop{.period = 0.001, .delay = 0.017};  // fmod gives 8.7e-16 periods
  CHECK(loop.fraction() == 0);
  CHECK(loop.periods() == 17);
  const HapticPlant<> plant{.mass = 0.05, .damping = 0.022};
  const auto stable = stable_gains(loop, plant, 3.08642);
  REQUIRE(stable.size() == 1);
  CHECK(stable[0].contains(3.72));  // radius 0.99917 by an independent program
  const auto slow = stable_gains(SampledWall<>{.period = 0.00025, .delay = 0.00425, .cutoff = 200}, plant, 49.38);
  for (const auto& interval : slow) CHECK_FALSE(interval.contains(0.043));  // radius 1.00037
}

TEST_CASE("a delay with a very small fraction loses no interval") {
  const HapticPlant<> plant{.mass = 0.05, .damping = 0.022};
  for (const double part : {1e-12, 1e-10, 1e-8, 1e-5, 1e-3}) {
    CAPTURE(part);
    const SampledWall<> loop{.period = 0.001, .delay = 0.001 * (1 + part)};
    for (const double K_c : {3.0, 62.0, 250.0}) {
      const auto intervals = stable_gains(loop, plant, K_c);
      for (double B_c = 0.15; B_c < 60; B_c *= 1.17) {
        CAPTURE(B_c);
        bool inside = false;
        for (const auto& interval : intervals) inside = inside || interval.contains(B_c);
        CHECK(inside == (sampled_wall_radius(loop, plant, WallFeedback<>{K_c, B_c}) < 1));
      }
    }
  }
}

TEST_CASE("in double the radius is that of fifty digits") {
  const SampledWall<Fifty> loop{.period = Fifty(1) / 1000, .delay = Fifty(1) / 2500};
  const SampledWall<> same{.period = 0.001, .delay = 0.0004};
  for (const double B_c : {0.7, 5.0, 15.0}) {
    const Fifty radius = sampled_wall_radius(loop, HapticPlant<Fifty>{Fifty(1) / 100, Fifty(22) / 1000},
                                             WallFeedback<Fifty>{Fifty(1000), Fifty(B_c)});
    // the periods and masses differ in their last digit
    CHECK(sampled_wall_radius(same, nominal, WallFeedback<>{K, B_c}) == doctest::Approx(double(radius)).epsilon(1e-12));
  }
}

TEST_CASE("the gains proved for every mass and damping end where the worst corner does") {
  // notes: at mass .005 the upper limit falls to 10.0 and 8.96
  for (const auto& [velocity, upper] :
       {std::pair{VelocitySource::sampled, 10.0}, std::pair{VelocitySource::backward_difference, 8.96}}) {
    const auto loop = loop_with(velocity);
    const auto gains = robust_stable_gains(loop, uncertain, K, 1.0, 1e-4);
    CHECK(gains.found.upper == doctest::Approx(upper).epsilon(1e-3));
    CHECK(gains.upper_plant.mass == doctest::Approx(0.005));
    REQUIRE_FALSE(gains.proved.empty());
    CHECK(gains.proved.upper > 0.999 * gains.found.upper);
    CHECK(gains.found.contains(gains.proved.lower));
    CHECK(prove_sampled_wall(loop, uncertain, {K, gains.proved.upper}).proved());
    CHECK(prove_sampled_wall(loop, uncertain, {K, 1.001 * gains.found.upper}).verdict == Verdict::infeasible);
  }
}

TEST_CASE("what is called unstable is unstable at the plant that is named, and what is proved nowhere") {
  std::mt19937 random(43);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int proved = 0, refuted = 0;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    SampledWall<> loop = loop_with(i % 2 ? VelocitySource::backward_difference : VelocitySource::sampled);
    loop.delay = uniform(0, 1.5) * T * (i % 3);
    const WallFeedback<> gains{.K_c = uniform(100, 1000), .B_c = uniform(0.5, 10)};
    const auto proof = prove_sampled_wall(loop, uncertain, gains);
    CHECK(proof.verdict != Verdict::undecided);
    if (proof.verdict == Verdict::infeasible) {
      ++refuted;
      CHECK(sampled_wall_radius(loop, proof.plant, gains) > 1 - 1e-9);
      continue;
    }
    ++proved;
    for (int j = 0; j < 50; ++j) {
      const HapticPlant<> plant{uniform(uncertain.lower.mass, uncertain.upper.mass),
                                uniform(uncertain.lower.damping, uncertain.upper.damping)};
      CHECK(sampled_wall_radius(loop, plant, gains) < 1);
    }
  }
  CHECK(proved > 3);
  CHECK(refuted > 3);
}

TEST_CASE("with a sample of delay and differenced velocity no gain serves every plant") {
  const auto gains = robust_stable_gains(loop_with(VelocitySource::backward_difference, T), uncertain, K);
  CHECK(gains.found.empty());
  CHECK(gains.proved.empty());
}

TEST_CASE("a sampled wall says which field it cannot use") {
  const auto loop = loop_with(VelocitySource::sampled);
  const WallFeedback<> gains{K, 5};
  const double nan = std::nan("");
  CHECK_THROWS_WITH_AS((void)sampled_wall_radius(SampledWall<>{}, nominal, gains),
                       doctest::Contains("SampledWall: period"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sampled_wall_radius(loop_with(VelocitySource::sampled, -1), nominal, gains),
                       doctest::Contains("SampledWall: delay"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sampled_wall_radius(loop_with(VelocitySource::sampled, 1), nominal, gains),
                       doctest::Contains("below 32 periods"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sampled_wall_radius(SampledWall<>{.period = T, .cutoff = nan}, nominal, gains),
                       doctest::Contains("SampledWall: cutoff"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sampled_wall_radius(loop, HapticPlant<>{0, 1}, gains),
                       doctest::Contains("HapticPlant: mass"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sampled_wall_radius(loop, nominal, WallFeedback<>{K, nan}),
                       doctest::Contains("WallFeedback: B_c"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)stable_gains(loop, nominal, nan), doctest::Contains("K_c"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)stable_gains(loop, nominal, K, 0.0), doctest::Contains("radius"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)prove_sampled_wall(loop, PlantBox<>{{2, 1}, {1, 1}}, gains),
                       doctest::Contains("PlantBox: mass"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)PlantBox<>::around(nominal, {1, 0}), doctest::Contains("PlantUncertainty: alpha"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)robust_stable_gains(loop, uncertain, K, 1.0, 0.0), doctest::Contains("tolerance"),
                       std::invalid_argument);
}

TEST_CASE("a polynomial is not made of a loop that cannot be") {
  const WallFeedback<> gains{K, 5};
  CHECK_THROWS_WITH_AS((void)sampled_wall_polynomial(SampledWall<>{}, nominal, gains),
                       doctest::Contains("SampledWall: period"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)sampled_wall_polynomial(loop_with(VelocitySource::sampled, 1), nominal, gains),
                       doctest::Contains("below 32 periods"), std::invalid_argument);
}

TEST_CASE("as many cells as an int can count are no more than are needed") {
  const auto loop = loop_with(VelocitySource::sampled);
  const auto usual = robust_stable_gains(loop, uncertain, K, 1.0, 1.0 / 64),
             most = robust_stable_gains(loop, uncertain, K, 1.0, 1.0 / 64, std::numeric_limits<int>::max());
  CHECK(most.proved.lower == usual.proved.lower);
  CHECK(most.proved.upper == usual.proved.upper);
}

TEST_CASE("numbers that are too large are neither proved nor refuted, and end") {
  const auto loop = loop_with(VelocitySource::sampled);
  CHECK(sampled_wall_radius(loop, HapticPlant<>{1e-300, 1}, WallFeedback<>{1e200, 1e200}) ==
        std::numeric_limits<double>::infinity());
  CHECK_FALSE(prove_sampled_wall(loop, PlantBox<>{{1e-300, 1}, {1e300, 1e300}}, {1e200, 1e200}, 1.0, 1000).proved());
  CHECK(stable_gains(loop, HapticPlant<>{1e-300, 1}, 1e200).empty());
}
