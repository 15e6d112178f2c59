// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/cholesky_3.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/time.hpp>
#include <limpid/estimation/noise_levels.hpp>
#include <limpid/estimation/scale_change.hpp>
#include <limpid/estimation/tissue_law.hpp>
#include <limpid/signal/history.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace limpid {

/// What one axis of a sample says: position, velocity, the tissue's force.
template <Real Scalar = double>
struct AxisSample {
  Time taken{};
  Scalar x{0};      ///< m
  Scalar v{0};      ///< m/s
  Scalar force{0};  ///< F_e, N
};

/// Learns the whole force law of a tissue along one axis from samples of the tool and the known force of the operator.
///
/// Two samples and the operator's force between them hold the tissue's impulse: the tool is replayed from the one to
/// the other with the law as it is known, and an iterated Kalman filter takes what is missing at the end, in x, v and
/// F_e, as the error of the law, of the state at the start, and of the measurements. Each iteration is a Gauss-Newton
/// step on
///
///     (s - s0)' P^-1 (s - s0) + (z - h(s))' W^-1 (z - h(s)),
///
/// halved until it falls; slopes and dampings stay physical by the nearest point in P's metric. How noisy the signals
/// are is learnt, and whether the tissue has changed as a whole. See TissueLaw for the law.
/// @tparam Law       TissueLaw
/// @tparam Capacity  ticks between two samples at most; where there are more, learning starts again from the sample
/// @realtime         no allocation, no throw for built-in scalars; some 8 states^2 + 400 flops a tick of the interval,
///                   at the sample
template <typename Law = TissueLaw<>, std::size_t Capacity = 512>
class TissueLearner {
 public:
  using Scalar = typename Law::Scalar;
  using State = typename Law::State;
  using Point = typename Law::Point;
  static constexpr int states = Law::states;

  struct Settings {
    Scalar mass{};                                     ///< of the tool, kg
    Scalar tool_damping{0};                            ///< N s/m
    Scalar knot_spacing = Scalar(5) / 100000;          ///< at first; doubled where the range needs it, m
    Scalar damper_spacing = Scalar(1) / 1000;          ///< m
    Scalar slope{1000}, slope_deviation{700};          ///< of the tissue before anything is seen, N/m
    Scalar curvature{60000};                           ///< deviation of the slope's change over depth, (N/m)/sqrt(m)
    Scalar damping{25}, damping_deviation{12};         ///< N s/m
    Scalar damping_change{10};                         ///< deviation from one damper to the next, N s/m
    bool relaxation = true, dry_friction = false;      ///< whether they are learnt
    Scalar branch_deviation{50};                       ///< of each K_i, N/m
    Scalar friction_deviation = Scalar(5) / 100;       ///< of F_c, N
    typename Law::Branch::Lags lags = default_lags();  ///< of the branches, s
    Scalar presliding = Scalar(1) / 100000;            ///< m
    Scalar residual_time = Scalar(3) / 10;             ///< s
    Scalar residual_deviation = Scalar(1) / 10000;     ///< N
    Scalar process_deviation = Scalar(1) / 10000;      ///< of a force that the law lacks over an interval, N
    Scalar least_slope{150};                           ///< of the prediction beyond the visited depths, N/m
    Scalar most_slope{6000}, most_damping{200};        ///< N/m, N s/m
    bool scale_changes = true;                         ///< whether the tissue may change as a whole
    int iterations = 6;                                ///< at most
  };

  /// @throws std::invalid_argument  where a field is refused
  explicit TissueLearner(const Settings& settings)
      : settings_{check(settings)}, law_(law_settings(settings), Scalar{0}) {}

  [[nodiscard]] const Law& law() const noexcept { return law_; }
  [[nodiscard]] Law& law() noexcept { return law_; }
  [[nodiscard]] const State& state() const noexcept { return s_; }
  [[nodiscard]] bool started() const noexcept { return started_; }

  /// Where the newest sample was, as far as is known: measured and filtered.
  [[nodiscard]] Point newest() const noexcept {
    return {s_[Law::position], s_[Law::velocity], s_[Law::residual], memory_};
  }
  [[nodiscard]] Time taken() const noexcept { return taken_; }

  /// Variance of F_e, x and v as it is known to be, N^2, m^2, (m/s)^2.
  [[nodiscard]] const Scalar& force_variance() const noexcept { return force_noise_.variance(); }

  /// Takes in a sample, newer than the one before.
  /// @param forces  operator's force, N, at least from the sample before to this one; linear between its entries
  template <std::size_t N>
  void learn(const AxisSample<Scalar>& sample, const History<Scalar, N>& forces) noexcept {
    if (!started_) return start(sample);
    if (!find_steps(forces, taken_, sample.taken)) return restart(sample);
    cover(sample);
    if (!evaluate(s_, sample, here_)) return restart(sample);
    weigh(sample);
    iterate(sample);
    take_in();
    carry_forward(sample);
  }

 private:
  using Scalar3 = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
  using Rows = Eigen::Matrix<Scalar, states, 3>;  // of the measurements, transposed: a column each
  using Covariance = Eigen::Matrix<Scalar, states, states>;

  struct Evaluation {
    Rows H = Rows::Zero();
    Scalar3 y = Scalar3::Zero();  // measured less replayed
    Point end{};
    Scalar x_gain{0}, v_gain{0};  // of a constant force of 1 N over the interval
  };
  struct Step {
    Scalar h, F0, F1;
  };

  static typename Law::Branch::Lags default_lags() noexcept {
    typename Law::Branch::Lags lags{};
    Scalar lag = Scalar(8) / 100;
    for (auto& each : lags) {
      each = lag;
      lag *= Scalar(2);
    }
    return lags;
  }

  static const Settings& check(const Settings& s) {
    const auto positive = [](const Scalar& value, const char* field) {
      expect(is_finite(value) && value > Scalar{0}, field, "finite and > 0", value);
    };
    positive(s.mass, "TissueLearner: mass");
    expect(is_finite(s.tool_damping) && s.tool_damping >= Scalar{0}, "TissueLearner: tool_damping", "finite and >= 0",
           s.tool_damping);
    positive(s.knot_spacing, "TissueLearner: knot_spacing");
    positive(s.damper_spacing, "TissueLearner: damper_spacing");
    positive(s.slope, "TissueLearner: slope");
    positive(s.slope_deviation, "TissueLearner: slope_deviation");
    positive(s.curvature, "TissueLearner: curvature");
    positive(s.damping, "TissueLearner: damping");
    positive(s.damping_deviation, "TissueLearner: damping_deviation");
    positive(s.damping_change, "TissueLearner: damping_change");
    positive(s.branch_deviation, "TissueLearner: branch_deviation");
    positive(s.friction_deviation, "TissueLearner: friction_deviation");
    for (const Scalar& lag : s.lags) positive(lag, "TissueLearner: lags");
    positive(s.presliding, "TissueLearner: presliding");
    positive(s.residual_time, "TissueLearner: residual_time");
    positive(s.residual_deviation, "TissueLearner: residual_deviation");
    positive(s.process_deviation, "TissueLearner: process_deviation");
    positive(s.least_slope, "TissueLearner: least_slope");
    positive(s.most_slope, "TissueLearner: most_slope");
    positive(s.most_damping, "TissueLearner: most_damping");
    expect(s.iterations >= 1 && s.iterations <= 20, "TissueLearner: iterations", "1 to 20", s.iterations);
    return s;
  }

  static typename Law::Settings law_settings(const Settings& s) noexcept {
    return {.mass = s.mass,
            .tool_damping = s.tool_damping,
            .knot_spacing = s.knot_spacing,
            .damper_spacing = s.damper_spacing,
            .lags = s.lags,
            .presliding = s.presliding,
            .residual_time = s.residual_time,
            .least_slope = s.least_slope,
            .most_damping = s.most_damping,
            .relaxation = s.relaxation,
            .dry_friction = s.dry_friction};
  }

  // The prior about the first sample: a straight law of unknown slope and damping.
  void start(const AxisSample<Scalar>& z) noexcept {
    law_ = Law(law_settings(settings_), z.x);
    s_.setZero();
    P_.setZero();
    memory_ = {};
    place(z);
    const auto square = [](const Scalar& value) { return value * value; };
    if (settings_.relaxation) {
      for (int i = 0; i < Law::branches; ++i) {
        P_(Law::first_branch + i, Law::first_branch + i) = square(settings_.branch_deviation);
      }
    }
    if (settings_.dry_friction) P_(Law::friction, Law::friction) = square(settings_.friction_deviation);
    for (int j = law_.dampers().low; j <= law_.dampers().high; ++j) {
      s_[Law::damper(j)] = settings_.damping;
      for (int i = law_.dampers().low; i <= law_.dampers().high; ++i) {
        P_(Law::damper(i), Law::damper(j)) =
            square(settings_.damping_deviation) + (i == j ? square(settings_.damping_change) / Scalar(100) : Scalar{0});
      }
    }
    const auto& knots = law_.knots();
    const auto away = [&](int j) { return Scalar(j) * knots.spacing() - z.x; };
    for (int j = knots.low(); j <= knots.high(); ++j) {
      s_[Law::coefficient(j)] = settings_.slope * away(j);
      for (int i = knots.low(); i <= knots.high(); ++i) {
        P_(Law::coefficient(i), Law::coefficient(j)) = Scalar{1} +
                                                       away(i) * away(j) * square(settings_.slope_deviation) +
                                                       (i == j ? bend_variance() / Scalar(10) : Scalar{0});
      }
    }
    started_ = true;
    take_force(z, force_noise_.variance());
  }

  // Learning cannot go on from the sample before: the law stays, the state is the sample's.
  void restart(const AxisSample<Scalar>& z) noexcept {
    memory_ = {};
    P_.template topRows<3>().setZero();
    P_.template leftCols<3>().setZero();
    place(z);
    if (law_.knots().at(z.x).first >= law_.knots().low()) {
      take_force(z, force_noise_.variance() + Scalar(1) / Scalar(10000));
    }
  }

  void place(const AxisSample<Scalar>& z) noexcept {
    s_[Law::position] = z.x;
    s_[Law::velocity] = z.v;
    s_[Law::residual] = Scalar{0};
    P_(Law::position, Law::position) = x_noise_.variance();
    P_(Law::velocity, Law::velocity) = v_noise_.variance();
    P_(Law::residual, Law::residual) = settings_.residual_deviation * settings_.residual_deviation;
    taken_ = z.taken;
    law_.visit(z.x);
  }

  // F_e alone, at the sample's x and v.
  void take_force(const AxisSample<Scalar>& z, const Scalar& variance) noexcept {
    Evaluation& e = here_;
    e.H.col(2).setZero();
    add_row(e.H, 2, s_, {z.x, z.v, Scalar{0}, memory_}, Scalar{1});
    e.H(Law::residual, 2) = Scalar{1};
    const State gain = P_ * e.H.col(2);
    const Scalar whole = e.H.col(2).dot(gain) + variance;
    s_ += gain * ((z.force - law_.force(s_, {z.x, z.v, Scalar{0}, memory_})) / whole);
    for (int j = 0; j < states; ++j) P_.col(j) -= gain * (gain[j] / whole);
  }

  [[nodiscard]] Scalar bend_variance() const noexcept {
    const Scalar& h = law_.knots().spacing();
    return settings_.curvature * settings_.curvature * h * h * h;
  }

  // The steps between two instants, at most Capacity; false where there are more, or not enough forces.
  template <std::size_t N>
  [[nodiscard]] bool find_steps(const History<Scalar, N>& forces, Time from, Time to) noexcept {
    step_count_ = 0;
    const auto first = forces.at(from);
    if (first.status != Status::ok || forces.at(to).status != Status::ok || to <= from) return false;
    Time t = from;
    Scalar F = first.value;
    for (std::size_t i = forces.first_not_before(from); t < to; ++i) {
      if (i < forces.size() && forces.time(i) <= t) continue;
      if (step_count_ == Capacity) return false;
      const bool within = i < forces.size() && forces.time(i) <= to;
      const Time next = within ? forces.time(i) : to;
      const Scalar F1 = within ? forces.value(i) : forces.at(to).value;
      steps_[step_count_++] = {in_seconds<Scalar>(elapsed(next, t)), F, F1};
      t = next;
      F = F1;
    }
    return true;
  }

  // The law's range holds the sample and, as it is known now, the way to it.
  void cover(const AxisSample<Scalar>& z) noexcept {
    Scalar low = std::min(s_[Law::position], z.x), high = std::max(s_[Law::position], z.x);
    Point p = newest();
    const Scalar near(Scalar(2) / Scalar(1000));
    for (std::size_t i = 0; i < step_count_; ++i) {
      law_.template step<false>(s_, p, steps_[i].F0, steps_[i].F1, steps_[i].h);
      using std::abs;
      if (!(abs(p.x - z.x) < near)) continue;
      low = std::min(low, p.x);
      high = std::max(high, p.x);
    }
    extend(low - law_.knots().spacing(), high + law_.knots().spacing());
  }

  void extend(const Scalar& low, const Scalar& high) noexcept {
    auto& knots = law_.knots();
    const auto needed = [&] {
      const int l = std::min(knots.low(), SplineKnots<Scalar>::cell(low / knots.spacing()) - 1);
      const int h = std::max(knots.high(), SplineKnots<Scalar>::cell(high / knots.spacing()) + 2);
      return std::pair{l, h};
    };
    for (int i = 0; i < 6 && needed().second - needed().first + 1 > Law::most_coefficients; ++i) coarsen();
    const auto [l, h] = needed();
    while (knots.high() < h && knots.count() < Law::most_coefficients) grow(knots.high(), 1);
    while (knots.low() > l && knots.count() < Law::most_coefficients) grow(knots.low(), -1);
    auto& dampers = law_.dampers();
    const Scalar& width = settings_.damper_spacing;
    const int dl = SplineKnots<Scalar>::cell(low / width), dh = SplineKnots<Scalar>::cell(high / width) + 1;
    while (dampers.high < dh && dampers.high - dampers.low + 1 < Law::most_dampers) grow_damper(dampers.high, 1);
    while (dampers.low > dl && dampers.high - dampers.low + 1 < Law::most_dampers) grow_damper(dampers.low, -1);
  }

  // A parameter that is a sum of others, and a variance of its own.
  void derive(int place, const Scalar& a, int first, const Scalar& b, int second, const Scalar& variance) noexcept {
    s_[place] = a * s_[first] + b * s_[second];
    State row = a * P_.col(first) + b * P_.col(second);
    row[place] = a * row[first] + b * row[second] + variance;
    P_.col(place) = row;
    P_.row(place) = row.transpose();
  }

  void grow(int edge, int direction) noexcept {
    derive(Law::coefficient(edge + direction), Scalar{2}, Law::coefficient(edge), Scalar{-1},
           Law::coefficient(edge - direction), bend_variance());
    if (direction > 0) {
      law_.knots().extend_up();
    } else {
      law_.knots().extend_down();
    }
  }

  void grow_damper(int edge, int direction) noexcept {
    derive(Law::damper(edge + direction), Scalar{1}, Law::damper(edge), Scalar{0}, Law::damper(edge),
           settings_.damping_change * settings_.damping_change);
    (direction > 0 ? law_.dampers().high : law_.dampers().low) += direction;
  }

  // Twice the spacing: coefficients from the curve at the knots that stay, c_j = (8 f_j - f_j-1 - f_j+1)/6, which is
  // exact for cubics. Rare.
  void coarsen() noexcept {
    auto& knots = law_.knots();
    const int low = knots.inner_low_of_coarse(), high = knots.inner_high_of_coarse(), count = high - low + 3;
    const SplineKnots<Scalar> fine = knots;
    // rows of the map from fine to coarse coefficients: at most nine entries about 2 J
    const auto add_value = [&](int J, const Scalar& weight, Weights& to) {
      for (int k = -1; k <= 1; ++k) {
        to[std::size_t(2 * J + k - fine.low())] += weight * (k == 0 ? Scalar(4) : Scalar(1)) / Scalar(6);
      }
    };
    const auto add_straight = [&](int J, const Scalar& weight, Weights& to) {
      const int inside = std::clamp(J, low, high), beside = J < low ? low + 1 : high - 1;
      if (J == inside) return add_value(J, weight, to);
      add_value(inside, Scalar(2) * weight, to);
      add_value(beside, -weight, to);
    };
    for (int j = fine.low(); j <= fine.high(); ++j) order_[std::size_t(j - fine.low())] = Law::coefficient(j);
    for (int i = 0; i < count; ++i) {
      Weights& row = map_[std::size_t(i)];
      row.fill(Scalar{0});
      add_straight(low - 1 + i, Scalar(8) / Scalar(6), row);
      add_straight(low - 2 + i, Scalar(-1) / Scalar(6), row);
      add_straight(low + i, Scalar(-1) / Scalar(6), row);
    }
    remap(fine.count(), count);
    knots.coarsen();
    scatter(low - 1, count);
  }

  using Weights = std::array<Scalar, std::size_t(Law::most_coefficients)>;

  // s and P of `fine` ordered coefficients to `count` mapped ones, which are left in the first places of the ring.
  void remap(int fine, int count) noexcept {
    const auto places = [&](int i) { return order_[std::size_t(i)]; };
    const auto mapped = [&](const auto& value) {
      Weights result{};
      for (int i = 0; i < count; ++i) {
        Scalar sum{0};
        for (int k = 0; k < fine; ++k) sum += map_[std::size_t(i)][std::size_t(k)] * value(places(k));
        result[std::size_t(i)] = sum;
      }
      return result;
    };
    const Weights c = mapped([&](int k) { return s_[k]; });
    for (int column = 0; column < states; ++column) {
      const Weights m = mapped([&](int k) { return P_(k, column); });
      P_.col(column).template tail<Law::most_coefficients>().setZero();
      for (int i = 0; i < count; ++i) P_(Law::first_coefficient + i, column) = m[std::size_t(i)];
    }
    for (int row = 0; row < states; ++row) {
      const Weights m = mapped([&](int k) { return P_(row, k); });
      P_.row(row).template tail<Law::most_coefficients>().setZero();
      for (int i = 0; i < count; ++i) P_(row, Law::first_coefficient + i) = m[std::size_t(i)];
    }
    s_.template tail<Law::most_coefficients>().setZero();
    for (int i = 0; i < count; ++i) s_[Law::first_coefficient + i] = c[std::size_t(i)];
  }

  // From the first places of the ring to those of the coefficients from `low` on.
  void scatter(int low, int count) noexcept {
    const int shift = Law::coefficient(low) - Law::first_coefficient;
    const auto turn = [&](auto&& entry) {
      Weights kept{};
      for (int i = 0; i < Law::most_coefficients; ++i) kept[std::size_t(i)] = entry(Law::first_coefficient + i);
      for (int i = 0; i < Law::most_coefficients; ++i) {
        entry(Law::first_coefficient + (i + shift) % Law::most_coefficients) = kept[std::size_t(i)];
      }
    };
    turn([&](int i) -> Scalar& { return s_[i]; });
    for (int k = 0; k < states; ++k) turn([&](int i) -> Scalar& { return P_(i, k); });
    for (int k = 0; k < states; ++k) turn([&](int i) -> Scalar& { return P_(k, i); });
    for (int i = 0; i < count; ++i) {
      const int place = Law::coefficient(low + i);
      P_(place, place) += bend_variance() / Scalar(10000);
    }
  }

  // What the force at a point has of each parameter, times `weight`, added to one column of the rows.
  template <typename Any>
  void add_row(Any& H, int column, const State&, const Point& p, const Scalar& weight) const noexcept {
    const auto w = law_.knots().at(p.x);
    for (std::size_t k = 0; k < 4; ++k)
      H(Law::coefficient(w.first + static_cast<int>(k)), column) += weight * w.value[k];
    const auto [first, second] = law_.damper_weights(p.x);
    H(Law::damper(first), column) += weight * p.v * (Scalar{1} - second);
    H(Law::damper(first + 1), column) += weight * p.v * second;
    if (settings_.relaxation) {
      for (int i = 0; i < Law::branches; ++i) {
        H(Law::first_branch + i, column) += weight * p.memory.chi[std::size_t(i)];
      }
    }
    if (settings_.dry_friction) H(Law::friction, column) += weight * p.memory.bristle;
  }

  // Replays the interval from s; false where that leads nowhere.
  [[nodiscard]] bool evaluate(const State& s, const AxisSample<Scalar>& z, Evaluation& e) noexcept {
    using std::abs;
    Point p{s[Law::position], s[Law::velocity], s[Law::residual], memory_};
    path_[0] = p;
    for (std::size_t i = 0; i < step_count_; ++i) {
      law_.template step<false>(s, p, steps_[i].F0, steps_[i].F1, steps_[i].h);
      path_[i + 1] = p;
    }
    e.end = p;
    if (!(abs(p.x - z.x) < Scalar(5) / Scalar(100)) || !(abs(p.v - z.v) < Scalar(5))) return false;
    sensitivities(s, e);
    const Point at{z.x, z.v, p.residual, p.memory};
    add_row(e.H, 2, s, at, Scalar{1});
    e.H(Law::residual, 2) = residual_left_;
    e.y = {z.x - p.x, z.v - p.v, z.force - law_.force(s, at)};
    return (e.H.array().abs() < Scalar(1'000'000)).all() && is_finite(e.y);
  }

  // dx/ds and dv/ds at the end, backwards along the path: the adjoint of the step's trapezoidal linearisation.
  void sensitivities(const State& s, Evaluation& e) noexcept {
    e.H.setZero();
    const Scalar per_mass = Scalar{1} / settings_.mass, half = Scalar{1} / Scalar{2};
    Eigen::Matrix<Scalar, 2, 2> L = Eigen::Matrix<Scalar, 2, 2>::Identity();
    Scalar left{1}, rx{0}, rv{0};
    e.x_gain = e.v_gain = Scalar{0};
    for (std::size_t i = 0; i < step_count_; ++i) left *= law_.residual_left(steps_[i].h);
    residual_left_ = left;
    for (std::size_t i = step_count_; i-- > 0;) {
      const Scalar& h = steps_[i].h;
      const Point mid = between(path_[i], path_[i + 1]);
      const Scalar k = law_.elastic(s, mid.x).slope * per_mass;
      const Scalar b = (law_.damping(s, mid.x) + settings_.tool_damping) * per_mass;
      // (I - A h/2)^-1 with A = (0 1; -k -b)
      const Scalar q = h * half, determinant = Scalar{1} + q * b + q * q * k, per = Scalar{1} / determinant;
      Eigen::Matrix<Scalar, 2, 2> inverse;
      inverse << (Scalar{1} + q * b) * per, q * per, -q * k * per, per;
      const Eigen::Matrix<Scalar, 2, 1> gain = L * inverse.col(1) * (-h * per_mass);
      add_row(e.H, 0, s, mid, gain[0]);
      add_row(e.H, 1, s, mid, gain[1]);
      const Scalar fade = law_.residual_left(h), mean_fade = half * (Scalar{1} + fade);
      rx = gain[0] * mean_fade + rx * fade;
      rv = gain[1] * mean_fade + rv * fade;
      e.x_gain += gain[0];
      e.v_gain += gain[1];
      const Eigen::Matrix<Scalar, 2, 2> transition =
          Scalar{2} * inverse - Eigen::Matrix<Scalar, 2, 2>::Identity();  // (I - A q)^-1 (I + A q)
      L = (L * transition).eval();
    }
    e.H.template block<2, 1>(0, 0) = L.row(0).transpose();
    e.H.template block<2, 1>(0, 1) = L.row(1).transpose();
    e.H(Law::residual, 0) = rx;
    e.H(Law::residual, 1) = rv;
  }

  static Point between(const Point& a, const Point& b) noexcept {
    const Scalar half = Scalar{1} / Scalar{2};
    Point mid{half * (a.x + b.x), half * (a.v + b.v), half * (a.residual + b.residual), {}};
    for (std::size_t i = 0; i < mid.memory.chi.size(); ++i) {
      mid.memory.chi[i] = half * (a.memory.chi[i] + b.memory.chi[i]);
    }
    mid.memory.bristle = half * (a.memory.bristle + b.memory.bristle);
    return mid;
  }

  // P H of three measurements, by the columns of P that have a say.
  void project_rows(const Rows& H, Rows& PH) const noexcept {
    PH.setZero();
    for (int i = 0; i < states; ++i) {
      if (H(i, 0) == Scalar{0} && H(i, 1) == Scalar{0} && H(i, 2) == Scalar{0}) continue;
      for (int k = 0; k < 3; ++k) PH.col(k) += P_.col(i) * H(i, k);
    }
  }

  // The weights of the measurements, before the first iteration: noises, a change of the whole, an outlier of F_e.
  void weigh(const AxisSample<Scalar>& z) noexcept {
    project_rows(here_.H, PH_);
    Matrix3 S = here_.H.transpose() * PH_;
    x_noise_.observe(here_.y[0], S(0, 0) + process()(0, 0));
    v_noise_.observe(here_.y[1], S(1, 1) + process()(1, 1));
    force_noise_.observe(here_.y[2], S(2, 2));
    W_ = process();
    W_(0, 0) += x_noise_.variance();
    W_(1, 1) += v_noise_.variance();
    W_(2, 2) += force_noise_.variance();
    if (settings_.scale_changes) change_scale(S, in_seconds<Scalar>(elapsed(z.taken, taken_)));
    using std::sqrt;
    const Scalar expected = S(2, 2) + W_(2, 2), distance = here_.y[2] * here_.y[2] / expected;
    if (distance > Scalar(9)) W_(2, 2) = expected * distance / Scalar(9) - S(2, 2);
  }

  // Of a force that the law lacks over the interval.
  [[nodiscard]] Matrix3 process() const noexcept {
    const Scalar q = settings_.process_deviation * settings_.process_deviation, more = Scalar(105) / Scalar(100);
    Matrix3 Q = Matrix3::Zero();
    Q(0, 0) = q * more * here_.x_gain * here_.x_gain;
    Q(1, 1) = q * more * here_.v_gain * here_.v_gain;
    Q(0, 1) = Q(1, 0) = q * here_.x_gain * here_.v_gain;
    return Q;
  }

  void change_scale(Matrix3& S, const Scalar& T) noexcept {
    State whole = s_;
    whole.template head<Law::first_branch>().setZero();
    whole.template segment<Law::most_dampers>(Law::first_damper).setZero();
    const Scalar3 effect = here_.H.transpose() * whole;
    const Scalar variance = scale_.variance(S + W_, here_.y, effect, T);
    if (!(variance > Scalar{0})) return;
    for (int j = 0; j < states; ++j) P_.col(j) += whole * (whole[j] * variance);
    project_rows(here_.H, PH_);
    S = here_.H.transpose() * PH_;
  }

  // Gauss-Newton from the prior s_ to si_, in here_; u with si = s + P u gives the prior's cost without P^-1.
  void iterate(const AxisSample<Scalar>& z) noexcept {
    const Cholesky3<Scalar> weight(W_);
    const auto cost = [&](const State& u, const State& at, const Scalar3& y) {
      return u.dot(at - s_) + weight.whitened(y).squaredNorm();
    };
    si_ = s_;
    u_.setZero();
    Scalar now = cost(u_, si_, here_.y);
    for (int i = 0; i < settings_.iterations; ++i) {
      if (i > 0) project_rows(here_.H, PH_);
      const Matrix3 S = here_.H.transpose() * PH_ + W_;
      const Scalar3 g = Cholesky3<Scalar>(S).solve(here_.y - here_.H.transpose() * (s_ - si_));
      State u = here_.H * g, target = s_ + PH_ * g;
      keep_physical(target, u);
      const Scalar before = now;
      bool taken = false;
      Scalar part{1};
      for (int half = 0; half < 6 && !taken; ++half, part /= Scalar{2}) {
        const State trial_u = u_ + part * (u - u_), trial = si_ + part * (target - si_);
        if (!evaluate(trial, z, there_)) continue;
        const Scalar then = cost(trial_u, trial, there_.y);
        if (!(then <= before)) continue;
        std::swap(here_, there_);
        si_ = trial;
        u_ = trial_u;
        now = then;
        taken = true;
      }
      if (!taken || before - now < before / Scalar(10000) + Scalar(1) / Scalar(1'000'000)) break;
    }
  }

  // Slopes, dampings, friction and branches to the nearest physical ones in P's metric.
  void keep_physical(State& s, State& u) const noexcept {
    const auto move = [&](int place, const Scalar& by) {
      const Scalar& variance = P_(place, place);
      if (!(variance > Scalar(1) / Scalar(1'000'000'000'000))) return;
      s += P_.col(place) * (by / variance);
      u[place] += by / variance;
    };
    const Scalar per = Scalar{1} / law_.knots().spacing();
    for (int pass = 0; pass < 3; ++pass) {
      bool any = false;
      for (int j = law_.knots().low(); j < law_.knots().high(); ++j) {
        const int a = Law::coefficient(j), b = Law::coefficient(j + 1);
        const Scalar slope = (s[b] - s[a]) * per;
        const Scalar wanted = std::clamp(slope, Scalar{0}, settings_.most_slope);
        if (slope >= Scalar{-1} && slope <= settings_.most_slope + Scalar{1}) continue;
        const Scalar variance = (P_(b, b) - Scalar{2} * P_(a, b) + P_(a, a)) * per * per;
        if (!(variance > Scalar(1) / Scalar(1'000'000'000'000))) continue;
        const Scalar l = (wanted - slope) / variance * per;
        s += (P_.col(b) - P_.col(a)) * l;
        u[b] += l;
        u[a] -= l;
        any = true;
      }
      for (int i = 0; i < Law::branches; ++i) {
        if (s[Law::first_branch + i] < Scalar{0}) move(Law::first_branch + i, -s[Law::first_branch + i]);
      }
      if (s[Law::friction] < Scalar{0}) move(Law::friction, -s[Law::friction]);
      for (int j = law_.dampers().low; j <= law_.dampers().high; ++j) {
        const Scalar b = s[Law::damper(j)], wanted = std::clamp(b, Scalar{0}, settings_.most_damping);
        if (b == wanted) continue;
        move(Law::damper(j), wanted - b);
        any = true;
      }
      if (!any) break;
    }
  }

  // P less what the measurements tell, about si_.
  void take_in() noexcept {
    project_rows(here_.H, PH_);
    const Matrix3 S = here_.H.transpose() * PH_ + W_;
    const Cholesky3<Scalar> factor(S);
    missing_ = factor.solve(here_.y - here_.H.transpose() * (s_ - si_));
    const Matrix3& G = factor.lower();
    Rows B;
    B.col(0) = PH_.col(0) / G(0, 0);
    B.col(1) = (PH_.col(1) - B.col(0) * G(1, 0)) / G(1, 1);
    B.col(2) = (PH_.col(2) - B.col(0) * G(2, 0) - B.col(1) * G(2, 1)) / G(2, 2);
    for (int j = 0; j < states; ++j) {
      P_.col(j) -= B.col(0) * B(j, 0) + B.col(1) * B(j, 1) + B.col(2) * B(j, 2);
    }
  }

  // From the sample before to this one.
  void carry_forward(const AxisSample<Scalar>& z) noexcept {
    const Matrix3 Q = process();
    project_rows(here_.H, PH_);
    const Matrix3 HPH = here_.H.transpose() * PH_;
    s_ = si_;
    for (int k = 0; k < 2; ++k) {
      P_.col(k) = PH_.col(k);
      P_.row(k) = PH_.col(k).transpose();
    }
    const Scalar fade = residual_left_;
    P_.col(Law::residual) *= fade;
    P_.row(Law::residual) *= fade;
    P_(0, Law::residual) = P_(Law::residual, 0) = PH_(Law::residual, 0) * fade;
    P_(1, Law::residual) = P_(Law::residual, 1) = PH_(Law::residual, 1) * fade;
    P_(0, 0) = HPH(0, 0);
    P_(0, 1) = P_(1, 0) = (HPH(0, 1) + HPH(1, 0)) / Scalar{2};
    P_(1, 1) = HPH(1, 1);
    P_(Law::residual, Law::residual) +=
        settings_.residual_deviation * settings_.residual_deviation * (Scalar{1} - fade * fade);
    s_[Law::position] = here_.end.x + Q(0, 0) * missing_[0] + Q(0, 1) * missing_[1];
    s_[Law::velocity] = here_.end.v + Q(1, 0) * missing_[0] + Q(1, 1) * missing_[1];
    s_[Law::residual] = here_.end.residual;
    P_(0, 0) += std::min(Q(0, 0), x_noise_.variance());
    P_(1, 1) += std::min(Q(1, 1), v_noise_.variance());
    memory_ = here_.end.memory;
    taken_ = z.taken;
    law_.visit(z.x);
    State u = State::Zero();
    keep_physical(s_, u);
    P_ = ((P_ + P_.transpose()) / Scalar{2}).eval();
  }

  Settings settings_;
  Law law_;
  State s_ = State::Zero(), si_ = State::Zero(), u_ = State::Zero();
  Covariance P_ = Covariance::Zero();
  typename Law::Memory memory_{};
  Time taken_{};
  bool started_ = false;
  NoiseLevels<6, Scalar> x_noise_{
      {Scalar(1e-8), Scalar(1e-7), Scalar(5e-7), Scalar(1.5e-6), Scalar(3e-6), Scalar(1e-5)}, Scalar(98) / Scalar(100)};
  NoiseLevels<5, Scalar> v_noise_{{Scalar(1e-6), Scalar(1e-5), Scalar(3e-5), Scalar(1e-4), Scalar(3e-4)},
                                  Scalar(98) / Scalar(100)};
  NoiseLevels<6, Scalar> force_noise_{
      {Scalar(1e-4), Scalar(1e-3), Scalar(3e-3), Scalar(1e-2), Scalar(3e-2), Scalar(1e-1)}, Scalar(98) / Scalar(100)};
  ScaleChange<Scalar> scale_{typename ScaleChange<Scalar>::Settings{}};
  Scalar residual_left_{1};
  Matrix3 W_ = Matrix3::Zero();
  Scalar3 missing_ = Scalar3::Zero();
  Rows PH_ = Rows::Zero();
  Evaluation here_{}, there_{};
  std::array<Step, Capacity> steps_{};
  std::array<Point, Capacity + 1> path_{};
  std::size_t step_count_ = 0;
  std::array<int, std::size_t(Law::most_coefficients)> order_{};
  std::array<Weights, std::size_t(Law::most_coefficients)> map_{};
};

}  // namespace limpid
