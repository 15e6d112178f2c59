// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "excitation.hpp"
#include "trial.hpp"

#include <limpid/control/disturbance_observer.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace limpid::stress {

/// DisturbanceObserver around its nominal plant, three axes.
template <typename Q>
class ObserverStress {
 public:
  static std::vector<Choice> choices() {
    return {clock_choice(),
            excitation_choice(),
            corruption_choice(),
            {"form", {"tustin", "step invariant", "backward Euler"}},
            {"device", {"0.1 kg", "1 g"}},
            {"saturation", {"none", "1 N"}}};
  }

  static Outcome play(const Trial& trial) {
    ObserverStress observer(trial);
    return play_ticks(trial, observer.watch_, [&](bool seen, Random& random) { observer.tick(seen, random); });
  }

 private:
  using Scalar = typename Q::Scalar;
  using Observer = DisturbanceObserver<Q, 3>;
  using Vector = typename Observer::Vector;

  explicit ObserverStress(const Trial& trial)
      : clock_{trial.choices[0]},
        excitation_{trial.choices[1]},
        corruption_{trial.choices[2]},
        mass_{Scalar(trial.choices[4] == 0 ? 0.1 : 0.001)},
        saturated_{trial.choices[5] == 1},
        settled_{trial.choices[0] == 0 && trial.choices[2] == 0 && !saturated_ &&
                 ExcitationKind(trial.choices[1]) == ExcitationKind::absent},
        observer_({.filter = {.cutoff = Scalar(50)},
                   .mass = Vector::Constant(mass_),
                   .damping = Vector::Constant(damping()),
                   .form = ObserverForm(trial.choices[3])}) {}

  static Scalar damping() { return Scalar(0.1); }

  void tick(bool seen, Random& random) {
    const Time now = clock_.next(random);
    const auto entries = excitation_.next(random);
    if (count_++ % 1000 == 0) disturbance_.setConstant(Scalar(random.uniform(-1, 1)));
    Vector command, hand, velocity = velocity_;
    for (int axis = 0; axis < 3; ++axis) {
      command[axis] = corruption_(entries[0], random);
      hand[axis] = corruption_(entries[1], random);
      velocity[axis] = corruption_(velocity[axis], random);
    }
    if (seen) judge(now, command, hand, velocity);
  }

  void judge(Time now, const Vector& command, const Vector& hand, const Vector& velocity) {
    using OperatorForce = typename Observer::OperatorForce;
    using AppliedForce = typename Observer::AppliedForce;
    const auto out = observer_.update(now, command, OperatorForce(hand), velocity, AppliedForce(applied_));
    watch_.require("force and disturbance are finite", is_finite(out.force) && is_finite(out.disturbance));
    if (has(out.status, Status::not_finite | Status::clock_backwards)) {
      watch_.require("what is refused leaves the estimate", (out.disturbance == disturbance_hat_).all());
    }
    disturbance_hat_ = out.disturbance;
    if (settled_ && count_ % 1000 == 0) {  // a second after the last change: e^-300 of it is left
      const Scalar error = (out.disturbance + disturbance_).abs().maxCoeff();
      watch_.at_most("error of a constant disturbance, N", double(error), 1e-3);
    }
    applied_ = saturated_ ? Vector(out.force.max(Scalar(-1)).min(Scalar(1))) : out.force;
    move(now, hand);
  }

  // The nominal plant, exactly over the tick with its forces held; it ends at 10 m/s.
  void move(Time now, const Vector& hand) {
    const Scalar h = in_seconds<Scalar>(std::clamp(elapsed(now, last_), Duration::zero(), Duration{50'000'000}));
    const Scalar decay = std::exp(-h * damping() / mass_);
    const Vector steady = (applied_ + hand + disturbance_) / damping();
    const Vector next = decay * velocity_ + (1 - decay) * steady;
    velocity_ = is_finite(next) ? Vector(next.max(Scalar(-10)).min(Scalar(10))) : Vector(Vector::Zero());
    last_ = now;
  }

  Clock clock_;
  Excitation<2, Scalar> excitation_;
  Corruption corruption_;
  Scalar mass_;
  bool saturated_, settled_;
  Observer observer_;
  Vector disturbance_ = Vector::Zero(), disturbance_hat_ = Vector::Zero(), applied_ = Vector::Zero();
  Vector velocity_ = Vector::Zero();
  Time last_{};
  std::uint64_t count_ = 0;
  Watch watch_;
};

template <typename Q>
Scenario observer_scenario(const std::string& name, double share) {
  return {"DisturbanceObserver<" + name + ">", ObserverStress<Q>::choices(), &ObserverStress<Q>::play, share};
}

inline std::vector<Scenario> observer_scenarios() {
  return {observer_scenario<FirstOrderQ<double>>("FirstOrderQ<double>", 3),
          observer_scenario<ButterworthQ<float>>("ButterworthQ<float>", 3),
          observer_scenario<UmenoHoriQ<double>>("UmenoHoriQ<double>", 3)};
}

}  // namespace limpid::stress
