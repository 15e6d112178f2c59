// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "estimator_scenario.hpp"
#include "excitation.hpp"
#include "trial.hpp"

#include <limpid/prediction/model_predictor.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <vector>

namespace limpid::stress {

/// ModelPredictor of light tools in soft and hard tissues, on a bad line.
template <typename Env, typename Parameters>
class PredictorStress {
 public:
  static std::vector<Choice> choices() {
    return {excitation_choice(),
            clock_choice(),
            line_choice(),
            corruption_choice(),
            {"stiffness", {"800", "0", "1e6"}},
            {"damping", {"30", "0"}},
            {"mass", {"0.1", "0.001"}},
            {"gain", {"0", "of the thesis"}}};
  }

  static Outcome play(const Trial& trial) {
    PredictorStress predictor(trial);
    return play_ticks(trial, predictor.watch_, [&](bool seen, Random& random) { predictor.tick(seen, random); });
  }

 private:
  using Scalar = typename Env::Scalar;
  static constexpr int axes = Env::axes;
  static constexpr double epsilon = double(std::numeric_limits<Scalar>::epsilon());
  using Predictor = ModelPredictor<Env, Tool<axes, Scalar>, Parameters>;
  using State = ToolState<axes, Scalar>;
  using Vector = typename Predictor::Vector;
  using Theta = typename Predictor::Theta;

  explicit PredictorStress(const Trial& trial)
      : excitation_{trial.choices[0]},
        clock_{trial.choices[1]},
        line_{trial.choices[2]},
        corruption_{trial.choices[3]},
        absurd_{trial.choices[3] == 2},
        tool_{.mass = Scalar(trial.choices[6] == 0 ? 0.1 : 0.001), .damping = Scalar(trial.choices[5] == 0 ? 0.1 : 0)},
        theta_{theta(trial)},
        gain_{trial.choices[7] != 0},
        free_{ExcitationKind(trial.choices[0]) == ExcitationKind::absent && !gain_ && !corruption_.any()},
        predictor_(settings()) {}

  static Theta theta(const Trial& trial) {
    constexpr double stiffness[] = {800, 0, 1e6}, damping[] = {30, 0};
    Theta theta = Theta::Constant(Scalar(stiffness[trial.choices[4]]));
    theta.col(Env::parameters - 1).setConstant(Scalar(damping[trial.choices[5]]));
    return theta;
  }

  [[nodiscard]] typename Predictor::Settings settings() const {
    typename Predictor::Settings s{.environment = environment_of<Env>(), .tool = tool_, .theta = theta_};
    if (gain_) s.gain = {Scalar(-195.1), Scalar(-4.89)};
    s.start.x.setConstant(Scalar(0.01));
    return s;
  }

  void tick(bool seen, Random& random) {
    const Time now = clock_.next(random);
    const auto entries = excitation_.next(random);
    Vector F_h;
    State state;
    for (int axis = 0; axis < axes; ++axis) {
      F_h[axis] = corruption_(entries[0], random);
      state.x[axis] = corruption_(Scalar(entries[1] * Scalar(0.01)), random);
      state.v[axis] = corruption_(Scalar(entries[2] * Scalar(0.1)), random);
    }
    const Theta wanted = theta_ * Scalar(random.uniform(0.5, 1.5));
    const Scalar entry = corruption_(wanted(0, 0), random);
    const Stamps stamps = line_.carry(now, std::chrono::milliseconds(16), random);
    const bool sampled = random.chance(0.1) && !stamps.lost;
    if (!seen) return;
    if constexpr (std::same_as<Parameters, Estimated>) {
      Theta estimate = wanted;
      estimate(0, 0) = entry;
      (void)predictor_.use({estimate, now});
    }
    if (sampled) (void)predictor_.observe({state, stamps.taken, stamps.arrived});
    judge(now, F_h);
  }

  void judge(Time now, const Vector& F_h) {
    const auto [motion, status] = predictor_.advance(now, F_h);
    watch_.require("every motion is finite", is_finite(motion));
    const bool refused = (started_ && now <= last_) || !is_finite(Vector((F_h / tool_.mass).square()));
    if (refused) {
      watch_.require("a force that is none, or time that does not advance, changes nothing",
                     (motion.x == motion_.x).all() && (motion.v == motion_.v).all() && (motion.a == motion_.a).all());
      return;
    }
    const double h = started_ ? in_seconds(elapsed(now, last_)) : 0;
    if constexpr (LinearEnvironment<Env> && std::same_as<Parameters, Known>) {
      if (free_ && started_) judge_energy(motion, h);
      if (!gain_ && !absurd_ && is_finite(F_h)) {  // absurd: an answer may be so large that the next one overflows
        const bool huge =
            !(double(F_h.abs().maxCoeff()) < std::sqrt(double(std::numeric_limits<Scalar>::max())) * 1e-9);
        watched_ = watched_ && !huge;
        if (watched_) watch_.require("moderate input makes a moderate answer", !has(status, Status::not_finite));
      }
    }
    motion_ = motion;
    last_ = now;
    started_ = true;
  }

  // m v^2 / 2 + k x^2 / 2 never grows without force. A step rounds its angle, sqrt(k/m) h, and its decay, b/m h.
  void judge_energy(const Motion<axes, Scalar>& motion, double h) {
    const double m = double(tool_.mass);
    for (int axis = 0; axis < axes; ++axis) {
      const double k = double(theta_(axis, 0)), b = double(theta_(axis, 1)) + double(tool_.damping);
      const auto energy = [&](const Motion<axes, Scalar>& at) {
        return (m * double(at.v[axis]) * double(at.v[axis]) + k * double(at.x[axis]) * double(at.x[axis])) / 2;
      };
      const double size = 1 + std::sqrt(k / m) * h + b / m * h, before = energy(motion_);
      if (size * epsilon > 1e-3 || !(before > double(std::numeric_limits<Scalar>::min()) / epsilon)) continue;
      watch_.at_most("growth of energy, roundings", (energy(motion) / before - 1) / (epsilon * size), 64);
    }
  }

  Excitation<3, Scalar> excitation_;
  Clock clock_;
  Line line_;
  Corruption corruption_;
  bool absurd_;
  Tool<axes, Scalar> tool_;
  Theta theta_;
  bool gain_, free_;
  Predictor predictor_;
  Motion<axes, Scalar> motion_ = settings().start;
  bool started_ = false, watched_ = true;
  Time last_{};
  Watch watch_;
};

template <typename Env, typename Parameters>
Scenario predictor_scenario(const std::string& name, double share) {
  using Stress = PredictorStress<Env, Parameters>;
  return {"ModelPredictor<" + name + ">", Stress::choices(), &Stress::play, share};
}

inline std::vector<Scenario> linear_predictor_scenarios() {
  return {predictor_scenario<KelvinVoigt<1>, Known>("KelvinVoigt<1>, Known", 5),
          predictor_scenario<KelvinVoigt<3, float>, Known>("KelvinVoigt<3, float>, Known", 5),
          predictor_scenario<KelvinVoigt<1>, Estimated>("KelvinVoigt<1>, Estimated", 4)};
}

inline std::vector<Scenario> nonlinear_predictor_scenarios() {
  return {predictor_scenario<HuntCrossley<1>, Known>("HuntCrossley<1>, Known", 2),
          predictor_scenario<SmoothBilinear<1, float>, Estimated>("SmoothBilinear<1, float>, Estimated", 2),
          predictor_scenario<Unilateral<KelvinVoigt<1>>, Known>("Unilateral<KelvinVoigt<1>>, Known", 2)};
}

}  // namespace limpid::stress
