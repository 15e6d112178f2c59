// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/disturbance_observer.hpp>

#include <Eigen/Core>

#include <array>

namespace limpid::test {

inline constexpr std::array observer_forms{ObserverForm::tustin, ObserverForm::step_invariant,
                                           ObserverForm::backward_euler};

template <typename Scalar>
Scalar micro(int number) {
  return Scalar(number) / Scalar(1'000'000);
}

template <typename Q, int Axes = 1>
DisturbanceObserver<Q, Axes> observer_of(const QFilterScalar<Q>& cutoff, ObserverForm form = ObserverForm::tustin) {
  using Scalar = QFilterScalar<Q>;
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  return DisturbanceObserver<Q, Axes>({.filter = {.cutoff = cutoff},
                                       .mass = Vector::Constant(micro<Scalar>(10'000)),
                                       .damping = Vector::Constant(micro<Scalar>(22'000)),
                                       .form = form});
}

template <typename Observer>
typename Observer::Output tick(Observer& observer, Time now, const typename Observer::Vector& command,
                               const typename Observer::Vector& hand, const typename Observer::Vector& velocity,
                               const typename Observer::Vector& applied) {
  return observer.update(now, command, typename Observer::OperatorForce(hand), velocity,
                         typename Observer::AppliedForce(applied));
}

}  // namespace limpid::test
