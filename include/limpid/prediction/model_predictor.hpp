// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
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
/// step.
///
/// A sample from before the first tick is compared with the start, as if the prediction had stood there until then. One
/// from before the history (Capacity ticks) or after its newest entry cannot be compared, and is dropped.
/// @tparam Env         model of the environment
/// @tparam ToolModel   `Tool<axes, Scalar>`, or a type with its fields and `check`
/// @tparam Parameters  `Known`: no `use`; `Estimated`
/// @tparam Gain        `ConstantGain` or `ScheduledGain`
/// @tparam Capacity    ticks remembered, a power of two
/// @realtime           no allocation, no throw; some 150 flops an axis when parameters or dt changed, else 25
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
    Theta theta;        ///< parameters: the known ones, or what serves until the first estimate
    Gain gain{};        ///< L
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
        next_theta_{settings.theta},
        motion_{settings.start},
        start_{settings.start} {
    tool_.check();
    gain_.check();
    expect(is_finite(theta_), "ModelPredictor: theta", "finite", theta_);
    expect(is_finite(motion_), "ModelPredictor: start", "finite", "a motion that is not");
    motion_.a.setZero();
    if constexpr (exact) linearise();
  }

  /// Takes in an estimate; it holds from the next `advance` on.
  Status use(const EnvironmentEstimate<axes, parameters, Scalar>& estimate) noexcept requires
      std::same_as<Parameters, Estimated> {
    if (!is_finite(estimate.theta_hat)) return Status::not_finite;
    next_theta_ = estimate.theta_hat;
    return Status::ok;
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  Status observe(const ToolSample<axes, Scalar>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (observed_ && sample.taken <= observation_.taken) return Status::out_of_order;
    observation_ = {{sample.value.x, sample.value.v, sample.value.a}, sample.taken, sample.arrived};
    observed_ = pending_ = true;
    return Status::ok;
  }

  /// The tool at `now`.
  /// @param F_h  operator's force at `now`, N
  Prediction<axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (!is_finite(Vector(F_h / tool_.mass))) return {motion_, Status::not_finite};
    if (started_ && now <= now_) return {motion_, Status::clock_backwards};
    const Scalar dt = started_ ? in_seconds<Scalar>(now - now_) : Scalar{0};
    Motion<axes, Scalar> next = motion_;
    if (started_) step(next, dt, F_h);
    if (!is_finite(next)) return {motion_, Status::not_finite};
    if (!started_) begin_ = now;
    started_ = true;
    now_ = now;
    F_h_ = F_h;
    Status status = history_.push(now, next);
    status |= take_over();
    if constexpr (Gain::scheduled) status |= gain_.update(dt, Traits::tangent(environment_, theta_, next.x, next.v));
    feedback_ = gain_.row()(error_.x, error_.v);
    next.a = acceleration(next.x, next.v);
    if (!is_finite(next)) return {motion_, status | Status::not_finite};
    motion_ = next;
    return {motion_, status | when(!observed_, Status::no_sample)};
  }

 private:
  static constexpr bool exact = LinearEnvironment<Env> && DecoupledEnvironment<Env>;

  // e_zd and theta_hat from now on.
  Status take_over() noexcept {
    if constexpr (std::same_as<Parameters, Estimated>) {
      if ((theta_ != next_theta_).any()) {
        theta_ = next_theta_;
        if constexpr (exact) linearise();
      }
    }
    if (!pending_) return Status::ok;
    pending_ = false;
    const bool before = observation_.taken < begin_;
    const auto [mine, status] = history_.at(observation_.taken);
    if (!before && status != Status::ok) return status;
    const auto error = (before ? start_ : mine) - observation_.value;
    if (!is_finite(gain_.row()(error.x, error.v))) return Status::not_finite;
    error_ = error;
    return Status::ok;
  }

  // The coefficients of x'' + beta x' + kappa x = (F_h + L e) / m + constant.
  void linearise() noexcept {
    const Vector zero = Vector::Zero();
    set_tangent(Traits::tangent(environment_, theta_, zero, zero));
    constant_ = (tool_.stiffness * tool_.anchor - Traits::force(environment_, theta_, zero, zero)) / tool_.mass;
  }

  void set_tangent(const Tangents<axes, Scalar>& tangent) noexcept {
    kappa_ = (tangent.stiffness + tool_.stiffness) / tool_.mass;
    beta_ = (tangent.damping + tool_.damping) / tool_.mass;
    h_ = Scalar{0};  // of no step
  }

  void step(Motion<axes, Scalar>& to, const Scalar& dt, const Vector& F_h) noexcept {
    const Vector f0 = (F_h_ + feedback_) / tool_.mass;
    const Vector f1 = intersample_ == Intersample::linear ? Vector((F_h + feedback_) / tool_.mass) : f0;
    if constexpr (exact) {
      if (dt != h_) {
        response_.set(kappa_, beta_, dt);
        h_ = dt;
      }
      response_.advance(to.x, to.v, f0 + constant_, f1 + constant_);
    } else {
      step_about_tangent(to, dt, f0, f1);
    }
  }

  void step_about_tangent(Motion<axes, Scalar>& to, const Scalar& dt, const Vector& f0, const Vector& f1) noexcept {
    const Vector x = to.x, v = to.v;
    const auto tangent = Traits::tangent(environment_, theta_, x, v);
    set_tangent(tangent);
    response_.set(kappa_, beta_, dt);
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
      return (F_h_ + feedback_) / tool_.mass + constant_ - beta_ * v - kappa_ * x;
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
  Vector kappa_ = Vector::Zero(), beta_ = Vector::Zero(), constant_ = Vector::Zero();
  Scalar h_{0};  // dt that response_ is set for
  SecondOrderStep<axes, Scalar> response_;
  Sample<Motion<axes, Scalar>> observation_{};  // the newest one
  bool started_ = false, observed_ = false, pending_ = false;
  Time begin_{}, now_{};  // the first tick and the last
  History<Motion<axes, Scalar>, Capacity> history_;
};

}  // namespace limpid
