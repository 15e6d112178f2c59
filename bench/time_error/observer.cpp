// SPDX-License-Identifier: MIT
// The disturbance observer of three axes in its forms, against Fig. 1 in continuous time; ticks of 1 ms, Q of 50 Hz.
#include "time_error/method.hpp"

#include <limpid/control/disturbance_observer.hpp>

#include <chrono>
#include <cstddef>
#include <utility>

namespace limpid::bench {

namespace {

constexpr int axes = 3;
constexpr std::size_t ticks = 500;
constexpr float mass = 0.125F, damping = 0.0625F, cutoff = 50;

/// v = (1 - cos(12 t))/16 m/s, a command of 2 sin(30 t) N, and a hand that leaves e = sin(40 t) N of
///
///     e = command + hand - m v' - b v
///
/// for the disturbance that is to be found; the axes are scaled.
struct Numbers {
  std::vector<float> v, command, hand;
};

Fifty scale_of(int axis) { return Fifty(1) / (1 << axis); }

Fifty instant(std::size_t tick) { return Fifty(static_cast<long>(tick)) / 1000; }

const Numbers& numbers_of(int axis) {
  static const std::vector<Numbers> all = [] {
    std::vector<Numbers> made(axes);
    for (int i = 0; i < axes; ++i) {
      for (std::size_t tick = 0; tick < ticks; ++tick) {
        const Fifty t = instant(tick), scale = scale_of(i);
        const Fifty v = scale * (1 - cos(Fifty(12 * t))) / 16, a = scale * sin(Fifty(12 * t)) * 12 / 16;
        const Fifty command = 2 * scale * sin(Fifty(30 * t)), e = scale * sin(Fifty(40 * t));
        Numbers& numbers = made[static_cast<std::size_t>(i)];
        numbers.v.push_back(static_cast<float>(v));
        numbers.command.push_back(static_cast<float>(command));
        numbers.hand.push_back(static_cast<float>(mass * a + damping * v + e - command));
      }
    }
    return made;
  }();
  return all[static_cast<std::size_t>(axis)];
}

/// d_hat of tau d_hat' = e, for Q of first order.
Fifty first_order(const Fifty& tau, const Fifty& t) { return (1 - cos(Fifty(40 * t))) / (40 * tau); }

/// d_hat of tau^2 d_hat'' + sqrt(2) tau d_hat' = e, for Butterworth's Q.
Fifty butterworth(const Fifty& tau, const Fifty& t) {
  const Fifty w = 40, a = sqrt(Fifty(2)) / tau, wt = w * t;
  const Fifty rest = (w / a) * (1 - exp(Fifty(-a * t)));
  return (a * (1 - cos(wt)) / w - sin(wt) + rest) / (tau * tau * (a * a + w * w));
}

template <typename Solution>
Signals exact_solution(Solution solution) {
  const Fifty tau = time_constant_of(Fifty(cutoff));
  Signals signals(axes);
  for (int axis = 0; axis < axes; ++axis) {
    for (std::size_t i = 0; i < ticks; ++i) {
      signals[static_cast<std::size_t>(axis)].push_back(scale_of(axis) * solution(tau, instant(i)));
    }
  }
  return signals;
}

template <template <typename> class Q, typename Scalar>
class Runner {
 public:
  using Observer = DisturbanceObserver<Q<Scalar>, axes>;
  using Vector = typename Observer::Vector;

  explicit Runner(ObserverForm form) : form_{form}, observer_{start()}, v_(ticks), command_(ticks), hand_(ticks) {
    for (int axis = 0; axis < axes; ++axis) {
      const Numbers& numbers = numbers_of(axis);
      for (std::size_t i = 0; i < ticks; ++i) {
        v_[i][axis] = Scalar(numbers.v[i]);
        command_[i][axis] = Scalar(numbers.command[i]);
        hand_[i][axis] = Scalar(numbers.hand[i]);
      }
    }
  }

  Signals trajectory() {
    Signals signals;
    for (std::size_t i = 0; i < ticks; ++i) append(signals, tick(i).disturbance);
    return signals;
  }

  // Flat, or a source of this size meets the compiler's limits of inlining and measures those.
  [[gnu::flatten]] void run(long count) {
    for (; count > 0; --count) {
      benchmark::DoNotOptimize(tick(at_));
      if (++at_ < ticks) continue;
      at_ = 0;
      observer_ = start();
    }
  }

 private:
  [[gnu::noinline]] Observer start() const {
    return Observer({.filter = {Scalar(cutoff)},
                     .mass = Vector::Constant(Scalar(mass)),
                     .damping = Vector::Constant(Scalar(damping)),
                     .form = form_});
  }

  typename Observer::Output tick(std::size_t i) {
    const auto output =
        observer_.update(static_cast<Time::rep>(i) * std::chrono::milliseconds{1}, command_[i],
                         typename Observer::OperatorForce(hand_[i]), v_[i], typename Observer::AppliedForce(applied_));
    applied_ = output.force;
    return output;
  }

  ObserverForm form_;
  Observer observer_;
  std::vector<Vector> v_, command_, hand_;
  Vector applied_ = Vector::Zero();
  std::size_t at_ = 0;
};

template <template <typename> class Q>
std::vector<Method> methods(const Signals& exact) {
  std::vector<Method> methods;
  for (const auto& [name, form] :
       {std::pair{"Tustin", ObserverForm::tustin}, std::pair{"step-invariant", ObserverForm::step_invariant},
        std::pair{"implicit Euler", ObserverForm::backward_euler}}) {
    const ObserverForm of_method = form;
    add(methods, name, form == ObserverForm::tustin, exact,
        [=]<typename Scalar>(std::type_identity<Scalar>) { return Runner<Q, Scalar>(of_method); });
  }
  return methods;
}

}  // namespace

std::vector<Case> observer_cases() {
  return {{"observer", "Q of first order", [] { return methods<FirstOrderQ>(exact_solution(first_order)); }},
          {"observer", "Butterworth's Q", [] { return methods<ButterworthQ>(exact_solution(butterworth)); }}};
}

}  // namespace limpid::bench
