// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/cholesky_3.hpp>
#include <limpid/core/real.hpp>
#include <limpid/environment/spline_knots.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace limpid {

/// What is believed of a tissue: its law's range, the parameters' mean s and covariance P. The range grows where the
/// tool goes; where it outgrows the coefficients the knots' spacing doubles.
/// @tparam Law  TissueLaw
/// @realtime    no allocation, no throw for built-in scalars; growth by one is O(states), a doubling O(states^2 times
///              coefficients), rare
template <typename Law>
class TissueBelief {
 public:
  using Scalar = typename Law::Scalar;
  using State = typename Law::State;
  using Rows = Eigen::Matrix<Scalar, Law::states, 3>;
  static constexpr int states = Law::states;
  using Covariance = Eigen::Matrix<Scalar, states, states>;

  struct Settings {
    Scalar curvature{};                   ///< deviation of the slope's change over depth, (N/m)/sqrt(m)
    Scalar damping_change{};              ///< deviation from one damper to the next, N s/m
    Scalar most_slope{}, most_damping{};  ///< N/m, N s/m
  };

  TissueBelief(const Settings& settings, const Law& about) noexcept : law{about}, settings_{settings} {}

  Law law;
  State s = State::Zero();
  Covariance P = Covariance::Zero();

  /// Of a coefficient about the straight line through the two beside it, N^2.
  [[nodiscard]] Scalar bend_variance() const noexcept {
    const Scalar& h = law.knots().spacing();
    return settings_.curvature * settings_.curvature * h * h * h;
  }

  /// Nothing is known any more.
  void forget(const Law& about) noexcept {
    law = about;
    s.setZero();
    P.setZero();
  }

  /// Makes the law hold for depths from `low` to `high`, m.
  void extend(const Scalar& low, const Scalar& high) noexcept {
    auto& knots = law.knots();
    const auto needed = [&] {
      const int l = std::min(knots.low(), SplineKnots<Scalar>::cell(low / knots.spacing()) - 1);
      const int h = std::max(knots.high(), SplineKnots<Scalar>::cell(high / knots.spacing()) + 2);
      return std::pair{l, h};
    };
    for (int i = 0; i < 6 && needed().second - needed().first + 1 > Law::most_coefficients; ++i) coarsen();
    const auto [l, h] = needed();
    while (knots.high() < h && knots.count() < Law::most_coefficients) grow(knots.high(), 1);
    while (knots.low() > l && knots.count() < Law::most_coefficients) grow(knots.low(), -1);
    auto& dampers = law.dampers();
    const Scalar& width = law.settings().damper_spacing;
    const int dl = SplineKnots<Scalar>::cell(low / width), dh = SplineKnots<Scalar>::cell(high / width) + 1;
    while (dampers.high < dh && dampers.high - dampers.low + 1 < Law::most_dampers) grow_damper(dampers.high, 1);
    while (dampers.low > dl && dampers.high - dampers.low + 1 < Law::most_dampers) grow_damper(dampers.low, -1);
  }

  /// What is learnt from three measurements at once, but not yet taken out of P: P less P H S^-1 H' P.
  struct Conditioned {
    const Rows &H, &PH;
    const Cholesky3<Scalar>& S;
  };

  /// Takes slopes, dampings, friction and branches of x to the nearest physical ones in P's metric, x - s = P u.
  void keep_physical(State& x, State& u) const noexcept { keep_physical(x, u, nullptr); }
  /// The same in the metric of the conditioned P: what the measurements say of x stays.
  void keep_physical(State& x, State& u, const Conditioned& to) const noexcept { keep_physical(x, u, &to); }

  /// P + factor v v'. Of the same products in either triangle: P stays symmetric to the last bit.
  void add_rank_one(const State& v, const Scalar& factor) noexcept {
    for (int j = 0; j < states; ++j) P.col(j) += (v * v[j]) * factor;
  }

  /// P H of three measurements, by the columns of P that have a say.
  void project_rows(const Rows& H, Rows& PH) const noexcept {
    PH.setZero();
    for (int i = 0; i < states; ++i) {
      if (H(i, 0) == Scalar{0} && H(i, 1) == Scalar{0} && H(i, 2) == Scalar{0}) continue;
      for (int k = 0; k < 3; ++k) PH.col(k) += P.col(i) * H(i, k);
    }
  }

 private:
  // A number that is bounded: the entry at `place`, less that at `from`, where there is one.
  struct Bounded {
    int place, from;
    [[nodiscard]] Scalar of(const State& x) const noexcept { return from < 0 ? x[place] : x[place] - x[from]; }
  };

  void keep_physical(State& x, State& u, const Conditioned* to) const noexcept {
    const Scalar &h = law.knots().spacing(), most_rise = settings_.most_slope * h;
    for (int pass = 0; pass < 3; ++pass) {
      bool any = false;
      for (int j = law.knots().low(); j < law.knots().high(); ++j) {
        any |= keep_within({Law::coefficient(j + 1), Law::coefficient(j)}, Scalar{0}, most_rise, h, x, u, to);
      }
      for (int i = 0; i < Law::branches; ++i) {
        (void)keep_within({Law::first_branch + i, -1}, Scalar{0}, settings_.most_slope, Scalar{0}, x, u, to);
      }
      (void)keep_within({Law::friction, -1}, Scalar{0}, settings_.most_slope, Scalar{0}, x, u, to);
      for (int j = law.dampers().low; j <= law.dampers().high; ++j) {
        any |= keep_within({Law::damper(j), -1}, Scalar{0}, settings_.most_damping, Scalar{0}, x, u, to);
      }
      if (!any) break;
    }
  }

  // Whether x had to be moved; up to `loose` beyond a bound it is let be.
  [[nodiscard]] bool keep_within(const Bounded& number, const Scalar& least, const Scalar& most, const Scalar& loose,
                                 State& x, State& u, const Conditioned* to) const noexcept {
    const Scalar value = number.of(x);
    if (value >= least - loose && value <= most + loose) return false;
    State direction = P.col(number.place);
    if (number.from >= 0) direction -= P.col(number.from);
    Eigen::Matrix<Scalar, 3, 1> known = Eigen::Matrix<Scalar, 3, 1>::Zero();
    const Scalar before = number.of(direction);
    if (to != nullptr) {
      const auto row = [&](int i) { return Eigen::Matrix<Scalar, 3, 1>(to->PH.row(i).transpose()); };
      known = to->S.solve(number.from < 0 ? row(number.place) : row(number.place) - row(number.from));
      direction -= to->PH * known;
    }
    const Scalar variance = number.of(direction), nothing(Scalar(1) / Scalar(1'000'000'000'000));
    if (!(variance > nothing * h_squared(number)) || !(variance > before * nothing)) return false;
    const Scalar by = (std::clamp(value, least, most) - value) / variance;
    x += direction * by;
    u[number.place] += by;
    if (number.from >= 0) u[number.from] -= by;
    if (to != nullptr) u -= to->H * (known * by);
    return true;
  }
  // Variances of slopes are compared as such.
  [[nodiscard]] Scalar h_squared(const Bounded& number) const noexcept {
    return number.from < 0 ? Scalar{1} : law.knots().spacing() * law.knots().spacing();
  }

  // A parameter that is a sum of others, and a variance of its own.
  void derive(int place, const Scalar& a, int first, const Scalar& b, int second, const Scalar& variance) noexcept {
    s[place] = a * s[first] + b * s[second];
    State row = a * P.col(first) + b * P.col(second);
    row[place] = a * row[first] + b * row[second] + variance;
    P.col(place) = row;
    P.row(place) = row.transpose();
  }

  void grow(int edge, int direction) noexcept {
    derive(Law::coefficient(edge + direction), Scalar{2}, Law::coefficient(edge), Scalar{-1},
           Law::coefficient(edge - direction), bend_variance());
    if (direction > 0) {
      law.knots().extend_up();
    } else {
      law.knots().extend_down();
    }
  }

  void grow_damper(int edge, int direction) noexcept {
    derive(Law::damper(edge + direction), Scalar{1}, Law::damper(edge), Scalar{0}, Law::damper(edge),
           settings_.damping_change * settings_.damping_change);
    (direction > 0 ? law.dampers().high : law.dampers().low) += direction;
  }

  // Twice the spacing: coefficients from the curve at the knots that stay, c_j = (8 f_j - f_j-1 - f_j+1)/6, which is
  // exact for cubics. Rare.
  void coarsen() noexcept {
    auto& knots = law.knots();
    const int low = knots.inner_low_of_coarse(), last = knots.inner_high_of_coarse();
    const int count = std::max(last, low + 1) - low + 3;
    const SplineKnots<Scalar> fine = knots;
    // rows of the map from fine to coarse coefficients: at most nine entries about 2 J
    const auto add_value = [&](int J, const Scalar& weight, Weights& to) {
      for (int k = -1; k <= 1; ++k) {
        to[std::size_t(2 * J + k - fine.low())] += weight * (k == 0 ? Scalar(4) : Scalar(1)) / Scalar(6);
      }
    };
    // beyond the outermost ones along the tangent there, (c_j+1 - c_j-1)/2 a spacing
    const auto add_straight = [&](int J, const Scalar& weight, Weights& to) {
      const int inside = std::clamp(J, low, last);
      const Scalar beyond(J - inside);
      add_value(inside, weight, to);
      to[std::size_t(2 * inside + 1 - fine.low())] += beyond * weight;
      to[std::size_t(2 * inside - 1 - fine.low())] -= beyond * weight;
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
    const Weights c = mapped([&](int k) { return s[k]; });
    for (int column = 0; column < states; ++column) {
      const Weights m = mapped([&](int k) { return P(k, column); });
      P.col(column).template tail<Law::most_coefficients>().setZero();
      for (int i = 0; i < count; ++i) P(Law::first_coefficient + i, column) = m[std::size_t(i)];
    }
    for (int row = 0; row < states; ++row) {
      const Weights m = mapped([&](int k) { return P(row, k); });
      P.row(row).template tail<Law::most_coefficients>().setZero();
      for (int i = 0; i < count; ++i) P(row, Law::first_coefficient + i) = m[std::size_t(i)];
    }
    s.template tail<Law::most_coefficients>().setZero();
    for (int i = 0; i < count; ++i) s[Law::first_coefficient + i] = c[std::size_t(i)];
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
    turn([&](int i) -> Scalar& { return s[i]; });
    for (int k = 0; k < states; ++k) turn([&](int i) -> Scalar& { return P(i, k); });
    for (int k = 0; k < states; ++k) turn([&](int i) -> Scalar& { return P(k, i); });
    for (int i = 0; i < count; ++i) {
      const int place = Law::coefficient(low + i);
      P(place, place) += bend_variance() / Scalar(10000);
    }
    P = ((P + P.transpose()) / Scalar{2}).eval();
  }

  Settings settings_;
  std::array<int, std::size_t(Law::most_coefficients)> order_{};
  std::array<Weights, std::size_t(Law::most_coefficients)> map_{};
};

}  // namespace limpid
