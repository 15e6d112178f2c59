// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/environment_estimate.hpp>
#include <limpid/prediction/gains.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/signal/history.hpp>
#include <limpid/signal/intersample.hpp>
#include <limpid/signal/sample.hpp>

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
/// for the stated law of F_h between ticks. For another one it is exact but for the remainder of the force beside its
/// tangent at the start, taken as linear in time over the step and found by two corrections: error of order dt^3 in a
/// step in which the force is smooth. Where it is not, as in `Unilateral` where contact opens or closes, that step is
/// of lower order.
///
/// Absurd inputs leave no lasting trace. A motion, a model or a force whose squares are not finite is not taken over,
/// nor a sample for which L e_zd / m_t is not finite: not_finite says so. A step that leads to such a motion is not
/// taken: the tool stands at its last good motion, e_zd is forgotten, and what was observed for the tick is taken over
/// as ever.
///
/// A sample from before the first tick is compared with the start, as if the prediction had stood there until then. One
/// from before the history (Capacity ticks) or after `now` cannot be compared, and is dropped.
/// @tparam Env         model of the environment
/// @tparam ToolModel   `Tool<axes, Scalar>`, or a type with its fields and `check`
/// @tparam Parameters  `Known`: no `use`; `Estimated`
/// @tparam Gain        `ConstantGain` or `ScheduledGain`
/// @tparam Capacity    ticks remembered, a power of two
/// @realtime           no allocation, no throw; some 150 flops an axis when parameters or dt changed, else 30
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
  };

  /// @throws std::invalid_argument  where the tool, the gain or a field is refused
  explicit ModelPredictor(const Settings& settings)
      : environment_{settings.environment},
        tool_{settings.tool},
        gain_{settings.gain},
        intersample_{settings.intersample},
        theta_{settings.theta},
        motion_{settings.start},
        start_{settings.start} {
    tool_.check();
    gain_.check();
    expect(is_finite(theta_), "ModelPredictor: theta", "finite", theta_);
    expect(is_finite(motion_), "ModelPredictor: start", "finite", "a motion that is not");
    expect(moderate(motion_), "ModelPredictor: start", "finite squares", "a motion that is too large");
    motion_.a.setZero();
    model_ = model_of(theta_, motion_);
    expect(moderate(model_), "ModelPredictor: theta", "a finite stiffness and damping over the tool's mass", theta_);
    next_theta_ = theta_;
    next_model_ = model_;
  }

  /// Takes in an estimate; it holds from the next `advance` on.
  /// @return  not_finite: it is not, or its stiffness or damping over the tool's mass is not; the one before stays
  [[nodiscard]] Status use(const EnvironmentEstimate<axes, parameters, Scalar>& estimate) noexcept requires
      std::same_as<Parameters, Estimated> {
    if ((estimate.theta_hat == next_theta_).all()) return Status::ok;
    if (!((estimate.theta_hat * Scalar{0}).sum() == Scalar{0})) return Status::not_finite;
    const Model model = model_of(estimate.theta_hat, motion_);
    if (!moderate(model)) return Status::not_finite;
    next_theta_ = estimate.theta_hat;
    next_model_ = model;
    estimated_ = true;
    return Status::ok;
  }

  /// Takes in a gain designed anew; it holds from the next `advance` on.
  /// @return  not_finite: it is not, or L e_zd / m_t is not; the one before stays
  [[nodiscard]] Status replace_gain(const Gain& gain) noexcept requires(!Gain::scheduled) {
    const auto& L = gain.row();
    if (!is_finite(L.L1) || !is_finite(L.L2)) return Status::not_finite;
    if (!is_finite(Vector(L(error_.x, error_.v) / tool_.mass))) return Status::not_finite;
    gain_ = gain;  // `advance` asks for it only after its step
    return Status::ok;
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<axes, Scalar>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (sample.taken > sample.arrived) return Status::clock_backwards;
    if (newest_.seen(sample.taken)) return Status::out_of_order;
    observation_ = {sample.value.x, sample.value.v, sample.value.a};
    newest_.observe(sample.taken);
    return Status::ok;
  }

  /// The tool at `now`.
  /// @param F_h  operator's force at `now`, N
  [[nodiscard]] Prediction<axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    return flat<Scalar>([&]() noexcept { return advanced(now, F_h); });
  }

 private:
  [[nodiscard]] Prediction<axes, Scalar> advanced(Time now, const Vector& F_h) noexcept {
    if (!is_finite(Vector((F_h / tool_.mass).square()))) return {motion_, Status::not_finite};
    if (started_ && now <= now_) return {motion_, Status::clock_backwards};
    const Scalar dt = started_ ? in_seconds<Scalar>(elapsed(now, now_)) : Scalar{0};
    Motion<axes, Scalar> next = motion_;
    Status status = Status::ok;
    if (started_) {
      step(next, dt, F_h);
      if (!moderate(next)) [[unlikely]] {
        next = motion_;
        error_ = {};
        status = Status::not_finite;
      }
    } else {
      begin_ = now;
      started_ = true;
    }
    now_ = now;
    F_h_ = F_h;
    status |= history_.push(now, next);
    take_over_estimate();
    if constexpr (Gain::scheduled) status |= schedule(dt, next);
    status |= take_over_sample();
    feedback_ = gain_.row()(error_.x, error_.v);
    next.a = acceleration(next.x, next.v);
    if (!is_finite(next.a)) [[unlikely]] {
      next.a = motion_.a;
      error_ = {};
      feedback_.setZero();
      status |= Status::not_finite;
    }
    motion_ = next;
    return {motion_, status | when(!newest_.any(), Status::no_sample)};
  }

  static constexpr bool exact = LinearEnvironment<Env> && DecoupledEnvironment<Env>;

  // The coefficients of x'' + beta x' + kappa x = (F_h + L e) / m + constant.
  struct Model {
    Vector kappa, beta, constant;
  };

  // Everywhere, or, where the environment is not linear, as the start of a step at `at` sees it.
  [[nodiscard]] Model model_of(const Theta& theta, const Motion<axes, Scalar>& at) const noexcept {
    const Vector x = exact ? Vector(Vector::Zero()) : at.x, v = exact ? Vector(Vector::Zero()) : at.v;
    const auto tangent = Traits::tangent(environment_, theta, x, v);
    return {(tangent.stiffness + tool_.stiffness) / tool_.mass, (tangent.damping + tool_.damping) / tool_.mass,
            (tool_.stiffness * tool_.anchor - Traits::force(environment_, theta, x, v)) / tool_.mass};
  }

  // Whether the squares are finite: then so are the products and sums that follow from moderate values. One test for
  // all entries: zero times a finite number is zero, times any other it is NaN.
  static bool moderate(const Motion<axes, Scalar>& motion) noexcept {
    const Scalar none{0};
    return ((motion.x * motion.x + motion.v * motion.v) * none).sum() == none;
  }
  static bool moderate(const Model& m) noexcept {
    const Scalar none{0};
    return ((m.kappa * m.kappa + m.beta * m.beta + m.constant * m.constant) * none).sum() == none;
  }

  // theta_hat from now on.
  void take_over_estimate() noexcept {
    if constexpr (std::same_as<Parameters, Estimated>) {
      if (!estimated_) return;
      estimated_ = false;
      theta_ = next_theta_;
      model_ = next_model_;
      h_ = Scalar{0};  // of no step
    }
  }

  // A tangent that is not finite would stay in the schedule for ever.
  Status schedule(const Scalar& dt, const Motion<axes, Scalar>& at) noexcept {
    const auto rho = Traits::tangent(environment_, theta_, at.x, at.v);
    if (!is_finite(rho.stiffness) || !is_finite(rho.damping)) return Status::not_finite;
    return gain_.update(dt, rho);
  }

  // e_zd from now on.
  Status take_over_sample() noexcept {
    if (!newest_.pending()) return Status::ok;
    if (const Status settled = newest_.settle(now_); settled != Status::ok) return settled;
    const bool before = newest_.taken() < begin_;
    const auto [mine, status] = history_.at(newest_.taken());
    if (!before && status != Status::ok) return status;
    const auto error = (before ? start_ : mine) - observation_;
    if (!is_finite(Vector(gain_.row()(error.x, error.v) / tool_.mass))) return Status::not_finite;
    error_ = error;
    return Status::ok;
  }

  void step(Motion<axes, Scalar>& to, const Scalar& dt, const Vector& F_h) noexcept {
    const Vector f0 = (F_h_ + feedback_) / tool_.mass;
    const Vector f1 = intersample_ == Intersample::linear ? Vector((F_h + feedback_) / tool_.mass) : f0;
    if constexpr (exact) {
      if (dt != h_) {
        response_.set(model_.kappa, model_.beta, dt);
        h_ = dt;
      }
      response_.advance(to.x, to.v, f0 + model_.constant, f1 + model_.constant);
    } else {
      step_about_tangent(to, dt, f0, f1);
    }
  }

  void step_about_tangent(Motion<axes, Scalar>& to, const Scalar& dt, const Vector& f0, const Vector& f1) noexcept {
    const Vector x = to.x, v = to.v;
    const auto tangent = Traits::tangent(environment_, theta_, x, v);
    response_.set((tangent.stiffness + tool_.stiffness) / tool_.mass, (tangent.damping + tool_.damping) / tool_.mass,
                  dt);
    const auto remainder = [&](const Vector& at_x, const Vector& at_v) -> Vector {
      const Vector F_e = Traits::force(environment_, theta_, at_x, at_v);
      return (tool_.stiffness * tool_.anchor - F_e + tangent.stiffness * at_x + tangent.damping * at_v) / tool_.mass;
    };
    const Vector r0 = remainder(x, v);
    response_.advance(to.x, to.v, f0 + r0, f1 + r0);
    for (int correction = 0; correction < 2; ++correction) {
      const Vector r1 = remainder(to.x, to.v);
      to.x = x;
      to.v = v;
      response_.advance(to.x, to.v, f0 + r0, f1 + r1);
    }
  }

  [[nodiscard]] Vector acceleration(const Vector& x, const Vector& v) const noexcept {
    if constexpr (exact) {
      return (F_h_ + feedback_) / tool_.mass + model_.constant - model_.beta * v - model_.kappa * x;
    } else {
      return (F_h_ + feedback_ - Traits::force(environment_, theta_, x, v) - tool_.damping * v -
              tool_.stiffness * (x - tool_.anchor)) /
             tool_.mass;
    }
  }

  Env environment_;
  ToolModel tool_;
  Gain gain_;
  Intersample intersample_;
  Theta theta_, next_theta_;          // held; of the newest estimate
  Motion<axes, Scalar> motion_;       // at the last tick
  Motion<axes, Scalar> start_;        // and before the first one
  Motion<axes, Scalar> error_{};      // e_zd
  Vector feedback_ = Vector::Zero();  // L e_zd, N
  Vector F_h_ = Vector::Zero();       // at the last tick, N
  Model model_, next_model_;          // of theta_, of next_theta_
  Scalar h_{0};                       // dt that response_ is set for
  SecondOrderStep<axes, Scalar> response_;
  Motion<axes, Scalar> observation_{};  // the newest sample's
  SampleStamps newest_;
  bool started_ = false, estimated_ = false;
  Time begin_{}, now_{};  // the first tick and the last
  History<Motion<axes, Scalar>, Capacity> history_;
};

}  // namespace limpid
