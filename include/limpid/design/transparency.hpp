// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/bracketed_root.hpp>
#include <limpid/design/transparency_index.hpp>
#include <limpid/design/transparency_problem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace limpid {

/// The gains of smallest J.
template <Real Scalar = double>
struct TransparencyOptimum {
  WallFeedback<Scalar> gain{};
  TransparencyIndex<Scalar> index{};  ///< its verdict is `finite` where an optimum was found
  HinfNorm<Scalar> norm{};            ///< ||L||_inf of it: at most one where (17) holds
};

namespace detail {

/// Gains B_c to search, four an octave, from far below to far above those that the units make, m/T and sqrt(K_c m),
/// where the scalar has such numbers; fewer where these are a hundred octaves apart.
template <Real Scalar>
[[nodiscard]] std::vector<Scalar> gains_to_search(const TransparencyProblem<Scalar>& problem, const Scalar& K_c) {
  using std::exp, std::log;
  const Scalar by_mass = log(problem.plant.mass) - log(problem.period),
               by_stiffness = (log(K_c) + log(problem.plant.mass)) / Scalar{2}, far = log(Scalar(256)),
               least = log(std::numeric_limits<Scalar>::min()) + far,
               most = log(std::numeric_limits<Scalar>::max()) - Scalar{2} * far;
  const Scalar from = std::clamp<Scalar>(std::min<Scalar>(by_mass, by_stiffness), least, most) - far,
               to = std::clamp<Scalar>(std::max<Scalar>(by_mass, by_stiffness), least, most) + far;
  const Scalar step = std::max<Scalar>(log(Scalar{2}) / Scalar{4}, (to - from) / Scalar(400));
  std::vector<Scalar> gains;
  for (Scalar at = from; at <= to; at += step) gains.push_back(exp(at));
  return gains;
}

/// The gain B_c at which dJ/dB_c = 0 for a given K_c, about the smallest J of the search; J infinite where there is
/// none.
template <Real Scalar>
[[nodiscard]] TransparencyOptimum<Scalar> best_damping(const TransparencyProblem<Scalar>& problem, const Scalar& K_c) {
  const auto gains = gains_to_search(problem, K_c);
  const auto at = [&](const Scalar& B_c) { return index_slopes(problem, WallFeedback<Scalar>{K_c, B_c}); };
  std::size_t best = 0;
  IndexSlopes<Scalar> lowest{infinity_of<Scalar>()};
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const auto found = at(gains[i]);
    if (i > 0 && !(found.J < lowest.J)) continue;
    best = i;
    lowest = found;
  }
  Scalar B_c = gains[best];
  if (lowest.verdict == NormVerdict::finite && best > 0 && best + 1 < gains.size()) {
    // Where the loop is not stable J rises to it from the stable side.
    const Scalar steep = lowest.J / B_c;
    const auto slope = [&](const Scalar& x) -> Scalar {
      const auto here = at(x);
      if (here.verdict == NormVerdict::finite) return here.by_B_c;
      return x < gains[best] ? Scalar(-steep) : steep;
    };
    const Scalar a = slope(gains[best - 1]), b = slope(gains[best + 1]);
    if (a < Scalar{0} && b > Scalar{0}) B_c = bracketed_root(slope, gains[best - 1], a, gains[best + 1], b);
  }
  const auto found = at(B_c);
  return {{K_c, B_c}, {found.J, found.error, found.verdict}, no_hinf_norm<Scalar>(found.verdict)};
}

/// Newton's method on the slopes of J by the logarithms of both gains; the second derivatives as differences.
template <Real Scalar>
class FreeOptimum {
 public:
  using Point = Eigen::Matrix<Scalar, 2, 1>;

  explicit FreeOptimum(const TransparencyProblem<Scalar>& problem) : problem_{problem} {}

  [[nodiscard]] WallFeedback<Scalar> from(const WallFeedback<Scalar>& start) const {
    using std::log, std::sqrt;
    Point x(log(start.K_c), log(start.B_c));
    Here here = at(x);
    for (int step = 0; step < most_steps && here.finite; ++step) {
      const Point direction = descent(x, here.slope);
      Scalar length = std::min<Scalar>(Scalar{1}, Scalar{1} / direction.norm());
      Here next = at(Point(x + length * direction));
      // Close to the end J no longer tells; there the slope does.
      for (int halvings = 0; halvings < 40 && !better(next, here); ++halvings) {
        length /= Scalar{2};
        next = at(Point(x + length * direction));
      }
      if (!better(next, here)) break;
      x += length * direction;
      here = next;
    }
    return gain(x);
  }

 private:
  static constexpr int most_steps = 100;

  struct Here {
    bool finite;
    Scalar J;
    Point slope;
  };

  static WallFeedback<Scalar> gain(const Point& x) {
    using std::exp;
    return {exp(x[0]), exp(x[1])};
  }

  [[nodiscard]] Here at(const Point& x) const {
    const WallFeedback<Scalar> C = gain(x);
    if (!is_finite(C.K_c) || !is_finite(C.B_c)) return {false, infinity_of<Scalar>(), Point::Zero()};
    const auto index = index_slopes(problem_, C);
    return {index.verdict == NormVerdict::finite, index.J, Point(C.K_c * index.by_K_c, C.B_c * index.by_B_c)};
  }

  static bool better(const Here& a, const Here& b) {
    const Scalar same = Scalar(1024) * std::numeric_limits<Scalar>::epsilon() * b.J;
    if (!a.finite) return false;
    return a.J < b.J - same || (a.J < b.J + same && a.slope.squaredNorm() < b.slope.squaredNorm());
  }

  [[nodiscard]] Point descent(const Point& x, const Point& slope) const {
    using std::cbrt;
    const Scalar h = cbrt(std::numeric_limits<Scalar>::epsilon());
    Eigen::Matrix<Scalar, 2, 2> H;
    for (int i = 0; i < 2; ++i) {
      const Point e = h * Point::Unit(i);
      const Here above = at(Point(x + e)), below = at(Point(x - e));
      if (!above.finite || !below.finite) return -slope;
      H.col(i) = (above.slope - below.slope) / (Scalar{2} * h);
    }
    const Scalar mixed = (H(0, 1) + H(1, 0)) / Scalar{2}, determinant = H(0, 0) * H(1, 1) - mixed * mixed;
    if (!(determinant > Scalar{0}) || !(H(0, 0) > Scalar{0})) return -slope;
    return Point(mixed * slope[1] - H(1, 1) * slope[0], mixed * slope[0] - H(0, 0) * slope[1]) / determinant;
  }

  TransparencyProblem<Scalar> problem_;
};

/// ||L||_inf without the proof of its upper bound.
template <Real Scalar>
[[nodiscard]] Scalar attained_norm(const TransparencyProblem<Scalar>& problem, const WallFeedback<Scalar>& C) {
  if (problem.hold != HoldModel::exact) return uncertainty_norm(problem, C).norm;
  const ExactHoldLoop<Scalar> loop(problem, C);
  return loop.is_stable() ? loop.peak().value : infinity_of<Scalar>();
}

/// Where f, with one minimum from a to b, first comes to zero or below in a golden section search; else its minimum.
template <Real Scalar, typename Function>
[[nodiscard]] Scalar first_not_above_zero(const Function& f, Scalar a, Scalar b) {
  using std::sqrt;
  const Scalar golden = (sqrt(Scalar(5)) - Scalar{1}) / Scalar{2};
  Scalar left = b - golden * (b - a), right = a + golden * (b - a), f_left = f(left), f_right = f(right);
  for (int i = 0; i < 40 && f_left > Scalar{0} && f_right > Scalar{0}; ++i) {
    if (f_left < f_right) {
      b = right, right = left, f_right = f_left;
      left = b - golden * (b - a);
      f_left = f(left);
    } else {
      a = left, left = right, f_left = f_right;
      right = a + golden * (b - a);
      f_right = f(right);
    }
  }
  return f_left < f_right ? left : right;
}

}  // namespace detail

/// The gain B_c of smallest J with K_c = K, which keeps the place of the hand in the wall exact at rest: the best of a
/// search over B_c, then the root of dJ/dB_c, to rounding (J itself is flat there and would tell half the digits).
///
/// Off line: some 10 ms (A, B), seconds (C).
/// @throws std::invalid_argument  where the problem is refused
template <Real Scalar>
[[nodiscard]] TransparencyOptimum<Scalar> transparency_optimum(const TransparencyProblem<Scalar>& problem) {
  problem.check();
  auto best = detail::best_damping(problem, problem.wall.stiffness);
  if (best.index.verdict == NormVerdict::finite) best.norm = uncertainty_norm(problem, best.gain);
  return best;
}

/// The gains of smallest J with both free. With them the hand sinks in by K/K_c of what the wall would let it: the
/// paper sets K_c = K and says that J is else unbounded, which holds for a weight with 1/s^2 only.
///
/// A search over K_c from K/16 to 64 K, with the hold A for the exact one, starts Newton's method: a local minimum.
/// @throws std::invalid_argument  where the problem is refused
template <Real Scalar>
[[nodiscard]] TransparencyOptimum<Scalar> free_transparency_optimum(const TransparencyProblem<Scalar>& problem) {
  TransparencyOptimum<Scalar> best = transparency_optimum(problem);
  TransparencyProblem<Scalar> rational = problem;
  if (problem.hold == HoldModel::exact) rational.hold = HoldModel::second_order;
  WallFeedback<Scalar> start = best.gain;
  Scalar lowest = detail::infinity_of<Scalar>();
  for (Scalar part = Scalar{1} / Scalar(16); part < Scalar(65); part *= Scalar{2}) {
    const Scalar K_c = problem.wall.stiffness * part;
    if (!is_finite(K_c)) break;
    const auto found = detail::best_damping(rational, K_c);
    if (!(found.index.J < lowest)) continue;
    lowest = found.index.J;
    start = found.gain;
  }
  const detail::FreeOptimum<Scalar> search(problem);
  for (const WallFeedback<Scalar>& from : {start, best.gain}) {
    const WallFeedback<Scalar> C = search.from(from);
    const auto index = transparency_index(problem, C);
    if (index.J < best.index.J) best = {C, index, uncertainty_norm(problem, C)};
  }
  return best;
}

/// The B_c about the one of smallest ||L||_inf for which the nominal loop is stable and ||L||_inf <= 1, (17), given
/// K_c; the ends to rounding. An end that is not within 256 times the gains of the units, m/T and sqrt(K_c m), is given
/// as the last gain of the search. Theorem 1 is sufficient, not necessary: Delta is real. And it speaks of the loop
/// without sampling: the true limits are in sampled_wall.hpp.
///
/// Off line: some 100 ms.
/// @throws std::invalid_argument  where the problem is refused or K_c is not positive and finite
template <Real Scalar>
[[nodiscard]] GainInterval<Scalar> robust_interval(const TransparencyProblem<Scalar>& problem, const Scalar& K_c) {
  problem.check();
  expect(is_finite(K_c) && K_c > Scalar{0}, "robust_interval: K_c", "finite and > 0", K_c);
  const auto excess = [&](const Scalar& B_c) -> Scalar {
    const Scalar norm = detail::attained_norm(problem, WallFeedback<Scalar>{K_c, B_c});
    return std::min<Scalar>(norm, Scalar{2}) - Scalar{1};
  };
  const auto gains = detail::gains_to_search(problem, K_c);
  std::vector<Scalar> excesses;
  for (const Scalar& B_c : gains) excesses.push_back(excess(B_c));
  const auto best = static_cast<std::size_t>(std::min_element(excesses.begin(), excesses.end()) - excesses.begin());
  std::size_t first = best, last = best;
  while (first > 0 && !(excesses[first] > Scalar{0})) --first;
  while (last + 1 < gains.size() && !(excesses[last] > Scalar{0})) ++last;
  Scalar inside = gains[best], least = excesses[best];
  if (least > Scalar{0}) {  // an interval that fits between gains of the search?
    first = best > 0 ? best - 1 : best;
    last = std::min(best + 1, gains.size() - 1);
    inside = detail::first_not_above_zero(excess, gains[first], gains[last]);
    least = excess(inside);
    if (least > Scalar{0}) return {};
  }
  const auto end = [&](std::size_t i) -> Scalar {
    if (!(excesses[i] > Scalar{0})) return gains[i];
    return detail::bracketed_root(excess, inside, least, gains[i], excesses[i]);
  };
  return {end(first), end(last)};
}

}  // namespace limpid
