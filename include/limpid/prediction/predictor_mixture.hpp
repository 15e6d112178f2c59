// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/lane_motion.hpp>
#include <limpid/prediction/mixture_weights.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/prediction/sample_intake.hpp>
#include <limpid/signal/history.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <utility>

namespace limpid {

namespace detail {

template <typename First, typename... Rest>
struct FirstPredictor {
  using Scalar = typename PredictorTraits<First>::Scalar;
  static constexpr int axes = PredictorTraits<First>::axes;
};

/// Of several predictors the motions issued at one instant.
template <std::size_t Count, int Axes, Real Scalar_>
struct IssuedMotions {
  using Scalar = Scalar_;
  std::array<LaneMotion<Axes, Scalar>, Count> of;

  friend IssuedMotions operator+(IssuedMotions l, const IssuedMotions& r) noexcept {
    for (std::size_t i = 0; i < Count; ++i) l.of[i] = l.of[i] + r.of[i];
    return l;
  }
  friend IssuedMotions operator*(IssuedMotions l, const Scalar& s) noexcept {
    for (auto& motion : l.of) motion = motion * s;
    return l;
  }
};

}  // namespace detail

/// A predictor that an estimator informs.
template <typename P, typename Estimate>
concept TakesEstimate = requires(P& p, const Estimate& estimate) {
  { p.use(estimate) } -> std::same_as<Status>;
};

/// Predictors of one tool that can be mixed: hold is among them, so that a mixture is never left without an answer.
template <typename... Ps>
concept MixablePredictors =
    (Predictor<Ps> && ...) && (sizeof...(Ps) > 1) &&
    ((std::same_as<typename PredictorTraits<Ps>::Scalar, typename detail::FirstPredictor<Ps...>::Scalar> &&
      PredictorTraits<Ps>::axes == detail::FirstPredictor<Ps...>::axes) &&
     ...) &&
    (std::same_as<Ps,
                  HoldPredictor<detail::FirstPredictor<Ps...>::axes, typename detail::FirstPredictor<Ps...>::Scalar>> ||
     ...);

/// Any set of predictors as one, weighted by what each had issued for the instant of each sample when that arrived.
///
/// The error of a sample, (p ex)^2 + ev^2 summed over the axes, enters the predictor's score, an exponential mean over
/// samples; weights are as (best score / score)^power, and move to a new sample's in a straight line over `ramp`
/// (`MixtureWeights`). Motions are joined by the weights, position, velocity and acceleration alike: neither position
/// nor velocity leaps where weights change.
///
/// A predictor that says not_finite, or whose motion or its error's square is not, has weight zero at once, and until a
/// sample taken later has been scored. Samples from before the history, 512 ticks, are not scored.
/// @tparam Ps  the predictors, HoldPredictor among them; memory 8 kB an axis for each, beside their own
/// @realtime   as the predictors; beside them a copy of each motion, at a sample a search and a power for each
template <typename... Ps>
requires MixablePredictors<Ps...>
class PredictorMixture {
  static constexpr std::size_t capacity = 512;  // ticks remembered
  static constexpr std::size_t hold_at = [] {
    std::size_t i = 0, hold = 0;
    ((hold =
          std::same_as<Ps, HoldPredictor<PredictorTraits<Ps>::axes, typename PredictorTraits<Ps>::Scalar>> ? i : hold,
      ++i),
     ...);
    return hold;
  }();

 public:
  static constexpr std::size_t count = sizeof...(Ps);
  using Scalar = typename detail::FirstPredictor<Ps...>::Scalar;
  static constexpr int axes = detail::FirstPredictor<Ps...>::axes;
  using Vector = Eigen::Array<Scalar, axes, 1>;
  using Weights = MixtureWeights<count, Scalar>;

  struct Settings {
    typename Weights::Settings weights{};
    Scalar position_rate{1};       ///< p, 1/s; 1 as (3.35) prints, 1/T_d to weigh position by the samples' period
    Motion<axes, Scalar> start{};  ///< returned where the first tick has nothing better
  };

  /// @throws std::invalid_argument  where a setting is refused
  explicit PredictorMixture(const Settings& settings, Ps... predictors)
      : predictors_{std::move(predictors)...},
        weights_{settings.weights, hold_at},
        position_rate_{settings.position_rate},
        motion_{settings.start} {
    expect(is_finite(position_rate_) && position_rate_ >= Scalar{0}, "PredictorMixture: position_rate",
           "finite and >= 0", position_rate_);
    expect(is_finite(motion_), "PredictorMixture: start", "finite", "a motion that is not");
  }

  /// Passes an estimate on to those that take it; it holds from the next `advance` on.
  /// @return  what they say of it, joined
  template <typename Estimate>
  [[nodiscard]] Status use(const Estimate& estimate) noexcept requires(TakesEstimate<Ps, Estimate> || ...) {
    Status status = Status::ok;
    each([&]<typename P>(P& p, std::size_t) {
      if constexpr (TakesEstimate<P, Estimate>) status |= p.use(estimate);
    });
    return status;
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<axes, Scalar>& sample) noexcept {
    const Status status = intake_.observe(sample);
    if (status != Status::ok) return status;
    each([&]<typename P>(P& p, std::size_t) { (void)PredictorTraits<P>::observe(p, sample); });
    return status;
  }

  /// The tool at `now`.
  /// @param F_h  operator's force at `now`, N
  /// @return     what the predictors in use say, joined, but their not_finite; that only where it holds of the input,
  /// or
  ///             of the sum, where the last motion is returned
  [[nodiscard]] Prediction<axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (const Status refused = intake_.refusal(now, F_h); refused != Status::ok) return {motion_, refused};
    Status status = intake_.begin(now);
    std::array<Prediction<axes, Scalar>, count> answers;
    each([&]<typename P>(P& p, std::size_t i) { answers[i] = PredictorTraits<P>::advance(p, now, F_h); });
    weights_.advance(now);
    if (intake_.fresh()) score();
    mute(answers);
    const auto& weights = weights_.now();
    Motion<axes, Scalar> sum{};
    Issued issued;
    for (std::size_t i = 0; i < count; ++i) {
      if (weights[i] > Scalar{0}) {
        sum = sum + answers[i].motion * weights[i];
        status |= without_not_finite(answers[i].status);
      }
      issued.of[i] = State(answers[i].motion);
    }
    issued_.append(now, issued);
    if (!is_finite(sum)) return {motion_, status | Status::not_finite};
    motion_ = sum;
    return {motion_, status};
  }

  /// Of each predictor, in their order: not negative, their sum 1.
  [[nodiscard]] std::array<Scalar, count> weights() const noexcept { return weights_.now(); }
  /// Of each predictor: mean square error, (m/s)^2; the prior until the first error of hold.
  [[nodiscard]] const std::array<Scalar, count>& scores() const noexcept { return weights_.scores(); }

  template <std::size_t i>
  [[nodiscard]] auto& get() noexcept {
    return std::get<i>(predictors_);
  }

 private:
  using State = detail::LaneMotion<axes, Scalar>;
  using Issued = detail::IssuedMotions<count, axes, Scalar>;

  template <typename F>
  void each(F&& f) noexcept {
    [&]<std::size_t... i>(std::index_sequence<i...>) { (f(std::get<i>(predictors_), i), ...); }
    (std::index_sequence_for<Ps...>{});
  }

  static Status without_not_finite(Status status) noexcept {
    return static_cast<Status>(static_cast<std::uint32_t>(status) & ~static_cast<std::uint32_t>(Status::not_finite));
  }

  // Before this tick's motions are remembered: none was issued for an instant by who had seen its sample.
  void score() noexcept {
    const auto [issued, status] = issued_.at(intake_.taken());
    if (status != Status::ok) return;
    const State sample(intake_.held());
    std::array<Scalar, count> errors;
    for (std::size_t i = 0; i < count; ++i) {
      const State e = issued.of[i] - sample;
      const Vector square = from_lanes<axes>((e.x * position_rate_).square() + e.v.square());
      errors[i] = square.sum();
    }
    weights_.score(intake_.taken(), errors);
  }

  // Where a motion is of no use hold's stands for it.
  void mute(std::array<Prediction<axes, Scalar>, count>& answers) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      if (i == hold_at) continue;
      auto& [motion, status] = answers[i];
      const bool finite = is_finite(motion);
      if (finite && !has(status, Status::not_finite)) [[likely]]
        continue;
      weights_.mute(i);
      if (!finite) motion = answers[hold_at].motion;
    }
  }

  std::tuple<Ps...> predictors_;
  Weights weights_;
  Scalar position_rate_;
  Motion<axes, Scalar> motion_;  // returned last
  detail::SampleIntake<axes, Scalar> intake_;
  History<Issued, capacity> issued_;
};

}  // namespace limpid
