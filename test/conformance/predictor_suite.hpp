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

/// A sample stamped in the future leaves no trace but what the tick says of it.
template <Predictor P>
void check_future_sample(const P& start) {
  using Traits = PredictorTraits<P>;
  using std::chrono::milliseconds;
  check_unaffected(start, [](P& p) {
    PredictorScene<P> other(6);
    CHECK(Traits::observe(p, other.sample(milliseconds(45), milliseconds(41))) == Status::clock_backwards);
  });
  PredictorScene<P> scene(7), twin_scene(7);
  P predictor = start, twin = start;
  scene.run(predictor, 0, 40);
  twin_scene.run(twin, 0, 40);
  CHECK(Traits::observe(predictor, scene.sample(milliseconds(90), milliseconds(90))) == Status::ok);
  CHECK(Traits::observe(predictor, scene.sample(milliseconds(95), milliseconds(95))) == Status::ok);
  for (int k = 40; k < 60; ++k) {
    const auto F = scene.force();
    if (k == 41) {
      const auto good = scene.sample(milliseconds(38), milliseconds(k));
      for (P* p : {&predictor, &twin}) CHECK(Traits::observe(*p, good) == Status::ok);
    }
    const auto mine = Traits::advance(predictor, milliseconds(k), F), other = Traits::advance(twin, milliseconds(k), F);
    REQUIRE(same(mine.motion, other.motion));
    REQUIRE(mine.status == (other.status | when(k == 40, Status::out_of_history)));
  }
}

/// After one absurd but finite sample, one good sample is enough for good answers.
template <Predictor P>
void check_recovery(const P& start) {
  using Traits = PredictorTraits<P>;
  using Scalar = typename PredictorScene<P>::Scalar;
  using std::chrono::milliseconds;
  Scalar huge = std::numeric_limits<Scalar>::max();
  for (int size = 0; size < 7; ++size, huge /= 10) {
    CAPTURE(size);
    PredictorScene<P> scene(8);
    P p = start;
    scene.run(p, 0, 40);
    auto absurd = scene.sample(milliseconds(38), milliseconds(40));
    absurd.value.x.setConstant(huge);
    absurd.value.v.setConstant(-huge);
    (void)Traits::observe(p, absurd);
    for (int k = 40; k < 50; ++k) CHECK(is_finite(Traits::advance(p, milliseconds(k), scene.force()).motion));
    CHECK(Traits::observe(p, scene.sample(milliseconds(46), milliseconds(50))) == Status::ok);
    CHECK(is_finite(Traits::advance(p, milliseconds(50), scene.force()).motion));
    for (int k = 51; k < 100; ++k) {
      const auto answer = Traits::advance(p, milliseconds(k), scene.force());
      REQUIRE_FALSE(has(answer.status, Status::not_finite));
      REQUIRE(answer.motion.x.abs().maxCoeff() < 1);  // m; the good samples and the forces are of some millimetres
    }
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

  check_future_sample(start);
  check_recovery(start);

  P hot = start;
  Scene hot_scene(5);
  check_no_allocation([&] { hot_scene.run(hot, 0, 50); });
}

}  // namespace limpid::test
