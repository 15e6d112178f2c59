// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"
#include "sampled_instances.hpp"

#include <limpid/design/sampled_gain.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using limpid::Gain;
using limpid::robust_sampled_gain;
using limpid::sampled_radius;
using limpid::SampledStability;
using limpid::SampledSystem;
using limpid::smallest_sampled_radius;
using limpid::Tissue;
using limpid::TissueBox;
using limpid::test::maximum;
using limpid::test::tool;

namespace {

const auto& box = limpid::test::box;

}  // namespace

TEST_CASE("at one point the smallest radius is a third of the trace, which no gain changes") {
  const double T[] = {0.016, 0.032, 0.1, 0.2}, printed[] = {0.174, 0.085, 0.0047, 0};
  for (int i = 0; i < 4; ++i) {
    CAPTURE(T[i]);
    const SampledSystem<double> system{tool, T[i], T[i]};
    const auto best = smallest_sampled_radius(system, Tissue<double>{1100, 30});
    // tr Phi of b = 30.1, k = 1101, m = 0.1, underdamped.
    const double decay = 150.5, omega = std::sqrt(11'010 - decay * decay > 0 ? 11'010 - decay * decay : 0);
    const double fast = std::sqrt(decay * decay - 11'010);
    const double trace = 2 * std::exp(-decay * T[i]) * (omega > 0 ? std::cos(omega * T[i]) : std::cosh(fast * T[i]));
    CHECK(std::abs(best.radius - printed[i]) < 6e-4);
    // A treble root is told to the third root of rounding, relative to the coefficients' size.
    CHECK(best.radius == doctest::Approx(std::abs(trace) / 3).epsilon(5e-3));
  }
}

TEST_CASE("the notes' gains for one point come out") {
  const auto first = smallest_sampled_radius<double>({tool, 0.016, 0.016}, {1100, 30}).gain;
  CHECK(std::abs(first[0] + 175.2) < 0.05);
  CHECK(std::abs(first[1] + 0.854) < 0.0005);
  const auto second = smallest_sampled_radius<double>({tool, 0.032, 0.032}, {1100, 30}).gain;
  CHECK(std::abs(second[0] + 31.3) < 0.05);
  CHECK(std::abs(second[1] + 0.173) < 0.0005);
}

TEST_CASE("without delay the error is dead after two samples") {
  for (const double T : {0.001, 0.016, 0.1}) {
    const SampledSystem<double> system{tool, T, 0};
    const auto best = smallest_sampled_radius(system, Tissue<double>{600, 25});
    const Eigen::Matrix2d M = SampledStability<double>(system).monodromy({600, 25}, best.gain);
    // Entries up to 1 / T in raw units.
    CHECK((M * M).norm() < 1e-10 / T);
  }
}

TEST_CASE("robust gains: the notes' worst radii or better, each proved over the box") {
  const double T[] = {0.016, 0.032, 0.1, 0.2}, printed[] = {0.632, 0.568, 0.376, 0.200};
  for (int i = 0; i < 4; ++i) {
    CAPTURE(T[i]);
    const SampledSystem<double> system{tool, T[i], T[i]};
    const auto robust = robust_sampled_gain(system, box);
    CHECK(robust.worst_radius < printed[i] + 0.002);
    REQUIRE(robust.worst.proof.proved());
    CHECK(robust.worst_radius <= robust.worst.found * (1 + 1e-4));
    CHECK(limpid::prove_sampled_stability(system, box, robust.gain, robust.worst_radius).proved());
  }
}

TEST_CASE("no gain near the robust one, nor any of 2000 others, has a smaller worst radius") {
  std::mt19937 generator(41);
  INFO("seed 41");
  std::normal_distribution<double> normal;
  const SampledSystem<double> system{tool, 0.032, 0.032};
  const SampledStability<double> stability(system);
  const auto robust = robust_sampled_gain(system, box);
  for (int i = 0; i < 2'000; ++i) {
    const double away = std::pow(10.0, -4.0 * i / 2'000);
    const Gain<double> L(robust.gain[0] + 300 * away * normal(generator),
                         robust.gain[1] + 3 * away * normal(generator));
    double worst = 0;
    for (const double k_e : {200.0, 300.0, 500.0, 1000.0, 2000.0}) {
      for (const double b_e : {20.0, 30.0, 40.0}) worst = maximum(worst, stability.radius({k_e, b_e}, L));
    }
    if (worst < robust.worst.found) worst = limpid::worst_sampled_radius(system, box, L).found;
    CHECK(worst >= robust.worst.found * (1 - 1e-6));
  }
}

TEST_CASE("for other delays the robust gain is proved too, and no worse than none") {
  for (const double periods : {0.0, 0.4, 2.0}) {
    CAPTURE(periods);
    const SampledSystem<double> system{tool, 0.032, 0.032 * periods};
    const auto robust = robust_sampled_gain(system, box);
    CHECK(robust.worst.proof.proved());
    CHECK(robust.worst_radius < 0.850);
  }
}

TEST_CASE("a shorter delay allows a smaller worst radius") {
  double last = 0;
  for (const double periods : {0.0, 0.4, 1.0, 2.0}) {
    const double worst = robust_sampled_gain<double>({tool, 0.032, 0.032 * periods}, box).worst_radius;
    CHECK(worst > last);
    last = worst;
  }
}

TEST_CASE("the same question has the same answer, to the last bit") {
  const SampledSystem<double> system{tool, 0.1, 0.1};
  CHECK(robust_sampled_gain(system, box).gain == robust_sampled_gain(system, box).gain);
}

TEST_CASE("where half an oscillation fills the period no gain is invented") {
  // omega T = pi without damping: e comes back with its sign changed, whatever was felt in between.
  const double T = std::acos(-1.0) / 100;
  const SampledSystem<double> system{{.mass = 1, .damping = 0, .stiffness = 0}, T, T};
  const auto best = smallest_sampled_radius(system, Tissue<double>{10'000, 0});
  CHECK(best.gain.allFinite());
  CHECK(best.radius <= 1 + 1e-9);
}

TEST_CASE("boxes and systems that make no sense are refused") {
  CHECK_THROWS_AS((void)robust_sampled_gain<double>({tool, 0, 0}, box), std::invalid_argument);
  CHECK_THROWS_AS((void)robust_sampled_gain<double>({tool, 0.1, 0.1}, {{2, 1}, {1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS((void)smallest_sampled_radius<double>({tool, 0.1, 0.1}, {std::nan(""), 1}), std::invalid_argument);
}

TEST_CASE("over an absurdly wide box the gain is no worse than none") {
  const TissueBox<double> wide{{0, 0}, {1e6, 10}};
  for (const double periods : {0.0, 1.0}) {
    CAPTURE(periods);
    const SampledSystem<double> system{{.mass = 0.1, .damping = 1, .stiffness = 100}, 0.01, 0.01 * periods};
    const auto robust = robust_sampled_gain(system, wide);
    const auto none = limpid::worst_sampled_radius(system, wide, Gain<double>(0, 0));
    CHECK(robust.worst.proved <= none.proved);
    if (!robust.worst.proof.proved()) CHECK(robust.worst.found <= none.found);
  }
}

TEST_CASE("where the numbers are too large to tell the gain is none") {
  const auto robust = robust_sampled_gain<double>({tool, 0.1, 0.1}, {{-1e5, -1e5}, {0, -9e4}});
  CHECK(robust.gain == Gain<double>(0, 0));
  CHECK_FALSE(robust.worst.proof.proved());
}
