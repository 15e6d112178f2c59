// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/environment_estimate.hpp>
#include <limpid/prediction/lane_motion.hpp>
#include <limpid/prediction/model_predictor.hpp>  // Known, Estimated
#include <limpid/prediction/predictor.hpp>
#include <limpid/prediction/tool_in_model.hpp>
#include <limpid/signal/history.hpp>
#include <limpid/signal/intersample.hpp>

#include <concepts>
#include <cstddef>
#include <limits>

namespace limpid {

/// Replay: from each sample's own state and instant the tool (3.29) in the environment's model is integrated anew, over
/// the operator's force that was remembered, up to now. Between samples it goes on from there.
///
/// With the true model it is exact, however late, irregular, lost or out of order samples are; what a wrong model makes
/// of it lasts no longer than a sample. The step between two ticks is `ModelPredictor`'s: exact for the stated law of
/// F_h where the environment is linear and decoupled, where all ticks of one length share one response.
///
/// A tick replays no more than `ticks_per_update` ticks. A longer replay is spread over the ticks that follow, with the
/// estimate it began with, while the prediction before it goes on; at its end it takes over, and the newest sample that
/// arrived meanwhile is next. Samples taken before the first tick are replayed from that tick on, as if the tool had
/// stood there since; those from before the history are dropped.
///
/// What has squares that are not finite, sample or model or force, is not taken over: not_finite says so, as it does of
/// a replay that leads there and is given up.
/// @tparam Env         model of the environment
/// @tparam ToolModel   `Tool<axes, Scalar>`, or a type with its fields and `check`
/// @tparam Parameters  `Known`: no `use`; `Estimated`
/// @tparam Capacity    ticks of the operator's force remembered, a power of two
/// @realtime           no allocation, no throw; a step for the tick and for each one replayed, 20 flops an axis where
///                     ticks are alike in length and the environment linear, else some 150 to 300
template <Environment Env,
          typename ToolModel = Tool<EnvironmentTraits<Env>::axes, typename EnvironmentTraits<Env>::Scalar>,
          typename Parameters = Estimated, std::size_t Capacity = 512>
class ReplayPredictor {
  using Inside = detail::ToolInModel<Env>;

 public:
  using Scalar = typename Inside::Scalar;
  static constexpr int axes = Inside::axes;
  static constexpr int parameters = Inside::parameters;
  using Vector = EnvironmentVector<Env>;
  using Theta = EnvironmentTheta<Env>;

  struct Settings {
    Env environment{};  ///< its form
    ToolModel tool{};   ///< kg, N s/m, N/m
    /// Parameters: the known ones, or what serves until the first estimate.
    Theta theta = Theta::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    Intersample intersample = Intersample::linear;  ///< of F_h between ticks
    int ticks_per_update = 64;                      ///< replayed in one tick at most; >= 2, so that a replay ends
    Motion<axes, Scalar> start{};                   ///< x and v at the first tick; its a is not used
  };

  /// @throws std::invalid_argument  where the tool or a field is refused
  explicit ReplayPredictor(const Settings& settings)
      : inside_{settings.environment, checked(settings).tool},
        intersample_{settings.intersample},
        ticks_per_update_{settings.ticks_per_update} {
    course_.at = State(settings.start);
    expect(moderate(course_.at), "ReplayPredictor: start", "finite squares", "a motion that is too large");
    course_.theta = next_theta_ = settings.theta;
    course_.model = next_model_ = inside_.model_of(settings.theta, course_.at);
    expect(course_.model.moderate(), "ReplayPredictor: theta", "a finite stiffness and damping over the tool's mass",
           settings.theta);
  }

  /// Takes in an estimate; the next `advance` replays with it.
  /// @return  not_finite: it is not, or its stiffness or damping over the tool's mass is not; the one before stays
  [[nodiscard]] Status use(const EnvironmentEstimate<axes, parameters, Scalar>& estimate) noexcept requires
      std::same_as<Parameters, Estimated> {
    if (!is_finite(estimate.theta_hat)) return Status::not_finite;
    const Model model = inside_.model_of(estimate.theta_hat, course_.at);
    if (!model.moderate()) return Status::not_finite;
    next_theta_ = estimate.theta_hat;
    next_model_ = model;
    return Status::ok;
  }

  /// Takes in a sample that has arrived; the next `advance` replays from it.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<axes, Scalar>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (sample.taken > sample.arrived) return Status::clock_backwards;
    if (stamps_.seen(sample.taken)) return Status::out_of_order;
    observed_ = State(sample.value);
    stamps_.observe(sample.taken);
    return Status::ok;
  }

  /// The tool at `now`.
  /// @param F_h  operator's force at `now`, N
  [[nodiscard]] Prediction<axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    return flat<Scalar>([&]() noexcept { return advanced(now, to_lanes<axes>(F_h)); });
  }

  /// Whether a replay is still under way.
  [[nodiscard]] bool replaying() const noexcept { return replaying_; }

 private:
  using Array = typename Inside::Array;
  using State = typename Inside::State;
  using Model = typename Inside::Model;
  using Course = typename Inside::Course;

  static const Settings& checked(const Settings& s) {
    s.tool.check();
    expect(is_finite(s.theta), "ReplayPredictor: theta", "finite", s.theta);
    expect(is_finite(s.start), "ReplayPredictor: start", "finite", "a motion that is not");
    expect(s.ticks_per_update >= 2, "ReplayPredictor: ticks_per_update", ">= 2", s.ticks_per_update);
    return s;
  }

  // Whether the squares are finite: then so are the products and sums that follow from moderate values.
  static bool moderate(const State& s) noexcept { return are_finite(s.x * s.x, s.v * s.v); }

  [[nodiscard]] Prediction<axes, Scalar> advanced(Time now, const Array& F_h) noexcept {
    const Array pushed = F_h * inside_.per_mass();
    const bool late = started_ && now <= now_, finite = are_finite(pushed * pushed);
    if (late || !finite)
      return {motion_of_last(), when(late, Status::clock_backwards) | when(!finite, Status::not_finite)};
    Status status = started_ ? go_on(now, pushed) : Status::ok;
    if (!started_) begin_ = now;
    started_ = true;
    now_ = now;
    forces_.append(now, pushed);
    take_over_estimate();
    status |= take_over_sample();
    status |= replay();
    return {answer(pushed, status), status | when(!stamps_.any(), Status::no_sample)};
  }

  [[nodiscard]] Motion<axes, Scalar> motion_of_last() const noexcept { return course_.at.with(acceleration_); }

  [[nodiscard]] Motion<axes, Scalar> answer(const Array& pushed, Status& status) noexcept {
    const Array a = Inside::acceleration(course_.model, course_.at, pushed);
    if (are_finite(a)) [[likely]] {
      acceleration_ = a;
    } else {
      status |= Status::not_finite;
    }
    return motion_of_last();
  }

  // From the last tick to this one.
  Status go_on(Time now, const Array& pushed) noexcept {
    const State last = course_.at;
    const Status status = carry(course_, now_, forces_.value(forces_.size() - 1), now, pushed);
    if (moderate(course_.at)) [[likely]]
      return status;
    course_.at = last;
    inside_.look_around(course_, last);
    return status | Status::not_finite;
  }

  Status carry(Course& course, Time from, const Array& f0, Time to, const Array& f1) const noexcept {
    State next = course.at;
    const Status status = inside_.step(course, next, in_seconds<Scalar>(elapsed(to, from)), f0,
                                       intersample_ == Intersample::linear ? f1 : f0);
    course.at = next;
    inside_.look_around(course, next);
    return status;
  }

  void take_over_estimate() noexcept {
    if constexpr (std::same_as<Parameters, Estimated>) {
      if constexpr (Inside::exact) {
        course_.use(next_model_);
      } else if (!(course_.theta == next_theta_).all()) {
        course_.theta = next_theta_;
        inside_.look_around(course_, course_.at);
      }
    }
  }

  Status take_over_sample() noexcept {
    if (!stamps_.pending()) return Status::ok;
    if (const Status settled = stamps_.settle(now_); settled != Status::ok) return settled;
    if (!moderate(observed_)) return Status::not_finite;
    next_ = observed_;
    next_taken_ = stamps_.taken();
    waiting_ = true;
    return Status::ok;
  }

  // As far as this tick's work goes.
  Status replay() noexcept {
    Status status = Status::ok;
    for (int left = ticks_per_update_; left > 0 && (replaying_ || waiting_);) {
      if (!replaying_) status |= begin_replay();
      if (replaying_) status |= go_on_replaying(left);
    }
    return status;
  }

  // From the newest sample, by what is known now.
  Status begin_replay() noexcept {
    waiting_ = false;
    const Time from = next_taken_ < begin_ ? begin_ : next_taken_;
    if (from < forces_.time(0)) return Status::out_of_history;
    replayed_ = course_;
    replayed_.at = next_;
    inside_.look_around(replayed_, next_);
    at_ = from;
    pushed_ = force_at(from);
    replaying_ = true;
    return Status::ok;
  }

  // F_h / m there, as a step from there on starts with.
  [[nodiscard]] Array force_at(Time t) const noexcept {
    if (intersample_ == Intersample::linear) return forces_.at(t).value;
    const std::size_t i = forces_.first_not_before(t);
    return forces_.value(forces_.time(i) == t ? i : i - 1);
  }

  Status go_on_replaying(int& left) noexcept {
    const std::size_t size = forces_.size();
    std::size_t i = forces_.first_not_before(at_);
    if (i == 0 && at_ < forces_.time(0)) return give_up(Status::out_of_history);
    if (forces_.time(i) == at_) ++i;
    Status status = Status::ok;
    for (; i < size && left > 0; ++i, --left) {
      status |= carry(replayed_, at_, pushed_, forces_.time(i), forces_.value(i));
      at_ = forces_.time(i);
      pushed_ = forces_.value(i);
    }
    if (!moderate(replayed_.at)) return give_up(status | Status::not_finite);
    if (i < size) return status;
    course_.at = replayed_.at;
    inside_.look_around(course_, course_.at);
    replaying_ = false;
    return status;
  }

  Status give_up(Status why) noexcept {
    replaying_ = false;
    return why;
  }

  Inside inside_;
  Intersample intersample_;
  int ticks_per_update_;
  Course course_;                       // at the last tick
  Array acceleration_ = Array::Zero();  // and there, m/s^2
  Theta next_theta_;                    // of the newest estimate
  Model next_model_;
  State observed_{}, next_{};  // the newest sample's; the one to replay next, where there is one
  SampleStamps stamps_;
  Time next_taken_{};
  Course replayed_;  // at `at_`, where F_h / m is `pushed_`
  Array pushed_ = Array::Zero();
  Time at_{};
  bool waiting_ = false, replaying_ = false, started_ = false;
  Time begin_{}, now_{};             // the first tick and the last
  History<Array, Capacity> forces_;  // F_h / m, m/s^2
};

}  // namespace limpid
