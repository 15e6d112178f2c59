// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/any_above.hpp>
#include <limpid/estimation/environment_estimate.hpp>
#include <limpid/prediction/gains.hpp>
#include <limpid/prediction/lane_motion.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/prediction/tool_in_model.hpp>
#include <limpid/signal/history.hpp>
#include <limpid/signal/intersample.hpp>
#include <limpid/signal/sample.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>

namespace limpid {

/// Parameters of a ModelPredictor's environment that are known at construction: cases 1 and 2.
struct Known {};

/// Parameters that an estimator supplies between ticks: cases 3 and 4.
struct Estimated {};

/// Predictor of thesis section 4.3: the tool in a model of its environment, drawn to the late samples, (4.25), (4.39):
///
///     m_t x'' + b_t x' + k_t (x - anchor) = F_h - F_e(theta_hat, x, x') + L e_zd
///
/// e_zd is the error that the prediction had at the instant at which the newest sample was taken, held until the next
/// one.
///
/// `advance` integrates from the last tick to `now` with what was held then; only at its end a sample observed for this
/// tick and a new estimate are taken over, and from then on held. For a linear decoupled environment the step is exact
/// for the stated law of F_h between ticks. For another one the remainder of the force beside its tangent at the start
/// is matched in its moments by one correction, and steps in which the tangent changes much are taken in up to 32
/// parts (`detail::NonlinearStep`): of order 3 where the force is smooth, its error going as dt^3. Where it is not, as
/// in `Unilateral` where contact opens or closes, a step is of lower order. `coarse` says that parts were too long
/// still, as where sqrt(stiffness/mass) dt is above 32; they are of order 1, and damped. Axes that feel each other are
/// followed to order 2, in one step at any length: there a long dt beside a stiff coupling may diverge.
///
/// A constant gain is designed for a tissue. Where that is not touched (`Unilateral`) the tool alone is left, and the
/// same gain may be unstable: for a tool of 0.1 kg and 0.1 N s/m seen every 16 ms, 16 ms late, (-195.1, -4.89) takes
/// the error to 0.51 of itself from sample to sample in 900 N/m, 25 N s/m, and to 1.18 of itself in free space; (-20,
/// -1.5) to 0.54 and 0.88 (`sampled_radius`). Take a gain that is stable in both, none, or a `ScheduledGain` whose box
/// holds free space.
///
/// Absurd inputs leave no lasting trace. A motion, a model or a force whose squares are not finite is not taken over,
/// nor a sample for which L e_zd / m_t is not finite: not_finite says so. A step that leads to such a motion is not
/// taken: the tool stands at its last good motion, e_zd is forgotten, and what was observed for the tick is taken over
/// as ever.
///
/// A gain that was designed in contact may be unstable outside it, and a sample may be wrong. Where the prediction was
/// off by more than `lost_beyond` at a sample's instant there is no feedback until the next one; where it was at two
/// samples in a row, it starts again from the second. `lost` says so.
///
/// A sample from before the first tick is compared with the start, as if the prediction had stood there until then. One
/// from before the history (Capacity ticks) or after `now` cannot be compared, and is dropped.
/// @tparam Env         model of the environment
/// @tparam ToolModel   `Tool<axes, Scalar>`, or a type with its fields and `check`
/// @tparam Parameters  `Known`: no `use`; `Estimated`
/// @tparam Gain        `ConstantGain` or `ScheduledGain`
/// @tparam Capacity    ticks remembered, a power of two
/// @realtime           no allocation, no throw; some 150 flops an axis when parameters or dt changed, else 30. Of an
///                     environment that is not linear two responses a tick, and at most some 1000 in a tick that is
///                     stiff and long
template <Environment Env,
          typename ToolModel = Tool<EnvironmentTraits<Env>::axes, typename EnvironmentTraits<Env>::Scalar>,
          typename Parameters = Estimated,
          PredictorGain<EnvironmentTraits<Env>::axes, typename EnvironmentTraits<Env>::Scalar> Gain =
              ConstantGain<EnvironmentTraits<Env>::axes, typename EnvironmentTraits<Env>::Scalar>,
          std::size_t Capacity = 512>
class ModelPredictor {
  using Traits = EnvironmentTraits<Env>;

 public:
  using Scalar = typename Traits::Scalar;
  static constexpr int axes = Traits::axes;
  static constexpr int parameters = Traits::parameters;
  using Vector = EnvironmentVector<Env>;
  using Theta = EnvironmentTheta<Env>;

  struct Settings {
    Env environment{};  ///< its form
    ToolModel tool{};   ///< kg, N s/m, N/m
    /// Parameters: the known ones, or what serves until the first estimate.
    Theta theta = Theta::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    Gain gain{};                                    ///< L
    Intersample intersample = Intersample::linear;  ///< of F_h between ticks
    Motion<axes, Scalar> start{};                   ///< x and v at the first tick; its a is not used
    Scalar lost_beyond = Scalar{1} / Scalar{10};    ///< error of a position that is too large to be true, m
  };

  /// @throws std::invalid_argument  where the tool, the gain or a field is refused
  explicit ModelPredictor(const Settings& settings)
      : inside_{settings.environment, checked(settings).tool},
        gain_{settings.gain},
        intersample_{settings.intersample},
        lost_beyond_{settings.lost_beyond},
        next_theta_{settings.theta},
        start_{settings.start} {
    course_.at = start_;
    expect(moderate(start_), "ModelPredictor: start", "finite squares", "a motion that is too large");
    course_.theta = settings.theta;
    course_.model = next_model_ = inside_.model_of(settings.theta, start_);
    expect(next_model_.moderate(), "ModelPredictor: theta", "a finite stiffness and damping over the tool's mass",
           settings.theta);
  }

  /// Takes in an estimate; it holds from the next `advance` on.
  /// @return  not_finite: it is not, or its stiffness or damping over the tool's mass is not; the one before stays
  [[nodiscard]] Status use(const EnvironmentEstimate<axes, parameters, Scalar>& estimate) noexcept requires
      std::same_as<Parameters, Estimated> {
    if constexpr (!exact) {
      if ((estimate.theta_hat == next_theta_).all()) return Status::ok;
      if (!is_finite(estimate.theta_hat)) return Status::not_finite;
    }
    const Model model = inside_.model_of(estimate.theta_hat, course_.at);
    if (exact && model.same_as(next_model_)) return Status::ok;
    if (!model.moderate()) return Status::not_finite;
    if constexpr (needs_theta) next_theta_ = estimate.theta_hat;
    next_model_ = model;
    estimated_ = true;
    return Status::ok;
  }

  /// Takes in a gain designed anew; it holds from the next `advance` on.
  /// @return  not_finite: it is not, or L e_zd / m_t is not; the one before stays
  [[nodiscard]] Status replace_gain(const Gain& gain) noexcept requires(!Gain::scheduled) {
    const auto& L = gain.row();
    if (!is_finite(L.L1) || !is_finite(L.L2)) return Status::not_finite;
    if (!are_finite(feedback_of(gain, error_))) return Status::not_finite;
    gain_ = gain;  // `advance` asks for it only after its step
    return Status::ok;
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<axes, Scalar>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (sample.taken > sample.arrived) return Status::clock_backwards;
    if (newest_.seen(sample.taken)) return Status::out_of_order;
    observation_ = State(sample.value);
    newest_.observe(sample.taken);
    return Status::ok;
  }

  /// The tool at `now`.
  /// @param F_h  operator's force at `now`, N
  [[nodiscard]] Prediction<axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    return flat<Scalar>([&]() noexcept { return advanced(now, to_lanes<axes>(F_h)); });
  }

 private:
  using Inside = detail::ToolInModel<Env>;
  using Array = typename Inside::Array;
  using State = typename Inside::State;
  using Model = typename Inside::Model;

  static constexpr bool exact = Inside::exact;

  // Else the model says it all.
  static constexpr bool needs_theta = !exact || Gain::scheduled;

  static const Settings& checked(const Settings& s) {
    s.tool.check();
    s.gain.check();
    expect(is_finite(s.theta), "ModelPredictor: theta", "finite", s.theta);
    expect(is_finite(s.start), "ModelPredictor: start", "finite", "a motion that is not");
    expect(s.lost_beyond > Scalar{0}, "ModelPredictor: lost_beyond", "> 0", s.lost_beyond);
    return s;
  }

  [[nodiscard]] Prediction<axes, Scalar> advanced(Time now, const Array& F_h) noexcept {
    const Array pushed = F_h * inside_.per_mass();
    if (started_ && now <= now_) [[unlikely]]
      return untouched(are_finite(pushed * pushed) ? Status::clock_backwards : Status::not_finite);
    const Scalar dt = started_ ? in_seconds<Scalar>(elapsed(now, now_)) : Scalar{0};
    State next = course_.at;
    Status status = started_ ? step(next, dt, pushed) : Status::ok;
    if (!are_finite(next.x * next.x, next.v * next.v, pushed * pushed)) [[unlikely]] {
      if (!are_finite(pushed * pushed)) return untouched(Status::not_finite);
      next = course_.at;
      error_ = {};
      status |= Status::not_finite;
    }
    if (!started_) begin_ = now;
    started_ = true;
    now_ = now;
    pushed_ = pushed;
    history_.append(now, next);
    take_over_estimate();
    inside_.look_around(course_, next);
    if constexpr (Gain::scheduled) status |= schedule(dt, next);
    status |= take_over_sample(next);
    fed_back_ = feedback_of(gain_, error_);
    Array a = acceleration(next);
    if (!are_finite(a)) [[unlikely]] {
      a = acceleration_;
      error_ = {};
      fed_back_.setZero();
      status |= Status::not_finite;
    }
    course_.at = next;
    acceleration_ = a;
    return {next.with(a), status | when(!newest_.any(), Status::no_sample)};
  }

  [[nodiscard]] Prediction<axes, Scalar> untouched(Status status) const noexcept {
    return {course_.at.with(acceleration_), status};
  }

  // L e / m, m/s^2
  [[nodiscard]] Array feedback_of(const Gain& gain, const State& error) const noexcept {
    const auto& L = gain.row();
    return (to_lanes<axes>(L.L1) * error.x + to_lanes<axes>(L.L2) * error.v) * inside_.per_mass();
  }

  // Whether the squares are finite: then so are the products and sums that follow from moderate values.
  static bool moderate(const State& s) noexcept { return are_finite(s.x * s.x, s.v * s.v); }

  // theta_hat from now on.
  void take_over_estimate() noexcept {
    if constexpr (std::same_as<Parameters, Estimated>) {
      if (!estimated_) return;
      estimated_ = false;
      if constexpr (needs_theta) course_.theta = next_theta_;
      course_.model = next_model_;
      course_.h = Scalar{0};  // of no step
    }
  }

  // A tangent that is not finite would stay in the schedule for ever.
  Status schedule(const Scalar& dt, const State& at) noexcept {
    const auto rho = inside_.tangent(course_.theta, at);
    if (!is_finite(rho.stiffness) || !is_finite(rho.damping)) return Status::not_finite;
    return gain_.update(dt, rho);
  }

  // e_zd from now on.
  Status take_over_sample(State& at) noexcept {
    if (!newest_.pending()) return Status::ok;
    if (const Status settled = newest_.settle(now_); settled != Status::ok) return settled;
    const bool before = newest_.taken() < begin_;
    const auto [mine, status] = history_.at(newest_.taken());
    if (!before && status != Status::ok) return status;
    const State error = (before ? start_ : mine) - observation_;
    if (!are_finite(feedback_of(gain_, error))) return Status::not_finite;
    if (any_above(Array(error.x.abs()), lost_beyond_)) [[unlikely]]
      return lose(at);
    doubted_ = false;
    error_ = error;
    return Status::ok;
  }

  // One sample far off may be wrong itself; after a second one the tool is where that was.
  Status lose(State& at) noexcept {
    error_ = {};
    if (doubted_ && moderate(observation_)) at = observation_;
    inside_.look_around(course_, at);
    doubted_ = true;
    return Status::lost;
  }

  // From the last tick to the next one, dt seconds later, at whose end F_h / m is `pushed`.
  Status step(State& to, const Scalar& dt, const Array& pushed) noexcept {
    const Array f0 = pushed_ + fed_back_;
    const Array f1 = intersample_ == Intersample::linear ? Array(pushed + fed_back_) : f0;
    return inside_.step(course_, to, dt, f0, f1);
  }

  [[nodiscard]] Array acceleration(const State& at) const noexcept {
    return Inside::acceleration(course_.model, at, pushed_ + fed_back_);
  }

  Inside inside_;
  Gain gain_;
  Intersample intersample_;
  Scalar lost_beyond_;                  // m
  typename Inside::Course course_;      // at the last tick
  Theta next_theta_;                    // of the newest estimate
  Model next_model_;                    // of next_theta_
  Array acceleration_ = Array::Zero();  // and there, m/s^2
  State start_;                         // before the first tick
  State error_{};                       // e_zd
  Array fed_back_ = Array::Zero();      // L e_zd / m_t, m/s^2
  Array pushed_ = Array::Zero();        // F_h / m_t at the last tick, m/s^2
  State observation_{};                 // the newest sample's
  SampleStamps newest_;
  bool started_ = false, estimated_ = false, doubted_ = false;
  Time begin_{}, now_{};  // the first tick and the last
  History<State, Capacity> history_;
};

}  // namespace limpid
