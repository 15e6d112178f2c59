// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/cholesky_3.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/time.hpp>
#include <limpid/estimation/contact_edge.hpp>
#include <limpid/estimation/sample_noise.hpp>
#include <limpid/estimation/scale_change.hpp>
#include <limpid/estimation/tissue_belief.hpp>
#include <limpid/estimation/tissue_law.hpp>
#include <limpid/estimation/tissue_learner_settings.hpp>
#include <limpid/estimation/tissue_prior.hpp>
#include <limpid/estimation/tissue_replay.hpp>
#include <limpid/signal/history.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace limpid {

/// Learns the whole force law of a tissue along one axis from samples of the tool and the known force of the operator.
///
/// Two samples and the operator's force between them hold the tissue's impulse: the tool is replayed from the one to
/// the other with the law as it is known, and an iterated Kalman filter takes what is missing at the end, in x, v and
/// F_e, as the error of the law, of the state at the start, and of the measurements. Each iteration is a Gauss-Newton
/// step on
///
///     (s - s0)' P^-1 (s - s0) + (z - h(s))' W^-1 (z - h(s)),
///
/// damped where the misfit is large, halved until it falls; slopes and dampings stay physical by the nearest point in
/// the metric of what is still open. How noisy the signals are is learnt, and whether the tissue has changed as a
/// whole. Where `contact` is set samples that feel nothing show that the tissue begins at an edge (ContactEdge); then
/// the law has one, and is learnt anew from the first force on. See TissueLaw for the law.
/// @tparam Law       TissueLaw
/// @tparam Capacity  ticks between two samples at most; where there are more, learning starts again from the sample
/// @realtime         no allocation, no throw for built-in scalars. All at the sample: a replay for each iteration, 700
///                   flops a tick and up to 6 states^2; 6 states^2 once
template <typename Law = TissueLaw<>, std::size_t Capacity = 512>
class TissueLearner {
 public:
  using Scalar = typename Law::Scalar;
  using State = typename Law::State;
  using Point = typename Law::Point;
  static constexpr int states = Law::states;

  using Settings = TissueLearnerSettings<Law>;

  /// @throws std::invalid_argument  where a field is refused
  explicit TissueLearner(const Settings& settings)
      : settings_{settings},
        belief_({.curvature = settings.curvature,
                 .damping_change = settings.damping_change,
                 .most_slope = settings.most_slope,
                 .most_damping = settings.most_damping},
                Law(settings.law(), Scalar{0})),
        noise_(settings.process_deviation) {
    settings.check();
  }

  [[nodiscard]] const Law& law() const noexcept { return belief_.law; }
  [[nodiscard]] Law& law() noexcept { return belief_.law; }
  [[nodiscard]] const State& state() const noexcept { return belief_.s; }
  [[nodiscard]] bool started() const noexcept { return started_; }

  /// Where the newest sample was, as far as is known: measured and filtered.
  [[nodiscard]] Point newest() const noexcept {
    return {belief_.s[Law::position], belief_.s[Law::velocity], belief_.s[Law::residual], memory_};
  }
  [[nodiscard]] Time taken() const noexcept { return taken_; }

  /// Whether nothing is known by which to predict: no sample yet; a free tool has felt nothing; no law near the one
  /// that is known explains the last sample; or the last few came too far apart to be replayed.
  [[nodiscard]] bool lost() const noexcept { return !touched_ || unexplained_; }

  /// Takes in a sample, newer than the one before.
  /// @param forces  operator's force, N, at least from the sample before to this one; linear between its entries
  template <std::size_t N>
  void learn(const AxisSample<Scalar>& sample, const History<Scalar, N>& forces) noexcept {
    pushes_ = settings_.contact && edge_.feel(sample, softest());
    if (!started_ || edge_.exists() != law().contact()) return start(sample);
    if (pushes_ && !touched_) return touch(sample);
    gaps_ = replay_.find_steps(law(), forces, taken_, sample.taken) ? 0 : std::min(gaps_ + 1, most_gaps + 1);
    if (gaps_ > 0) {
      unexplained_ = gaps_ > most_gaps;
      return restart(sample);
    }
    const bool near = replay_.walk(law(), belief_.s, memory_, sample);
    cover(sample);
    replay_.compare(law(), belief_.s, sample, pushes_, here_);
    unexplained_ = !near || !replay_.linearise(law(), belief_.s, sample, pushes_, here_);
    if (unexplained_) return miss(sample);
    weigh(sample);
    iterate(sample);
    const Scalar left = Cholesky3<Scalar>(W_).whitened(here_.y).squaredNorm();
    unexplained_ = left > Scalar(useless);
    if (law().contact() && left > doubtful) return miss(sample);
    misses_ = unexplained_ ? misses_ + 1 : 0;
    if (misses_ > most_misses) return start(sample);
    take_in();
    carry_forward(sample);
  }

 private:
  // Misfits that are left, squares over three variances. The first is that of a law with an edge, which is met where
  // nothing is linear, that is not believed; the second that of any law that is not used until it explains a sample.
  static constexpr int doubtful = 100, useless = 10'000;
  static constexpr int most_misses = 10, most_misses_of_contact = 2;  // in a row, before learning starts anew
  static constexpr int most_gaps = 2;                                 // in a row, with the law as it was

  using Scalar3 = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
  using Replay = TissueReplay<Law, Capacity>;
  using Rows = typename Replay::Rows;
  using Evaluation = typename Replay::Evaluation;

  // The prior about the first sample: a straight law of unknown slope and damping; where there is an edge, none yet.
  void start(const AxisSample<Scalar>& z) noexcept {
    belief_.forget(Law(settings_.law(), z.x));
    touched_ = !edge_.exists();
    started_ = true;
    unexplained_ = false;
    misses_ = 0;
    if (touched_) {
      set_prior(belief_, settings_, z.x, Scalar{1});
    } else {
      law().detach(belief_.s);
    }
    restart(z, noise_.force_variance());
  }

  // What is believed of a law that begins at an edge, from the first sample with force on.
  void touch(const AxisSample<Scalar>& z) noexcept {
    const auto [at, deviation] = edge_.guess(z, settings_.slope, settings_.damping);
    belief_.forget(Law(settings_.law(), at));
    law().begin_at_edge();
    set_prior(belief_, settings_, at, settings_.slope * deviation);
    edge_.begin_at(z.x);
    touched_ = true;
    unexplained_ = false;
    misses_ = 0;
    restart(z);
  }

  // No law near the one that is known explains the sample. In flight that says nothing of a law with an edge.
  void miss(const AxisSample<Scalar>& z) noexcept {
    if (!law().contact() || pushes_) ++misses_;
    if (law().contact() && misses_ > most_misses_of_contact) return touch(z);
    if (misses_ > most_misses) return start(z);
    restart(z);
  }

  // What could be taken for one.
  [[nodiscard]] typename ContactEdge<Scalar>::Tissue softest() const noexcept {
    return {settings_.least_slope, settings_.damping + Scalar{3} * settings_.damping_deviation};
  }

  // Learning cannot go on from the sample before: the law stays, the state is the sample's.
  void restart(const AxisSample<Scalar>& z) noexcept {
    restart(z, noise_.force_variance() + Scalar(1) / Scalar(10000));
  }
  void restart(const AxisSample<Scalar>& z, const Scalar& force_variance) noexcept {
    memory_ = {};
    belief_.P.template topRows<3>().setZero();
    belief_.P.template leftCols<3>().setZero();
    place(z);
    take_force(z, force_variance);
  }

  void place(const AxisSample<Scalar>& z) noexcept {
    belief_.s[Law::position] = z.x;
    belief_.s[Law::velocity] = z.v;
    belief_.s[Law::residual] = Scalar{0};
    belief_.P(Law::position, Law::position) = noise_.x_variance();
    belief_.P(Law::velocity, Law::velocity) = noise_.v_variance();
    belief_.P(Law::residual, Law::residual) = settings_.residual_deviation * settings_.residual_deviation;
    taken_ = z.taken;
    law().visit(z.x);
  }

  // F_e alone, at the sample's x and v.
  void take_force(const AxisSample<Scalar>& z, const Scalar& variance) noexcept {
    Evaluation& e = here_;
    if (!touched_ || !(pushes_ || law().pressed(belief_.s, {z.x, z.v, Scalar{0}, memory_}))) return;
    e.H.setZero();
    Replay::Adjoint::add(law(), e.H, {z.x, z.v, Scalar{0}, memory_},
                         typename Replay::Adjoint::Three(Scalar{0}, Scalar{0}, Scalar{1}));
    e.H(Law::residual, 2) = Scalar{1};
    const State gain = belief_.P * e.H.col(2);
    const Scalar whole = e.H.col(2).dot(gain) + variance;
    belief_.s += gain * ((z.force - law().pressed_force(belief_.s, {z.x, z.v, Scalar{0}, memory_})) / whole);
    belief_.add_rank_one(gain, Scalar{-1} / whole);
    State u = State::Zero();
    belief_.keep_physical(belief_.s, u);
  }

  // The law's range holds the sample and, as it is known now, the way to it.
  void cover(const AxisSample<Scalar>& z) noexcept {
    if (!touched_) return;
    auto [low, high] = replay_.range(z.x, Scalar(2) / Scalar(1000));
    if (law().contact()) {
      low = std::max(low, edge_.pressed_from());
      high = std::max(low, high);
    }
    belief_.extend(low - law().knots().spacing(), high + law().knots().spacing());
  }

  // The weights of the measurements, before the first iteration: noises, a change of the whole, an outlier of F_e.
  void weigh(const AxisSample<Scalar>& z) noexcept {
    belief_.project_rows(here_.H, PH_);
    Matrix3 S = here_.H.transpose() * PH_;
    noise_.observe(here_.y, S, gains());
    W_ = noise_.weights(gains());
    if (settings_.scale_changes) change_scale(S, in_seconds<Scalar>(elapsed(z.taken, taken_)));
    const Scalar expected = S(2, 2) + W_(2, 2), distance = here_.y[2] * here_.y[2] / expected;
    if (distance > Scalar(9)) W_(2, 2) = expected * distance / Scalar(9) - S(2, 2);
  }

  [[nodiscard]] typename SampleNoise<Scalar>::Gains gains() const noexcept { return {here_.x_gain, here_.v_gain}; }

  void change_scale(Matrix3& S, const Scalar& T) noexcept {
    State whole = belief_.s;
    whole.template head<Law::first_branch>().setZero();
    whole.template segment<Law::most_dampers>(Law::first_damper).setZero();
    const Scalar3 effect = here_.H.transpose() * whole;
    const Scalar variance = scale_.variance(S + W_, here_.y, effect, T);
    if (!(variance > Scalar{0})) return;
    belief_.add_rank_one(whole, variance);
    PH_ += whole * (variance * effect).transpose();
    S += effect * (variance * effect).transpose();
  }

  // Gauss-Newton from the prior belief_.s to si_, in here_; u with si = s + P u gives the prior's cost without P^-1.
  void iterate(const AxisSample<Scalar>& z) noexcept {
    si_ = belief_.s;
    u_.setZero();
    bool linear = false;
    for (int i = 0; i < settings_.iterations && !linear; ++i) {
      if (i > 0) belief_.project_rows(here_.H, PH_);
      const Matrix3 W = damped();
      const Cholesky3<Scalar> weight(W), factor(here_.H.transpose() * PH_ + W);
      const Scalar3 g = factor.solve(here_.y - here_.H.transpose() * (belief_.s - si_));
      State u = here_.H * g, target = belief_.s + PH_ * g;
      belief_.keep_physical(target, u, {here_.H, PH_, factor});
      const Scalar before = cost(weight, u_, si_, here_.y);
      Scalar now = before;
      linear = W == W_;  // a damped step does not lead where the misfit is least
      if (!approach(z, weight, u, target, now, linear)) break;
      if (before - now < before / Scalar(10000) + Scalar(1) / Scalar(1'000'000)) break;
    }
  }

  // W, and where the misfit is far beyond it half the misfit: a step that asks for no more than that of a law that is
  // far off does not leave the range in which it is nearly linear.
  [[nodiscard]] Matrix3 damped() const noexcept {
    Matrix3 W = W_;
    for (int k = 0; k < 3; ++k) {
      W(k, k) += std::max(here_.y[k] * here_.y[k] - Scalar(9) * W_(k, k), Scalar{0}) / Scalar(4);
    }
    return W;
  }

  [[nodiscard]] Scalar cost(const Cholesky3<Scalar>& weight, const State& u, const State& at,
                            const Scalar3& y) const noexcept {
    return u.dot(at - belief_.s) + weight.whitened(y).squaredNorm();
  }

  // From si_ toward the target, halved until the cost falls. Where the misfit there is the linear one, to a tenth of
  // its deviation, the derivatives stay, and the target is where a next step would lead.
  [[nodiscard]] bool approach(const AxisSample<Scalar>& z, const Cholesky3<Scalar>& weight, const State& u,
                              const State& target, Scalar& now, bool& linear) noexcept {
    Scalar part{1};
    for (int half = 0; half < 6; ++half, part /= Scalar{2}) {
      const State trial_u = u_ + part * (u - u_), trial = si_ + part * (target - si_);
      if (!replay_.walk(law(), trial, memory_, z)) continue;
      replay_.compare(law(), trial, z, pushes_, there_);
      const Scalar then = cost(weight, trial_u, trial, there_.y);
      if (!(then <= now)) continue;
      const Scalar3 bent = there_.y - here_.y + here_.H.transpose() * (trial - si_);
      linear = linear && half == 0 && weight.whitened(bent).squaredNorm() < Scalar(1) / Scalar(100);
      if (linear) {
        here_.y = there_.y;
        here_.end = there_.end;
      } else if (replay_.linearise(law(), trial, z, pushes_, there_)) {
        std::swap(here_, there_);
      } else {
        continue;
      }
      si_ = trial;
      u_ = trial_u;
      now = then;
      return true;
    }
    return false;
  }

  // P less what the measurements tell, about si_.
  void take_in() noexcept {
    belief_.project_rows(here_.H, PH_);
    const Matrix3 S = here_.H.transpose() * PH_ + W_;
    const Cholesky3<Scalar> factor(S);
    missing_ = factor.solve(here_.y - here_.H.transpose() * (belief_.s - si_));
    Matrix3 kept;  // S^-1 W: what of P H is left
    for (int k = 0; k < 3; ++k) kept.col(k) = factor.solve(W_.col(k));
    const Matrix3& G = factor.lower();
    Rows B;
    B.col(0) = PH_.col(0) / G(0, 0);
    B.col(1) = (PH_.col(1) - B.col(0) * G(1, 0)) / G(1, 1);
    B.col(2) = (PH_.col(2) - B.col(0) * G(2, 0) - B.col(1) * G(2, 1)) / G(2, 2);
    for (int j = 0; j < states; ++j) {
      belief_.P.col(j) -= B.col(0) * B(j, 0) + B.col(1) * B(j, 1) + B.col(2) * B(j, 2);
    }
    PH_ = (PH_ * kept).eval();
  }

  // From the sample before to this one.
  void carry_forward(const AxisSample<Scalar>& z) noexcept {
    const Matrix3 Q = noise_.process(gains());
    const Matrix3 HPH = here_.H.transpose() * PH_;
    belief_.s = si_;
    for (int k = 0; k < 2; ++k) {
      belief_.P.col(k) = PH_.col(k);
      belief_.P.row(k) = PH_.col(k).transpose();
    }
    const Scalar fade = here_.residual_left;
    belief_.P.col(Law::residual) *= fade;
    belief_.P.row(Law::residual) *= fade;
    belief_.P(0, Law::residual) = belief_.P(Law::residual, 0) = PH_(Law::residual, 0) * fade;
    belief_.P(1, Law::residual) = belief_.P(Law::residual, 1) = PH_(Law::residual, 1) * fade;
    belief_.P(0, 0) = HPH(0, 0);
    belief_.P(0, 1) = belief_.P(1, 0) = (HPH(0, 1) + HPH(1, 0)) / Scalar{2};
    belief_.P(1, 1) = HPH(1, 1);
    belief_.P(Law::residual, Law::residual) +=
        settings_.residual_deviation * settings_.residual_deviation * (Scalar{1} - fade * fade);
    belief_.s[Law::position] = here_.end.x + Q(0, 0) * missing_[0] + Q(0, 1) * missing_[1];
    belief_.s[Law::velocity] = here_.end.v + Q(1, 0) * missing_[0] + Q(1, 1) * missing_[1];
    belief_.s[Law::residual] = here_.end.residual;
    belief_.P(0, 0) += std::min(Q(0, 0), noise_.x_variance());
    belief_.P(1, 1) += std::min(Q(1, 1), noise_.v_variance());
    memory_ = here_.end.memory;
    taken_ = z.taken;
    law().visit(z.x);
    State u = State::Zero();
    belief_.keep_physical(belief_.s, u);
  }

  Settings settings_;
  TissueBelief<Law> belief_;
  Replay replay_{};
  State si_ = State::Zero(), u_ = State::Zero();
  typename Law::Memory memory_{};
  Time taken_{};
  bool started_ = false, touched_ = false, pushes_ = false, unexplained_ = false;
  int gaps_ = 0;    // intervals in a row that cannot be replayed
  int misses_ = 0;  // samples in a row that no law near the one that is known explains
  ContactEdge<Scalar> edge_{};
  SampleNoise<Scalar> noise_;
  ScaleChange<Scalar> scale_{typename ScaleChange<Scalar>::Settings{}};
  Matrix3 W_ = Matrix3::Zero();
  Scalar3 missing_ = Scalar3::Zero();
  Rows PH_ = Rows::Zero();
  Evaluation here_{}, there_{};
};

}  // namespace limpid
