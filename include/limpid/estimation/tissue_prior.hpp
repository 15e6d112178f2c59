// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/estimation/tissue_belief.hpp>
#include <limpid/estimation/tissue_learner_settings.hpp>

namespace limpid {

/// What a TissueLearner believes of a law before it has seen anything: it is straight, of unknown slope and damping.
/// @param belief  zero
/// @param x       where the law has no force, about, m
/// @param offset  deviation of the force there, N
/// @realtime      no allocation, no throw for built-in scalars
template <typename Law>
void set_prior(TissueBelief<Law>& belief, const TissueLearnerSettings<Law>& settings, const typename Law::Scalar& x,
               const typename Law::Scalar& offset) noexcept {
  using Scalar = typename Law::Scalar;
  const auto square = [](const Scalar& value) { return value * value; };
  if (settings.relaxation) {
    for (int i = 0; i < Law::branches; ++i) {
      belief.P(Law::first_branch + i, Law::first_branch + i) = square(settings.branch_deviation);
    }
  }
  if (settings.dry_friction) belief.P(Law::friction, Law::friction) = square(settings.friction_deviation);
  for (int j = belief.law.dampers().low; j <= belief.law.dampers().high; ++j) {
    belief.s[Law::damper(j)] = settings.damping;
    for (int i = belief.law.dampers().low; i <= belief.law.dampers().high; ++i) {
      belief.P(Law::damper(i), Law::damper(j)) =
          square(settings.damping_deviation) + (i == j ? square(settings.damping_change) / Scalar(100) : Scalar{0});
    }
  }
  const auto& knots = belief.law.knots();
  const auto away = [&](int j) { return Scalar(j) * knots.spacing() - x; };
  for (int j = knots.low(); j <= knots.high(); ++j) {
    belief.s[Law::coefficient(j)] = settings.slope * away(j);
    for (int i = knots.low(); i <= knots.high(); ++i) {
      belief.P(Law::coefficient(i), Law::coefficient(j)) = square(offset) +
                                                           away(i) * away(j) * square(settings.slope_deviation) +
                                                           (i == j ? belief.bend_variance() / Scalar(10) : Scalar{0});
    }
  }
}

}  // namespace limpid
