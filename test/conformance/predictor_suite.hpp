// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/prediction/predictor.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <limits>
#include <random>

namespace limpid::test {

/// What a predictor under test is fed with: a press of some newtons with samples late by some ticks.
template <Predictor P>
class PredictorScene {
 public:
  using Traits = PredictorTraits<P>;
  using Scalar = typename Traits::Scalar;
  static constexpr int axes = Traits::axes;
  using Vector = Eigen::Array<Scalar, axes, 1>;

  explicit PredictorScene(unsigned seed) : random_{seed} {}

  Vector force() { return draw(3); }

  ToolSample<axes, Scalar> sample(Time taken, Time arrived) {
    return {{draw(0.01), draw(0.05), draw(1), draw(3)}, taken, arrived};
  }

  /// `ticks` ticks of 1 ms from `first`, with a sample each seventh tick, 5 ms late.
  void run(P& predictor, int first, int ticks) {
    using std::chrono::milliseconds;
    for (int k = first; k < first + ticks; ++k) {
      const Time now = milliseconds(k);
      if (k % 7 == 6) (void)Traits::observe(predictor, sample(milliseconds(k - 5), now));
      (void)Traits::advance(predictor, now, force());
    }
  }

 private:
  Vector draw(double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    Vector value;
    for (auto& entry : value) entry = Scalar(uniform(random_));
    return value;
  }

  std::mt19937 random_;
};

template <typename Motion>
[[nodiscard]] bool same(const Motion& a, const Motion& b) {
  return (a.x == b.x).all() && (a.v == b.v).all() && (a.a == b.a).all();
}

/// Two predictors of which one went through `disturb` go on alike.
template <Predictor P, typename Disturb>
void check_unaffected(const P& start, Disturb&& disturb) {
  PredictorScene<P> scene(1), twin_scene(1);
  P predictor = start, twin = start;
  scene.run(predictor, 0, 40);
  twin_scene.run(twin, 0, 40);
  disturb(predictor);
  for (int k = 40; k < 60; ++k) {
    scene.run(predictor, k, 1);
    twin_scene.run(twin, k, 1);
    const auto F = scene.force();
    (void)twin_scene.force();
    using Traits = PredictorTraits<P>;
    const Time now = std::chrono::milliseconds(k) + std::chrono::microseconds(500);
    const auto mine = Traits::advance(predictor, now, F), other = Traits::advance(twin, now, F);
    REQUIRE(same(mine.motion, other.motion));
    REQUIRE(mine.status == other.status);
  }
}

/// Puts any predictor through the laws of the concept. `start` has seen nothing yet.
template <Predictor P>
void check_predictor(const P& start) {
  using Traits = PredictorTraits<P>;
  using Scene = PredictorScene<P>;
  using Scalar = typename Scene::Scalar;
  using std::chrono::milliseconds;
  const auto zero = Scene::Vector::Zero();

  P fresh = start;
  CHECK(has(Traits::advance(fresh, milliseconds(0), zero).status, Status::no_sample));

  // A sample not newer than the newest one is dropped.
  for (const int taken : {29, 28, 1}) {
    check_unaffected(start, [&](P& p) {
      Scene other(2);
      CHECK(Traits::observe(p, other.sample(milliseconds(taken), milliseconds(40))) == Status::out_of_order);
    });
  }

  // Time that does not advance.
  for (const int now : {39, 10}) {
    check_unaffected(
        start, [&](P& p) { CHECK(Traits::advance(p, milliseconds(now), zero).status == Status::clock_backwards); });
  }

  // What is not finite, in each entry of each input.
  for (const Scalar bad : {std::numeric_limits<Scalar>::quiet_NaN(), std::numeric_limits<Scalar>::infinity()}) {
    for (int axis = 0; axis < Scene::axes; ++axis) {
      check_unaffected(start, [&](P& p) {
        Scene other(3);
        for (int field = 0; field < 4; ++field) {
          auto sample = other.sample(milliseconds(38), milliseconds(40));
          auto& value = sample.value;
          (field == 0 ? value.x : field == 1 ? value.v : field == 2 ? value.a : value.force)[axis] = bad;
          CHECK(Traits::observe(p, sample) == Status::not_finite);
        }
        auto F = other.force();
        F[axis] = bad;
        const auto answer = Traits::advance(p, milliseconds(40), F);
        CHECK(has(answer.status, Status::not_finite));
        CHECK(is_finite(answer.motion));
      });
    }
  }

  // Enormous and old inputs leave the answers finite.
  P strained = start;
  Scene scene(4);
  for (int k = 0; k < 50; ++k) {
    auto sample = scene.sample(milliseconds(7 * k), milliseconds(7 * k));
    const Scalar huge = std::numeric_limits<Scalar>::max() / Scalar(k % 5 + 1);
    if (k % 2 == 0) sample.value.x.setConstant(huge);
    (void)Traits::observe(strained, sample);
    const auto answer =
        Traits::advance(strained, milliseconds(7 * k), k % 3 == 0 ? Scene::Vector::Constant(huge) : scene.force());
    CHECK(is_finite(answer.motion));
  }

  P hot = start;
  Scene hot_scene(5);
  check_no_allocation([&] { hot_scene.run(hot, 0, 50); });
}

}  // namespace limpid::test
