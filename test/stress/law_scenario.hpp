// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "excitation.hpp"
#include "law_metric.hpp"
#include "trial.hpp"

#include <limpid/estimation/projection_rls.hpp>
#include <limpid/estimation/symmetric_eigenvalues.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace limpid::stress {

/// ProjectionRLS under any regressor, clock and setting.
template <int N, int Axes, typename Scalar>
class LawStress {
 public:
  static constexpr int axes = Axes;

  static std::vector<Choice> choices() {
    return {excitation_choice(),
            clock_choice(),
            {"gain", {"of the thesis", "1e-3", "1e10", "1e10 beside 1e-3"}},
            {"forgetting", {"2", "0", "20"}},
            {"nu", {"0.01", "0", "0.04"}},
            {"truth", {"inside", "a corner", "outside"}},
            corruption_choice(),
            {"box", {"of the thesis", "a point in the first", "wide"}}};
  }

  static Outcome play(const Trial& trial) {
    LawStress law(trial);
    return play_ticks(trial, law.watch_, [&](bool seen, Random& random) { law.tick(seen, random); });
  }

 private:
  using Law = ProjectionRLS<N, Axes, Scalar>;
  using Settings = typename Law::Settings;
  using Theta = typename Law::Theta;
  using Metric = LawMetric<N>;
  using Column = typename Metric::Column;
  static constexpr double epsilon = double(std::numeric_limits<Scalar>::epsilon());

  explicit LawStress(const Trial& trial)
      : huge_{ExcitationKind(trial.choices[0]) == ExcitationKind::huge},
        clock_{trial.choices[1]},
        corruption_{trial.choices[6]},
        settings_{settings(trial)},
        law_{settings_} {
    for (int axis = 0; axis < Axes; ++axis) {
      excitations_.emplace_back(trial.choices[0]);
      for (int j = 0; j < N; ++j) {
        const Scalar low = settings_.lower(axis, j), high = settings_.upper(axis, j), width = high - low;
        theta_(axis, j) = trial.choices[5] == 0 ? Scalar(low + width * Scalar(0.375)) : high;
        if (trial.choices[5] == 2) theta_(axis, j) += width + Scalar(1);
      }
    }
    judged_ = trial.choices[5] != 2 && !huge_;
  }

  static Settings settings(const Trial& trial) {
    constexpr double lower[] = {200, 20, -55}, upper[] = {2000, 40, 0}, gain[] = {1e9, 8e6, 1e4};
    constexpr double forgetting[] = {2, 0, 20}, nu[] = {0.01, 0, 0.04};
    Settings s;
    for (int j = 0; j < N; ++j) {
      s.lower.col(j).setConstant(Scalar(lower[j]));
      s.upper.col(j).setConstant(Scalar(upper[j]));
      s.initial_gain.col(j).setConstant(Scalar(gain[j]));
    }
    if (trial.choices[7] == 1) s.lower.col(0) = s.upper.col(0);
    if (trial.choices[7] == 2) {
      s.lower.setConstant(Scalar(-1e6));
      s.upper.setConstant(Scalar(1e6));
    }
    if (trial.choices[2] > 0) s.initial_gain.setConstant(Scalar(trial.choices[2] == 1 ? 1e-3 : 1e10));
    if (trial.choices[2] == 3) s.initial_gain.col(N - 1).setConstant(Scalar(1e-3));
    s.gain_limit = std::max(s.gain_limit, s.initial_gain.maxCoeff());
    s.initial = (s.lower + s.upper) / Scalar(2);
    s.forgetting = Scalar(forgetting[trial.choices[3]]);
    s.normalisation = Scalar(nu[trial.choices[4]]);
    return s;
  }

  void tick(bool seen, Random& random) {
    Scalar dt = Scalar(clock_.length(random));
    typename Law::Regressor phi;
    typename Law::Vector F;
    for (int axis = 0; axis < Axes; ++axis) {
      const auto row = excitations_[std::size_t(axis)].next(random);
      long double force = 0;
      for (int j = 0; j < N; ++j) {
        phi(axis, j) = row[std::size_t(j)];
        force += static_cast<long double>(phi(axis, j)) * static_cast<long double>(theta_(axis, j));
      }
      F[axis] = Scalar(force);
    }
    const typename Law::Vector true_force = F;
    dt = corruption_(dt, random);
    F[0] = corruption_(F[0], random);
    phi(0, 0) = corruption_(phi(0, 0), random);
    if (seen) judge(dt, phi, F, judged_ && !corruption_.any() && is_finite(true_force));
  }

  void judge(const Scalar& dt, const typename Law::Regressor& phi, const typename Law::Vector& F, bool true_force) {
    const Law before = law_;
    const Status status = law_.update(dt, phi, F);
    const bool finite = is_finite(dt) && is_finite(phi) && is_finite(F);
    const bool refused = has(status, Status::not_finite | Status::clock_backwards);
    watch_.require("an input that is not finite, or no time, is refused", refused || (finite && dt > Scalar{0}));
    const Theta theta = law_.theta();
    watch_.require("theta_hat is in its box", (theta >= settings_.lower).all() && (theta <= settings_.upper).all());
    for (int axis = 0; axis < Axes; ++axis) judge_gain(before, axis, refused);
    if (refused) watch_.require("what is refused changes nothing", (theta == before.theta()).all());
    const int axis = int(ticks_ % Axes);
    if (!refused && true_force) judge_lyapunov(before, phi, dt, axis);
    if (++ticks_ % 64 == 0) judge_eigenvalues();
  }

  // U D U' with a unit triangle is definite exactly where D > 0.
  void judge_gain(const Law& before, int axis, bool refused) {
    const auto [U, D] = law_.factors(axis);
    watch_.require("Gamma is definite", (D.array() > Scalar{0}).all() && is_finite(U) && is_finite(D));
    if (!refused) return;
    const auto old = before.factors(axis);
    watch_.require("what is refused changes nothing", old.U == U && old.D == D);
  }

  // By Eigen, in more digits than the law's own scalar: of the factors, which are what the law keeps.
  void judge_eigenvalues() {
    using Wide = Eigen::Matrix<long double, N, N>;
    for (int axis = 0; axis < Axes; ++axis) {
      watch_.require("Gamma is finite", is_finite(law_.gain(axis)));
      const auto [U, D] = law_.factors(axis);
      const Wide wide_U = U.template cast<long double>();
      const Wide Gamma = wide_U * D.template cast<long double>().asDiagonal() * wide_U.transpose();
      const Eigen::SelfAdjointEigenSolver<Wide> solver(Gamma, Eigen::EigenvaluesOnly);
      watch_.require("Gamma has eigenvalues", solver.info() == Eigen::Success);
      const long double excess = solver.eigenvalues().maxCoeff() / static_cast<long double>(settings_.gain_limit) - 1;
      watch_.at_most("lambda_max(Gamma) over rho_M, roundings", double(excess) / epsilon, 16);  // of one step
    }
  }

  // V = theta_tilde' Gamma^-1 theta_tilde never grows where F = phi' theta: Lemma 3. Beyond it comes what roundings
  // make of theta_hat, U and the force, each a few units in its last place.
  void judge_lyapunov(const Law& law, const typename Law::Regressor& phi, const Scalar& dt, int axis) {
    const Metric old_metric(law.factors(axis)), metric(law_.factors(axis));
    Column old_error, error, sizes;
    long double forces = std::numeric_limits<Scalar>::denorm_min();
    for (int j = 0; j < N; ++j) {
      const auto k = std::size_t(j);
      const long double truth = theta_(axis, j), now = law_.theta()(axis, j), old = law.theta()(axis, j);
      old_error[k] = old - truth;
      error[k] = now - truth;
      sizes[k] = std::abs(now) + std::abs(old) + std::abs(truth);
      forces += std::abs(static_cast<long double>(phi(axis, j))) * sizes[k];
    }
    const long double old_V = old_metric.norm(old_error), V = metric.norm(error);
    const long double gathered = std::expm1(settings_.forgetting * dt);
    const long double seconds = settings_.forgetting > Scalar{0} ? gathered / settings_.forgetting : gathered + dt;
    const long double rounding =
        epsilon * (metric.bound(sizes) + old_metric.bound(sizes) + std::sqrt(seconds) * forces);
    watch_.at_most("growth of V^(1/2), roundings", double((V - old_V) / rounding), 64);
  }

  bool huge_;  // a rounding of the force alone may then take an estimate across the box
  Clock clock_;
  Corruption corruption_;
  Settings settings_;
  Law law_;
  std::vector<Excitation<N, Scalar>> excitations_;
  Theta theta_;  // the truth
  bool judged_ = false;
  std::uint64_t ticks_ = 0;
  Watch watch_;
};

template <int N, int Axes, typename Scalar>
Scenario law_scenario(const std::string& name, double share) {
  return {name, LawStress<N, Axes, Scalar>::choices(), &LawStress<N, Axes, Scalar>::play, share};
}

inline std::vector<Scenario> law_scenarios() {
  return {law_scenario<2, 3, double>("ProjectionRLS<2, 3, double>", 10),
          law_scenario<3, 1, double>("ProjectionRLS<3, 1, double>", 5),
          law_scenario<2, 3, float>("ProjectionRLS<2, 3, float>", 10),
          law_scenario<3, 3, float>("ProjectionRLS<3, 3, float>", 10)};
}

}  // namespace limpid::stress
