// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/time.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace limpid {

/// Weights of several predictors by their errors: as (best score / score)^power, their sum 1, where a score is the
/// exponential mean of square errors over samples,
///
///     score <- forgetting score + (1 - forgetting) error
///
/// Weights move to those of a new sample in a straight line over `ramp`. Before the first error of hold scores are the
/// priors; that error is their unit from then on.
///
/// A predictor good so far that fails is found out with its first failure to arrive, in a delay and a period; from then
/// on with the default settings the mixture of it and hold errs by less than 1.621 of hold's error: where it fails by r
/// of hold's mean square its weight is at most 1/(1 + (0.2 r)^2), and 1 + (sqrt(r) - 1)/(1 + 0.04 r^2) < 1.621.
/// @tparam Count  predictors
/// @realtime      no allocation, no throw; `advance` 3 flops a predictor, `score` a power for each
template <std::size_t Count, Real Scalar = double>
class MixtureWeights {
 public:
  using Values = std::array<Scalar, Count>;

  struct Settings {
    Scalar forgetting = Scalar{4} / Scalar{5};     ///< of a score from sample to sample, 0 <= forgetting < 1
    Scalar power{2};                               ///< on mean squares, > 0
    Values prior = equal(Scalar{1});               ///< scores before the first sample, in hold's first error; > 0
    Duration ramp = std::chrono::milliseconds{5};  ///< of weights to those of a new sample, >= 0
  };

  /// @param hold  which predictor is hold, that has the weight where no other has
  /// @throws std::invalid_argument  where a setting is outside the range given at its field
  explicit MixtureWeights(const Settings& settings, std::size_t hold)
      : s_{settings}, hold_{hold}, scores_{settings.prior} {
    expect(s_.forgetting >= Scalar{0} && s_.forgetting < Scalar{1}, "MixtureWeights: forgetting", ">= 0 and < 1",
           s_.forgetting);
    expect(is_finite(s_.power) && s_.power > Scalar{0}, "MixtureWeights: power", "finite and > 0", s_.power);
    for (const Scalar& prior : s_.prior)
      expect(is_finite(prior) && prior > Scalar{0}, "MixtureWeights: prior", "finite and > 0", prior);
    expect(s_.ramp >= Duration{0}, "MixtureWeights: ramp", ">= 0", s_.ramp);
    muted_.fill(false);
    aim();
    weights_ = target_;
  }

  /// Brings the weights to `now`: first in a tick.
  void advance(Time now) noexcept {
    const Time before = now_;
    now_ = now;
    if (settled_) return;
    settled_ = now >= end_;
    const Scalar part =
        settled_ ? Scalar{1} : in_seconds<Scalar>(elapsed(now, before)) / in_seconds<Scalar>(elapsed(end_, before));
    for (std::size_t i = 0; i < Count; ++i) weights_[i] += (target_[i] - weights_[i]) * part;
  }

  /// Takes in the square errors that the predictors had at the instant `taken`; weights move from now on. Where an
  /// error is not finite the predictor is muted, where hold's is not nothing is taken in.
  void score(Time taken, const Values& errors) noexcept {
    if (!is_finite(errors[hold_]) || (!scored_ && !(errors[hold_] > Scalar{0}))) return;
    for (std::size_t i = 0; i < Count; ++i) {
      if (!scored_) scores_[i] *= errors[hold_];
      if (is_finite(errors[i])) {
        scores_[i] += (errors[i] - scores_[i]) * (Scalar{1} - s_.forgetting);
        muted_[i] = muted_[i] && taken <= muted_at_[i];
      } else {
        mute(i);
      }
    }
    scored_ = true;
    aim();
    end_ = s_.ramp <= elapsed(Time::max(), now_) ? now_ + s_.ramp : Time::max();
    settled_ = false;
    if (s_.ramp == Duration{0}) weights_ = target_;
  }

  /// Takes a predictor other than hold out at once, until a sample taken after now is scored.
  void mute(std::size_t i) noexcept {
    muted_at_[i] = now_;
    if (muted_[i]) return;
    muted_[i] = true;
    aim();
    weights_[i] = Scalar{0};
    normalise(weights_);
  }

  [[nodiscard]] const Values& now() const noexcept { return weights_; }
  [[nodiscard]] const Values& scores() const noexcept { return scores_; }

 private:
  static constexpr Values equal(const Scalar& value) {
    Values values;
    values.fill(value);
    return values;
  }

  void aim() noexcept {
    using std::pow;
    const Scalar least = std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon();
    Scalar best = scores_[hold_] + least;
    for (std::size_t i = 0; i < Count; ++i)
      if (!muted_[i]) best = std::min(best, Scalar(scores_[i] + least));
    for (std::size_t i = 0; i < Count; ++i)
      target_[i] = muted_[i] ? Scalar{0} : Scalar(pow(best / (scores_[i] + least), s_.power));
    normalise(target_);
  }

  void normalise(Values& weights) const noexcept {
    Scalar sum{0};
    for (const Scalar& weight : weights) sum += weight;
    if (!(sum > Scalar{0})) {
      weights[hold_] = Scalar{1};
      return;
    }
    for (Scalar& weight : weights) weight /= sum;
  }

  Settings s_;
  std::size_t hold_;
  Values scores_;            // mean squares
  Values weights_, target_;  // now, at end_
  std::array<bool, Count> muted_{};
  std::array<Time, Count> muted_at_{};
  Time now_{}, end_{};
  bool scored_ = false, settled_ = true;
};

}  // namespace limpid
