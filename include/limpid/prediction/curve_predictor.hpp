// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/tissue_learner.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/signal/history.hpp>

#include <cstddef>
#include <vector>

namespace limpid {

/// Learns the tissue's whole force law, and replays it from the newest sample's state over the operator's force up to
/// now. One axis. See TissueLearner.
///
/// The learner's arrays are large (hundreds of kilobytes): keep the predictor where it stays.
/// @tparam Capacity  ticks remembered, a power of two: at least from the sample before the newest to now
/// @realtime         no allocation, no throw; a replay at every sample, see TissueLearner
template <typename Law = TissueLaw<>, std::size_t Capacity = 512>
class CurvePredictor {
 public:
  using Scalar = typename Law::Scalar;
  static constexpr int axes = 1;
  using Vector = Eigen::Array<Scalar, 1, 1>;
  using Learner = TissueLearner<Law, Capacity>;

  struct Settings {
    typename Learner::Settings learner{};
    Motion<1, Scalar> start{};  ///< until the first sample; m, m/s, m/s^2
  };

  /// @throws std::invalid_argument  where a field is refused
  explicit CurvePredictor(const Settings& settings)
      : mass_{settings.learner.mass}, learner_(settings.learner), motion_{settings.start} {
    expect(is_finite(settings.start), "CurvePredictor: start", "finite", "a motion that is not");
    point_.x = motion_.x[0];
    point_.v = motion_.v[0];
  }

  [[nodiscard]] const Learner& learner() const noexcept { return learner_; }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<1, Scalar>& sample) noexcept {
    if (!is_finite(sample.value) || !moderate(sample.value.x[0], sample.value.v[0], sample.value.force[0])) {
      return Status::not_finite;
    }
    if (sample.taken > sample.arrived) return Status::clock_backwards;
    if (newest_.seen(sample.taken)) return Status::out_of_order;
    observation_ = {sample.taken, sample.value.x[0], sample.value.v[0], sample.value.force[0]};
    newest_.observe(sample.taken);
    return Status::ok;
  }

  /// @param F_h  operator's force at `now`, N, linear since the last tick
  [[nodiscard]] Prediction<1, Scalar> advance(Time now, const Vector& F_h) noexcept {
    const Status pushed = forces_.size() > 0 && now <= now_ ? Status::clock_backwards : forces_.push(now, F_h[0]);
    if (pushed != Status::ok) return {motion_, pushed};
    const Scalar h = forces_.size() > 1 ? in_seconds<Scalar>(elapsed(now, now_)) : Scalar{0};
    if (learner_.started() && h > Scalar{0}) {
      learner_.law().template step<true>(learner_.state(), point_, F_before_, F_h[0], h);
    }
    now_ = now;
    F_before_ = F_h[0];
    Status status = take_over_sample();
    if (!moderate(point_.x, point_.v, Scalar{0})) {  // a law that leads nowhere: the newest sample, held
      point_ = {observation_.x, observation_.v, Scalar{0}, {}};
      status |= Status::not_finite;
    }
    const Scalar a = learner_.started() ? (F_h[0] - learner_.law().force(learner_.state(), point_) -
                                           learner_.law().settings().tool_damping * point_.v) /
                                              mass_
                                        : Scalar{0};
    motion_.x[0] = point_.x;
    motion_.v[0] = point_.v;
    if (is_finite(a)) motion_.a[0] = a;
    return {motion_, status | when(!newest_.any(), Status::no_sample)};
  }

 private:
  static bool moderate(const Scalar& x, const Scalar& v, const Scalar& F) noexcept {
    using std::abs;
    return abs(x) < Scalar(10) && abs(v) < Scalar(100) && abs(F) < Scalar(10000);
  }

  Status take_over_sample() noexcept {
    if (!newest_.pending()) return Status::ok;
    if (const Status settled = newest_.settle(now_); settled != Status::ok) return settled;
    learner_.learn(observation_, forces_);
    point_ = learner_.newest();
    return replay();
  }

  // From the newest sample to now.
  Status replay() noexcept {
    Time t = learner_.taken();
    const auto first = forces_.at(t);
    Scalar F = first.value;
    for (std::size_t i = forces_.first_not_before(t); i < forces_.size(); ++i) {
      if (forces_.time(i) <= t) continue;
      learner_.law().template step<true>(learner_.state(), point_, F, forces_.value(i),
                                         in_seconds<Scalar>(elapsed(forces_.time(i), t)));
      t = forces_.time(i);
      F = forces_.value(i);
    }
    return first.status;
  }

  Scalar mass_;
  Learner learner_;
  History<Scalar, Capacity> forces_;
  typename Law::Point point_{};
  Motion<1, Scalar> motion_{};
  AxisSample<Scalar> observation_{};
  SampleStamps newest_;
  Time now_{};
  Scalar F_before_{0};
};

}  // namespace limpid
