// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/projection_rls.hpp>
#include <limpid/prediction/cubic_hermite.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/prediction/sample_intake.hpp>
#include <limpid/prediction/stable_recursion.hpp>
#include <limpid/signal/history.hpp>

#include <array>
#include <bit>
#include <cstddef>

namespace limpid {

/// Autoregression of the samples, each axis for itself, identified on line: with T the samples' period, x[j] and v[j]
/// at the newest sample's instant less j T, and d[j] = x[j] - x[j + 1],
///
///     d[0] = a_1 d[1] + ... + a_n d[n],     T v[0] = a_1 T v[1] + ... + a_n T v[n]
///
/// are two equations for one least squares (`ProjectionRLS` without normalisation). Differences know no offset: what
/// moves in n modes, as a sum of damped oscillations about any depth does, obeys both exactly. From the newest sample
/// the recursion gives the motion at T, 2 T, ... after it; between these lies the cubic through positions and
/// velocities.
///
/// Samples need not be T apart: the past is read at multiples of T before the newest one, between samples by the same
/// cubic. Where it is not known so far back, where two samples have more than 2.5 T between them, or after a leap of
/// more than `reach` between two, nothing is learnt, and the newest sample is held.
///
/// An axis holds the sample, too, while the equations so far were met no better by the recursion than by d[0] = 0 and
/// v[0] = v[1]; where a root of the recursion is larger than `growth`; where it leads further than `reach` from the
/// sample; and beyond `Steps` T.
/// @tparam Order  n
/// @tparam Steps  periods predicted at most
/// @realtime      no allocation, no throw; 20 flops an axis, and at a sample two updates of the least squares, n + 2
///                searches among some 2 n samples
template <int Order = 2, int Axes = 1, Real Scalar_ = double, int Steps = 8>
class AutoregressivePredictor {
  static_assert(Order >= 1 && Steps >= 1, "AutoregressivePredictor: Order and Steps are at least 1");

 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Coefficients = Eigen::Array<Scalar, Axes, Order>;  ///< row: axis, column: a_1 to a_n

  struct Settings {
    Duration period{};                           ///< T, > 0, at most an hour
    Scalar forgetting = Scalar{1} / Scalar{20};  ///< of what was learnt, from sample to sample, as exp(-forgetting)
    Scalar least_move = Scalar{1} / Scalar{1'000'000};  ///< of d, m, from which a few samples suffice; > 0
    Scalar growth = Scalar{21} / Scalar{20};            ///< most of a root's modulus, > 0
    Scalar reach = Scalar{1} / Scalar{10};              ///< most of d, of T v and of what is predicted, m, > 0
    Motion<Axes, Scalar> start{};                       ///< held until the first sample; m, m/s, m/s^2
  };

  /// @throws std::invalid_argument  where a setting is outside the range given at its field
  explicit AutoregressivePredictor(const Settings& settings)
      : period_{checked(settings).period},
        T_{in_seconds<Scalar>(period_)},
        unit_{Scalar{1} / settings.least_move},
        growth_{settings.growth},
        reach_{settings.reach},
        motion_{settings.start},
        law_{law_settings(settings)} {}

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<Axes, Scalar>& sample) noexcept { return intake_.observe(sample); }

  /// @param F_h  operator's force, N; has no influence
  /// @return     out_of_history: a sample taken after `now` was dropped
  [[nodiscard]] Prediction<Axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (const Status refused = intake_.refusal(now, F_h); refused != Status::ok) return {motion_, refused};
    const Status status = intake_.begin(now);
    if (!intake_.any()) return {motion_, status};
    if (intake_.fresh()) take_over_sample();
    const Motion<Axes, Scalar> next = at_age(intake_.age(period_ * Steps));
    if (!is_finite(next)) return {motion_, status | Status::not_finite};
    motion_ = next;
    return {motion_, status};
  }

  [[nodiscard]] Coefficients coefficients() const noexcept { return law_.theta(); }

  /// Whether an axis is predicted, and not held.
  [[nodiscard]] bool predicts(int axis) const noexcept { return predicts_[static_cast<std::size_t>(axis)]; }

 private:
  using Law = ProjectionRLS<Order, Axes, Scalar>;
  // Columns: now, one period before, ... Of d and T v, m.
  using Past = Eigen::Array<Scalar, Axes, Order + 1>;
  static constexpr auto remembered = std::bit_ceil(static_cast<std::size_t>(2 * (Order + 2)));

  static const Settings& checked(const Settings& s) {
    const auto positive = [](const Scalar& value) { return is_finite(value) && value > Scalar{0}; };
    expect(s.period > Duration{0} && s.period <= std::chrono::hours{1}, "AutoregressivePredictor: period",
           "> 0 and at most an hour", s.period);
    expect(is_finite(s.forgetting) && s.forgetting >= Scalar{0}, "AutoregressivePredictor: forgetting",
           "finite and >= 0", s.forgetting);
    expect(positive(s.least_move), "AutoregressivePredictor: least_move", "finite and > 0", s.least_move);
    expect(positive(s.growth), "AutoregressivePredictor: growth", "finite and > 0", s.growth);
    expect(positive(s.reach), "AutoregressivePredictor: reach", "finite and > 0", s.reach);
    expect(is_finite(s.start), "AutoregressivePredictor: start", "finite", "a motion that is not");
    return s;
  }

  // The box holds all coefficients whose roots are within `growth`: |a_i| <= growth^i times i out of n. At the start
  // differences stay as they are. Gain 1 weighs that as one equation with d = `least_move`.
  static typename Law::Settings law_settings(const Settings& s) {
    typename Law::Settings law;
    Scalar bound{1};
    for (int i = 0; i < Order; ++i) {
      bound *= s.growth * Scalar(Order - i) / Scalar(i + 1);
      law.upper.col(i).setConstant(bound);
    }
    law.lower = -law.upper;
    law.initial.setZero();
    law.initial.col(0) = law.upper.col(0).min(Scalar{1});
    law.initial_gain.setOnes();
    law.forgetting = s.forgetting;
    law.normalisation = Scalar{0};
    law.gain_limit = Scalar{1};
    return law;
  }

  void take_over_sample() noexcept {
    const auto& sample = intake_.held();
    const Motion<Axes, Scalar> here{sample.x, sample.v, sample.a};
    if (samples_.size() > 0 && leaps(here)) {
      samples_.clear();
      met_.setZero();
      held_met_.setZero();
    }
    samples_.append(intake_.taken(), here);
    node_ = from_ = to_ = here;
    steps_ = 0;
    predicts_.fill(false);
    if (!read_past()) return;
    learn();
    for (int axis = 0; axis < Axes; ++axis)
      predicts_[static_cast<std::size_t>(axis)] =
          met_[axis] < held_met_[axis] && roots_within<Order, Scalar>(law_.theta().row(axis), growth_);
    to_ = next_node();
  }

  [[nodiscard]] bool leaps(const Motion<Axes, Scalar>& here) const noexcept {
    const Vector before = samples_.value(samples_.size() - 1).x;
    return !((here.x - before).abs().maxCoeff() <= reach_ && here.v.abs().maxCoeff() * T_ <= reach_);
  }

  // d and T v of now and n periods before.
  bool read_past() noexcept {
    if (elapsed(intake_.taken(), samples_.time(0)) < period_ * (Order + 1)) return false;
    Vector later = intake_.held().x;
    moves_.col(0) = intake_.held().v * T_;
    for (int j = 0; j <= Order; ++j) {
      Motion<Axes, Scalar> before;
      if (!read(intake_.taken() - period_ * (j + 1), before)) return false;
      differences_.col(j) = later - before.x;
      later = before.x;
      if (j < Order) moves_.col(j + 1) = before.v * T_;
    }
    return true;
  }

  // Where samples do not enclose t, false.
  bool read(Time t, Motion<Axes, Scalar>& motion) const noexcept {
    const std::size_t i = samples_.first_not_before(t);
    const Time after = samples_.time(i);
    motion = samples_.value(i);
    if (after == t) return true;
    if (i == 0 || Scalar{2} * in_seconds<Scalar>(after - samples_.time(i - 1)) > Scalar{5} * T_) return false;
    const Scalar h = in_seconds<Scalar>(after - samples_.time(i - 1));
    motion = detail::cubic_hermite(samples_.value(i - 1), samples_.value(i),
                                   in_seconds<Scalar>(t - samples_.time(i - 1)) / h, h);
    return true;
  }

  // The two equations, first judged by the coefficients before them.
  void learn() noexcept {
    const Vector before = moves_.col(1);
    judge(differences_, Vector::Zero());
    judge(moves_, before);
    for (const Past* past : {&differences_, &moves_}) {
      const Coefficients phi = past->template rightCols<Order>() * unit_;
      (void)law_.update(Scalar{1} / Scalar{2}, phi, Vector(past->col(0) * unit_));
    }
  }

  void judge(const Past& past, const Vector& held) noexcept {
    const Vector missed = past.col(0) - (law_.theta() * past.template rightCols<Order>()).rowwise().sum();
    const Scalar kept = Scalar{19} / Scalar{20};
    met_ = met_ * kept + missed.square();
    held_met_ = held_met_ * kept + (past.col(0) - held).square();
  }

  // One period on; `differences_` and `moves_` then are those of the next node.
  Motion<Axes, Scalar> next_node() noexcept {
    const Coefficients a = law_.theta();
    const Vector d = (a * differences_.template leftCols<Order>()).rowwise().sum(),
                 m = (a * moves_.template leftCols<Order>()).rowwise().sum();
    for (int j = Order; j > 0; --j) {
      differences_.col(j) = differences_.col(j - 1);
      moves_.col(j) = moves_.col(j - 1);
    }
    differences_.col(0) = d;
    moves_.col(0) = m;
    const Motion<Axes, Scalar> next{to_.x + d, m / T_, Vector::Zero()};
    for (int axis = 0; axis < Axes; ++axis) {
      const auto within = [&](const Scalar& move) { return move <= reach_ && move >= -reach_; };
      if (!within(next.x[axis] - node_.x[axis]) || !within(m[axis])) predicts_[static_cast<std::size_t>(axis)] = false;
    }
    return next;
  }

  // Seconds after the sample; an axis that is not predicted holds it.
  Motion<Axes, Scalar> at_age(const Scalar& age) noexcept {
    for (; age > T_ * Scalar(steps_ + 1) && steps_ + 1 < Steps; ++steps_) {
      from_ = to_;
      to_ = next_node();
    }
    auto motion = detail::cubic_hermite(from_, to_, age / T_ - Scalar(steps_), T_);
    for (int axis = 0; axis < Axes; ++axis) {
      if (predicts(axis)) continue;
      motion.x[axis] = node_.x[axis];
      motion.v[axis] = node_.v[axis];
      motion.a[axis] = node_.a[axis];
    }
    return motion;
  }

  Duration period_;
  Scalar T_, unit_, growth_, reach_;  // s, 1/m, 1, m
  Motion<Axes, Scalar> motion_;       // returned last
  Law law_;
  Vector met_ = Vector::Zero(), held_met_ = Vector::Zero();  // mean squares missed, by the recursion and by hold, m^2
  detail::SampleIntake<Axes, Scalar> intake_;
  History<Motion<Axes, Scalar>, remembered> samples_;
  Past differences_ = Past::Zero(), moves_ = Past::Zero();  // of the newest node
  Motion<Axes, Scalar> node_{}, from_{}, to_{};             // the sample; steps_ and steps_ + 1 periods after it
  int steps_ = 0;
  std::array<bool, std::size_t{Axes}> predicts_{};
};

}  // namespace limpid
