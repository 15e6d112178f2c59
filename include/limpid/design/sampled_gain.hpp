// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/convex_polygon.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/sampled_worst.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace limpid {

/// A gain and the spectral radius that it comes to.
template <Real Scalar = double>
struct SampledGain {
  Gain<Scalar> gain = Gain<Scalar>::Zero();
  Scalar radius{0};
};

/// A gain for a whole box of tissues.
template <Real Scalar = double>
struct RobustSampledGain {
  Gain<Scalar> gain = Gain<Scalar>::Zero();
  Scalar worst_radius{0};  ///< proved: no tissue of the box has a larger one; infinite where nothing was proved
  WorstRadius<Scalar> worst;
};

namespace detail {

/// p(z) of one tissue as it depends on L: p = constant + by_gain L'.
template <Real Scalar>
struct AffinePolynomial {
  SampledCoefficients<Scalar> constant;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 2, 0, most_sampled_degree + 1, 2> by_gain;

  AffinePolynomial(const SampledStability<Scalar>& stability, const Tissue<Scalar>& tissue)
      : constant{stability.polynomial(tissue, Gain<Scalar>::Zero())}, by_gain(constant.size(), 2) {
    by_gain.col(0) = stability.polynomial(tissue, Gain<Scalar>(Scalar{1}, Scalar{0})) - constant;
    by_gain.col(1) = stability.polynomial(tissue, Gain<Scalar>(Scalar{0}, Scalar{1})) - constant;
  }
};

/// Search for the gain of smallest worst radius.
template <Real Scalar>
class GainSearch {
 public:
  using Point = Eigen::Matrix<Scalar, 2, 1>;  // (p_1, p_0) of the reference tissue

  GainSearch(const SampledSystem<Scalar>& system, const TissueBox<Scalar>& box)
      : system_{system},
        stability_{system},
        box_{box},
        convex_{!(system.fraction() > Scalar{0}) && system.periods() <= 1} {
    set_reference();
  }

  /// For a box of one tissue and a delay of zero or a period: the gain with all roots alike.
  [[nodiscard]] Gain<Scalar> equal_roots() const { return gain_at(middle()); }
  [[nodiscard]] bool movable() const { return convex_ && is_finite(middle()) && independence_ > Scalar{0}; }

  [[nodiscard]] Gain<Scalar> run() {
    consider(Gain<Scalar>::Zero());
    consider(equal_roots());
    if (!(best_.found < std::numeric_limits<Scalar>::infinity())) return L_;
    if (convex_) {
      cut();
      return L_;
    }
    std::array<Gain<Scalar>, 3> starts{L_, L_, L_};
    for (int periods : {0, 1}) {
      SampledSystem<Scalar> near = system_;
      near.delay = system_.period * Scalar(periods);
      starts[static_cast<std::size_t>(periods)] = GainSearch(near, box_).run();
    }
    for (const Gain<Scalar>& start : starts) creep(start);
    return L_;
  }

 private:
  static constexpr int most_cuts = 250;
  static constexpr int most_rounds = 300;
  static constexpr int most_halvings = 30;

  // Among the corners and the centre, the one whose polynomial L moves best.
  void set_reference() {
    using std::abs;
    for (const auto& [x, y] : {std::array{1, 1}, {0, 0}, {0, 2}, {2, 0}, {2, 2}}) {
      const AffinePolynomial<Scalar> p(stability_, tissue_at(box_, Scalar(x) / Scalar{2}, Scalar(y) / Scalar{2}));
      Eigen::Matrix<Scalar, 2, 2> slopes;
      slopes << p.by_gain.row(1), p.by_gain.row(0);
      const Scalar independence = abs(slopes.determinant()) / slopes.squaredNorm();
      if (!(independence > independence_)) continue;
      independence_ = independence;
      slopes_ = slopes;
      reference_ << p.constant[1], p.constant[0];
      trace_ = -p.constant[p.constant.size() - 2];
      degree_ = static_cast<int>(p.constant.size()) - 1;
    }
  }

  [[nodiscard]] Gain<Scalar> gain_at(const Point& y) const {
    const Point L = slopes_.partialPivLu().solve(y - reference_);
    return is_finite(L) ? Gain<Scalar>(L.transpose()) : Gain<Scalar>(Gain<Scalar>::Zero());
  }

  // p of the reference with all roots alike.
  [[nodiscard]] Point middle() const {
    if (degree_ == 2) return Point::Zero();
    const Scalar root = trace_ / Scalar{3};
    return degree_ == 3 ? Point(Scalar{3} * root * root, -root * root * root) : Point::Zero();
  }

  WorstRadius<Scalar> consider(const Gain<Scalar>& L) {
    const WorstRadius<Scalar> worst = WorstTissueSearch<Scalar>(stability_, box_, L).run();
    if (worst.found < best_.found) {
      best_ = worst;
      L_ = L;
    }
    return worst;
  }

  // The worst radius; infinite where a tissue that was the worst before shows that it is not below `held`.
  Scalar worst_below(const Gain<Scalar>& L, const Scalar& held) {
    for (const Tissue<Scalar>& tissue : worst_tissues_) {
      if (!(stability_.radius(tissue, L) < held)) return std::numeric_limits<Scalar>::infinity();
    }
    const WorstRadius<Scalar> worst = consider(L);
    if (!(worst.found < held)) worst_tissues_.push_back(worst.tissue);
    return worst.found;
  }

  // For one tissue the gains with all roots below rho are convex, bounded by a parabola and lines: so the worst radius
  // is quasiconvex in L, and beyond the tangent at any L, to the side where a condition gets worse, nothing is better.
  // The centre of gravity of what remains leaves at most 63 % of its area.
  void cut() {
    const Scalar r = best_.found;
    const Point most = degree_ == 2 ? Point(Scalar{2} * r, r * r) : Point(Scalar{3} * r * r, r * r * r);
    ConvexPolygon<Scalar> rest(-most, most);
    for (int i = 0; i < most_cuts && rest.area() > Scalar{0}; ++i) {
      const Point y = rest.centre_of_gravity();
      const Gain<Scalar> L = gain_at(y);
      const WorstRadius<Scalar> worst = consider(L);
      const Point inward = slopes_.transpose().partialPivLu().solve(better_direction(worst, L));
      if (!is_finite(inward)) return;
      rest.keep(y, inward);
    }
  }

  // Gradient by L of the condition of Jury that holds with equality at the worst radius.
  [[nodiscard]] Point better_direction(const WorstRadius<Scalar>& worst, const Gain<Scalar>& L) const {
    using std::abs;
    const AffinePolynomial<Scalar> affine(stability_, worst.tissue);
    Eigen::Matrix<Scalar, 3, 1> p = Eigen::Matrix<Scalar, 3, 1>::Zero();  // of z^2, z and 1; a z more where degree 2
    Eigen::Matrix<Scalar, 3, 2> slope = Eigen::Matrix<Scalar, 3, 2>::Zero();
    Scalar power{1};
    for (int i = 0; i < degree_; ++i) {
      power *= worst.found;
      p[i] = (affine.constant[degree_ - 1 - i] + affine.by_gain.row(degree_ - 1 - i).dot(L)) / power;
      slope.row(i) = affine.by_gain.row(degree_ - 1 - i) / power;
    }
    const std::array<Scalar, 3> conditions{Scalar{1} + p[0] + p[1] + p[2], Scalar{1} - p[0] + p[1] - p[2],
                                           Scalar{1} - p[1] + p[2] * (p[0] - p[2])};
    const std::array<Point, 3> gradients{
        Point(slope.row(0) + slope.row(1) + slope.row(2)), Point(slope.row(1) - slope.row(0) - slope.row(2)),
        Point(slope.row(0) * p[2] - slope.row(1) + slope.row(2) * (p[0] - Scalar{2} * p[2]))};
    std::size_t active = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (abs(conditions[i]) < abs(conditions[active])) active = i;
    }
    return gradients[active];
  }

  // For other delays nothing is convex: steps in eight directions, turned each round, halved where none leads down. It
  // ends in a local minimum.
  void creep(const Gain<Scalar>& start) {
    using std::cos, std::sin;
    constexpr int directions = 8;
    worst_tissues_.clear();
    Scalar held = consider(start).found;
    Point y = slopes_ * start.transpose() + reference_;
    const Tissue<Scalar> centre = box_.centre();
    const Point scale(system_.tool.stiffness + centre.stiffness, system_.tool.damping + centre.damping);
    Scalar step = Scalar{1} / Scalar{2};
    for (int round = 0, halvings = 0; round < most_rounds && halvings < most_halvings; ++round) {
      bool better = false;
      const Point from = y;
      for (int k = 0; k < directions; ++k) {
        const Scalar angle =
            Scalar{6283185} / Scalar{1000000} * (Scalar(k) + Scalar(round / 2) * golden()) / Scalar(directions);
        const Point along(step * held * cos(angle), step * held * sin(angle));
        // In turn by the coefficients of p and by stiffness and damping.
        const Point by_p(along[0] * held, along[1] * held * held), by_L = slopes_ * scale.cwiseProduct(along);
        const Point trial = from + (round % 2 == 0 ? by_p : by_L);
        const Scalar worst = worst_below(gain_at(trial), held);
        if (!(worst < held)) continue;
        held = worst;
        y = trial;
        better = true;
      }
      if (better || round % 2 == 0) continue;
      step /= Scalar{2};
      ++halvings;
    }
  }

  static Scalar golden() { return Scalar{618} / Scalar{1000}; }

  SampledSystem<Scalar> system_;
  SampledStability<Scalar> stability_;
  TissueBox<Scalar> box_;
  bool convex_;
  Eigen::Matrix<Scalar, 2, 2> slopes_ = Eigen::Matrix<Scalar, 2, 2>::Zero();  // as where L moves nothing
  Point reference_ = Point::Zero();
  Scalar trace_{0}, independence_{-1};
  int degree_{0};
  Gain<Scalar> L_ = Gain<Scalar>::Zero();
  std::vector<Tissue<Scalar>> worst_tissues_;
  WorstRadius<Scalar> best_{std::numeric_limits<Scalar>::infinity(), {}, {}, {}};
};

}  // namespace detail

/// The gain of smallest spectral radius in one tissue.
///
/// Where the delay is a period the three roots, whose sum tr Phi is beyond L's reach, are all tr Phi / 3; without delay
/// they are zero (deadbeat). For other delays it is the local minimum that a fixed search ends in.
/// Off line: a microsecond for delays of zero and one period, else some milliseconds. Where L cannot move the error in
/// two directions (a whole number of half oscillations in a period) it is the result of the search too.
/// @throws std::invalid_argument  where the tissue is not finite or the system refused
template <Real Scalar>
[[nodiscard]] SampledGain<Scalar> smallest_sampled_radius(const SampledSystem<Scalar>& system,
                                                          const Tissue<Scalar>& tissue) {
  const SampledStability<Scalar> stability(system);
  const TissueBox<Scalar> box{tissue, tissue};
  box.check();
  detail::GainSearch<Scalar> search(system, box);
  const Gain<Scalar> L = search.movable() ? search.equal_roots() : search.run();
  return {L, stability.radius(tissue, L)};
}

/// The gain of smallest worst spectral radius over a box of constant tissues, and the proof of that radius. It is never
/// worse than no gain: by the proved radii, or where neither is proved by the worst ones found.
///
/// Where the delay is a period, or none, the worst radius is quasiconvex in L and this is the global minimum, to the
/// accuracy with which multiple roots can be told; for other delays a local one.
/// Off line: some 10 ms for those delays, else up to some seconds.
/// @throws std::invalid_argument  where the box is empty or the system refused
template <Real Scalar>
[[nodiscard]] RobustSampledGain<Scalar> robust_sampled_gain(const SampledSystem<Scalar>& system,
                                                            const TissueBox<Scalar>& box) {
  system.check();
  box.check();
  RobustSampledGain<Scalar> result;
  result.gain = detail::GainSearch<Scalar>(system, box).run();
  result.worst = worst_sampled_radius(system, box, result.gain);
  // The search looks at chosen tissues: in a very wide box the proof finds worse ones that it missed.
  const Gain<Scalar> none = Gain<Scalar>::Zero();
  const SampledStability<Scalar> stability(system);
  if (!(result.worst.proved <= detail::WorstTissueSearch<Scalar>(stability, box, none).run().found)) {
    const WorstRadius<Scalar> without = worst_sampled_radius(system, box, none);
    const bool same = without.proved == result.worst.proved;
    if (same ? without.found < result.worst.found : without.proved < result.worst.proved) {
      result.gain = none;
      result.worst = without;
    }
  }
  result.worst_radius = result.worst.proved;
  return result;
}

}  // namespace limpid
