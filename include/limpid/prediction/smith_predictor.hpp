// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/environment_estimate.hpp>
#include <limpid/prediction/lane_motion.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/prediction/sample_intake.hpp>
#include <limpid/signal/history.hpp>

#include <concepts>
#include <cstddef>

namespace limpid {

/// Smith's predictor: the model runs beside the tool, without feedback, and what the newest sample differs from the
/// model's own past at its instant is added:
///
///     x = x_m(now) + x_sample - x_m(taken),     v likewise;     a = a_m(now)
///
/// Before the first tick the model stands at its start.
/// @tparam Env         model of the environment
/// @tparam ToolModel   `Tool<axes, Scalar>`, or a type with its fields and `check`
/// @tparam Parameters  `Known`: no `use`; `Estimated`
/// @tparam Capacity    ticks of the model remembered, a power of two
/// @realtime           no allocation, no throw; a `ModelPredictor`, and a search for each new sample
template <Environment Env,
          typename ToolModel = Tool<EnvironmentTraits<Env>::axes, typename EnvironmentTraits<Env>::Scalar>,
          typename Parameters = Estimated, std::size_t Capacity = 512>
class SmithPredictor {
  static constexpr std::size_t none = 2;  // ticks that the model itself remembers: it has no samples to compare with
  using Model =
      ModelPredictor<Env, ToolModel, Parameters,
                     ConstantGain<EnvironmentTraits<Env>::axes, typename EnvironmentTraits<Env>::Scalar>, none>;

 public:
  using Scalar = typename Model::Scalar;
  static constexpr int axes = Model::axes;
  static constexpr int parameters = Model::parameters;
  using Vector = typename Model::Vector;
  using Settings = typename Model::Settings;  ///< of ModelPredictor; its gain is not used

  /// @throws std::invalid_argument  as ModelPredictor's
  explicit SmithPredictor(const Settings& settings) : model_{without_gain(settings)}, start_{settings.start} {
    motion_ = settings.start;
    motion_.a.setZero();
  }

  /// Takes in an estimate; it holds from the next `advance` on.
  /// @return  not_finite: it is not, or its stiffness or damping over the tool's mass is not; the one before stays
  [[nodiscard]] Status use(const EnvironmentEstimate<axes, parameters, Scalar>& estimate) noexcept requires
      std::same_as<Parameters, Estimated> {
    return model_.use(estimate);
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<axes, Scalar>& sample) noexcept { return intake_.observe(sample); }

  /// The tool at `now`.
  /// @param F_h  operator's force at `now`, N
  /// @return     out_of_history: a sample taken after `now` or before the history was dropped; not_finite: what came
  ///             out is not, and the last motion was returned
  [[nodiscard]] Prediction<axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (const Status refused = intake_.refusal(now, F_h); refused != Status::ok) return {motion_, refused};
    const auto [model, model_status] = model_.advance(now, F_h);
    Status status = intake_.begin(now) | (has(model_status, Status::not_finite) ? Status::not_finite : Status::ok);
    if (history_.size() == 0) begin_ = now;
    history_.append(now, State(model));
    if (intake_.fresh()) status |= compare();
    const State sum = State(model) + difference_;
    if (!is_finite(sum)) return {motion_, status | Status::not_finite};
    motion_ = sum.with(to_lanes<axes>(model.a));
    return {motion_, status};
  }

 private:
  using State = detail::LaneMotion<axes, Scalar>;

  static Settings without_gain(Settings settings) {
    settings.gain = {};
    return settings;
  }

  Status compare() noexcept {
    const bool before = intake_.taken() < begin_;
    const auto [past, status] = history_.at(intake_.taken());
    if (!before && status != Status::ok) return status;
    const State difference = State(intake_.held()) - (before ? start_ : past);
    if (!is_finite(difference)) return Status::not_finite;
    difference_ = difference;
    return Status::ok;
  }

  Model model_;
  State start_, difference_{};
  Motion<axes, Scalar> motion_;  // returned last
  detail::SampleIntake<axes, Scalar> intake_;
  Time begin_{};                      // the first tick
  History<State, Capacity> history_;  // of the model
};

}  // namespace limpid
