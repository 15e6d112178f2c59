// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "estimator_scenario.hpp"
#include "excitation.hpp"
#include "potential.hpp"
#include "trial.hpp"

#include <limpid/prediction/model_predictor.hpp>

#include <algorithm>
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
    if constexpr (requires(Env e) { Env({.exponent = Scalar{}}); }) {
      if (trial.choices[5] == 1) theta.col(1).setZero();  // undamped also in contact
    } else if constexpr (Env::parameters == 3) {
      theta.col(0) /= Scalar(4);  // the soft layer
    }
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
    if constexpr (std::same_as<Parameters, Known> && !LinearEnvironment<Env>) {
      if (free_ && started_) judge_energy_with_tolerance(motion, h);
    }
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

  // m v^2 / 2 + the force's integral, by how much it may grow without force. w of a NonlinearStep is at most q v / h,
  // q = |change of kappa| h^2 + |change of beta| h and v the largest speed that the energy allows. The step takes its
  // impulse to be w h/3; where the force is not smooth it may be anything from 0 to w h: m v times an error of
  // 2/3 q v is 4/3 q of the energy. Where it is smooth the error is of order h^4, and less. A step that is taken
  // has q <= 1/8; an implicit one adds nothing.
  void judge_energy_with_tolerance(const Motion<axes, Scalar>& motion, double h) {
    static_assert(axes == 1);
    const double m = double(tool_.mass);
    const auto potential = [&](double x) { return potential_of(environment_, theta_.transpose(), x); };
    const auto energy = [&](const Motion<axes, Scalar>& at) {
      return m * double(at.v[0]) * double(at.v[0]) / 2 + potential(double(at.x[0])).energy;
    };
    deepest_ = std::max({deepest_, std::abs(double(motion.x[0])), std::abs(double(motion_.x[0]))});
    const double before = energy(motion_), b = double(theta_(0, Env::parameters - 1));
    const double q = std::min(potential(deepest_).stiffness / m * h * h + b / m * h, 0.125);
    const double roundings = 64 * double(std::numeric_limits<Scalar>::epsilon());
    if (!(before > double(std::numeric_limits<Scalar>::min()) / epsilon)) return;
    watch_.at_most("growth of energy beside a changing tangent", energy(motion) / before - 1, 4 * q / 3 + roundings);
  }

  Env environment_ = environment_of<Env>();
  double deepest_ = 0;
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
          predictor_scenario<SmoothBilinear<1>, Known>("SmoothBilinear<1>, Known", 2),
          predictor_scenario<SmoothBilinear<1, float>, Estimated>("SmoothBilinear<1, float>, Estimated", 2),
          predictor_scenario<Unilateral<KelvinVoigt<1>>, Known>("Unilateral<KelvinVoigt<1>>, Known", 2)};
}

}  // namespace limpid::stress
