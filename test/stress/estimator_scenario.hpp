// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "excitation.hpp"
#include "trial.hpp"

#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/estimation/environment_estimator.hpp>

#include <limits>
#include <string>
#include <vector>

namespace limpid::stress {

/// A tissue of any kind.
template <typename Env>
Env environment_of() {
  using Scalar = typename Env::Scalar;
  if constexpr (requires { Env({.depth = Scalar{}, .sharpness = Scalar{}}); }) {
    return Env({.depth = Scalar(0.0028), .sharpness = Scalar(20)});
  } else if constexpr (requires { Env({.exponent = Scalar{}}); }) {
    return Env({.exponent = Scalar(1.3)});
  } else if constexpr (requires { Env({.environment = {}}); }) {
    return Env({.environment = {}});
  } else {
    return Env{};
  }
}

/// EnvironmentEstimator on a bad line.
template <typename Env>
class EstimatorStress {
 public:
  static std::vector<Choice> choices() {
    return {excitation_choice(), clock_choice(), line_choice(), corruption_choice()};
  }

  static Outcome play(const Trial& trial) {
    EstimatorStress estimator(trial);
    return play_ticks(trial, estimator.watch_, [&](bool seen, Random& random) { estimator.tick(seen, random); });
  }

 private:
  using Scalar = typename Env::Scalar;
  using Estimator = EnvironmentEstimator<Env>;
  using Settings = typename Estimator::Law::Settings;
  static constexpr int axes = Env::axes, parameters = Env::parameters;
  using State = ToolState<axes, Scalar>;

  explicit EstimatorStress(const Trial& trial)
      : excitation_{trial.choices[0]},
        clock_{trial.choices[1]},
        line_{trial.choices[2]},
        corruption_{trial.choices[3], 0.01},
        settings_{settings()},
        estimator_({.environment = environment_of<Env>(), .law = settings_}) {}

  static Settings settings() {
    constexpr double lower[] = {100, 5, -55}, upper[] = {3000, 50, 55}, gain[] = {1e9, 8e6, 1e4};
    Settings s;
    for (int j = 0; j < parameters; ++j) {
      s.lower.col(j).setConstant(Scalar(lower[j]));
      s.upper.col(j).setConstant(Scalar(upper[j]));
      s.initial_gain.col(j).setConstant(Scalar(gain[j]));
    }
    s.initial = (s.lower + s.upper) / Scalar(2);
    return s;
  }

  void tick(bool seen, Random& random) {
    const Time now = clock_.next(random);
    const auto entries = excitation_.next(random);
    State state;
    for (int axis = 0; axis < axes; ++axis) {
      state.x[axis] = corruption_(Scalar(entries[0] * Scalar(0.01)), random);
      state.v[axis] = corruption_(Scalar(entries[1] * Scalar(0.1)), random);
      state.force[axis] = corruption_(Scalar(entries[2] * Scalar(10)), random);
    }
    const Stamps stamps = line_.carry(now, std::chrono::milliseconds(16), random);
    const bool none = stamps.lost || !random.chance(0.2);
    if (!none) held_ = {.value = state, .taken = stamps.taken, .arrived = stamps.arrived, .fresh = true};
    if (seen) judge(now);
    held_.fresh = false;
  }

  void judge(Time now) {
    const auto before = estimator_.estimate();
    const Status status = estimator_.update(now, held_);
    const auto theta = estimator_.estimate().theta_hat;
    watch_.require("theta_hat is in its box", (theta >= settings_.lower).all() && (theta <= settings_.upper).all());
    for (int axis = 0; axis < axes; ++axis) {
      const auto [U, D] = estimator_.law().factors(axis);
      watch_.require("Gamma is definite", (D.array() > Scalar{0}).all() && is_finite(U) && is_finite(D));
    }
    const bool late = started_ && now <= last_;
    watch_.require("time that does not advance is refused", late == has(status, Status::clock_backwards));
    if (late) watch_.require("what is refused changes nothing", (theta == before.theta_hat).all());
    if (!late) last_ = now;
    started_ = true;
  }

  Excitation<3, Scalar> excitation_;
  Clock clock_;
  Line line_;
  Corruption corruption_;
  Settings settings_;
  Estimator estimator_;
  Held<State> held_{.status = Status::ok};
  bool started_ = false;
  Time last_{};
  Watch watch_;
};

template <typename Env>
Scenario estimator_scenario(const std::string& name, double share) {
  return {"EnvironmentEstimator<" + name + ">", EstimatorStress<Env>::choices(), &EstimatorStress<Env>::play, share};
}

inline std::vector<Scenario> estimator_scenarios() {
  return {estimator_scenario<KelvinVoigt<3>>("KelvinVoigt<3>", 3),
          estimator_scenario<Tangent<1, float>>("Tangent<1, float>", 3),
          estimator_scenario<Unilateral<KelvinVoigt<1>>>("Unilateral<KelvinVoigt<1>>", 2),
          estimator_scenario<SmoothBilinear<1>>("SmoothBilinear<1>", 2),
          estimator_scenario<HuntCrossley<1, float>>("HuntCrossley<1, float>", 2)};
}

}  // namespace limpid::stress
