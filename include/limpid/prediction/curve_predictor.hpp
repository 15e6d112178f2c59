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
#include <limpid/prediction/sample_intake.hpp>
#include <limpid/signal/history.hpp>

#include <cstddef>

namespace limpid {

/// Learns the tissue's whole force law, and replays it from the newest sample's state over the operator's force up to
/// now. One axis. Where the learner is lost the newest sample is held, with status ok. See TissueLearner.
///
/// A sample beyond 10 m, 100 m/s or 10 kN is refused as not finite; a law that leads beyond them is left for the newest
/// sample, held, with the same word.
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
  explicit CurvePredictor(const Settings& settings) : learner_(settings.learner), motion_{settings.start} {
    expect(is_finite(settings.start), "CurvePredictor: start", "finite", "a motion that is not");
    expect(moderate(motion_.x[0], motion_.v[0], Scalar{0}), "CurvePredictor: start", "within 10 m and 100 m/s",
           motion_.x[0]);
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
    return intake_.observe(sample);
  }

  /// @param F_h  operator's force at `now`, N, linear since the last tick
  [[nodiscard]] Prediction<1, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (const Status refused = intake_.refusal(now, F_h); refused != Status::ok) return {motion_, refused};
    Status status = intake_.begin(now);
    forces_.append(now, F_h[0]);
    if (intake_.fresh()) {
      const auto& sample = intake_.held();
      learner_.learn({intake_.taken(), sample.x[0], sample.v[0], sample.force[0]}, forces_);
      point_ = learner_.newest();
      status |= replay();
    } else if (!learner_.lost()) {
      step_to(forces_.size() - 1);
    }
    const bool leads_nowhere = !moderate(point_.x, point_.v, Scalar{0});
    if (leads_nowhere) status |= Status::not_finite;
    if (leads_nowhere || learner_.lost()) {
      hold_newest();
    } else {
      follow(F_h[0]);
    }
    return {motion_, status};
  }

 private:
  static bool moderate(const Scalar& x, const Scalar& v, const Scalar& F) noexcept {
    using std::abs;
    return abs(x) < Scalar(10) && abs(v) < Scalar(100) && abs(F) < Scalar(10000);
  }

  void hold_newest() noexcept {
    const auto& held = intake_.held();
    point_ = {held.x[0], held.v[0], Scalar{0}, {}};
    if (learner_.started()) motion_ = {held.x, held.v, held.a};
  }

  void follow(const Scalar& F) noexcept {
    motion_.x[0] = point_.x;
    motion_.v[0] = point_.v;
    if (!learner_.started()) return;
    const Scalar a = learner_.law().acceleration(learner_.state(), point_, F);
    if (is_finite(a)) motion_.a[0] = a;
  }

  // From the newest sample to now; from the first tick that is remembered, where it was taken before that.
  Status replay() noexcept {
    const Time taken = learner_.taken();
    const auto [F, status] = forces_.at(taken);
    const std::size_t i = forces_.first_not_before(taken);
    if (status == Status::ok && forces_.time(i) != taken) step(F, forces_.value(i), elapsed(forces_.time(i), taken));
    for (std::size_t k = i + 1; k < forces_.size(); ++k) step_to(k);
    return status;
  }

  // Between two ticks that are remembered.
  void step_to(std::size_t tick) noexcept {
    step(forces_.value(tick - 1), forces_.value(tick), elapsed(forces_.time(tick), forces_.time(tick - 1)));
  }

  void step(const Scalar& F0, const Scalar& F1, Duration h) noexcept {
    learner_.law().template step<true>(learner_.state(), point_, F0, F1, in_seconds<Scalar>(h));
  }

  Learner learner_;
  History<Scalar, Capacity> forces_;
  typename Law::Point point_{};
  Motion<1, Scalar> motion_{};
  detail::SampleIntake<1, Scalar> intake_;
};

}  // namespace limpid
