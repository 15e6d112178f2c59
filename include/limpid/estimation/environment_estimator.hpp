// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/environment_estimate.hpp>
#include <limpid/estimation/projection_rls.hpp>
#include <limpid/signal/sample.hpp>

namespace limpid {

/// Estimates an environment's parameters from samples of the tool: `ProjectionRLS` on the regressor of (4.43), with the
/// known part of the force taken off.
///
/// Over [previous now, now] the law runs with the sample that was held then; only at its end the new one is taken over.
/// The law is causal and its discretisation exact. Before the first sample it does not run.
///
/// A held sample that the law refuses (`ProjectionRLS::update`) is refused on every tick until a new one comes: no axis
/// learns, time passes, and each tick says so.
///
/// In an environment that is not bilateral an axis on which nothing pushes back is not in contact: its force says
/// nothing of the parameters, and the law runs there with phi = 0 and F = 0.
/// @tparam Env  the model whose parameters are sought
/// @realtime    update: no allocation, no throw; a step of the law, and one regressor for each new sample
template <Environment Env>
class EnvironmentEstimator {
 public:
  using Scalar = typename EnvironmentTraits<Env>::Scalar;
  static constexpr int axes = EnvironmentTraits<Env>::axes;
  static constexpr int parameters = EnvironmentTraits<Env>::parameters;

  using Law = ProjectionRLS<parameters, axes, Scalar>;
  using Estimate = EnvironmentEstimate<axes, parameters, Scalar>;

  struct Settings {
    Env environment;             ///< its form; the parameters are what is sought
    typename Law::Settings law;  ///< box, start and gains, see ProjectionRLS
  };

  /// @throws std::invalid_argument  where the law's settings are refused
  explicit EnvironmentEstimator(const Settings& settings) : environment_{settings.environment}, law_{settings.law} {}

  /// Brings the estimate to `now` and holds `sample` from now on.
  /// @return  clock_backwards: nothing changed; no_sample; at_bound; out_of_order (taken before the one that is held,
  /// or
  ///          after `now`): the sample was not taken over; not_finite: nor was it, or the law refused the one that was
  ///          held, and no axis learned since the last tick
  [[nodiscard]] Status update(Time now, const Held<ToolState<axes, Scalar>>& sample) noexcept {
    if (started_ && now <= now_) return Status::clock_backwards;
    Status status = Status::ok;
    if (sampled_) status |= law_.update(in_seconds<Scalar>(elapsed(now, now_)), held_);
    started_ = true;
    now_ = now;
    if (has(sample.status, Status::no_sample)) return status | when(!sampled_, Status::no_sample);
    if (sampled_ && sample.taken == taken_) return status;
    if (sample.taken > now || (sampled_ && sample.taken < taken_)) return status | Status::out_of_order;
    return status | take(sample);
  }

  /// theta_hat at the last tick.
  [[nodiscard]] Estimate estimate() const noexcept { return {law_.theta(), now_}; }

  [[nodiscard]] const Law& law() const noexcept { return law_; }

 private:
  using Traits = EnvironmentTraits<Env>;

  Status take(const Held<ToolState<axes, Scalar>>& sample) noexcept {
    const auto& [x, v, a, force] = sample.value;
    EnvironmentTheta<Env> phi = Traits::regressor(environment_, x, v);
    EnvironmentVector<Env> F = force - Traits::force(environment_, EnvironmentTheta<Env>::Zero(), x, v);
    typename Law::Held held(phi, F);
    if (!held.is_finite()) return Status::not_finite;
    if constexpr (!Traits::bilateral) {
      for (int axis = 0; axis < axes; ++axis) {
        if (force[axis] > Scalar{0}) continue;
        phi.row(axis).setZero();
        F[axis] = Scalar{0};
      }
      held = typename Law::Held(phi, F);
    }
    held_ = held;
    taken_ = sample.taken;
    sampled_ = true;
    return Status::ok;
  }

  Env environment_;
  Law law_;
  typename Law::Held held_{EnvironmentTheta<Env>::Zero(), EnvironmentVector<Env>::Zero()};  // phi_e,zd and F_e,zd
  bool started_ = false, sampled_ = false;
  Time now_{}, taken_{};
};

}  // namespace limpid
