// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>
#include <limpid/design/haptic_wall.hpp>
#include <limpid/design/sampled_wall.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace limpid {

namespace detail {

/// The gains B for which a root of p_0(z) + B p_1(z) lies on the circle |z| = r: only there can the number of roots
/// inside change.
///
/// On z = e^(j theta), with both polynomials scaled so that r = 1, B is real where Im(p_0 conj p_1) = 0. That is
///
///     sum_k r_k sin(k theta) = sin(theta) sum_k r_k U_(k-1)(cos theta),   r_k = sum_j (a_(j+k) c_j - a_j c_(j+k)),
///
/// a polynomial in cos(theta), whose roots are eigenvalues of its colleague matrix, all at once.
template <Real Scalar>
class CircleCrossings {
 public:
  using Coefficients = WallCoefficients<Scalar>;

  CircleCrossings(Coefficients a, Coefficients c, const Scalar& r) : a_{std::move(a)}, c_{std::move(c)} {
    Scalar power{1};
    for (Eigen::Index i = 0; i < a_.size(); ++i, power *= r) {
      a_[i] *= power;
      c_[i] *= power;
    }
  }

  /// Rising; also some that are not crossings.
  [[nodiscard]] std::vector<Scalar> gains() const {
    using std::acos, std::clamp;
    std::vector<Scalar> found;
    const auto add = [&](const Scalar& theta) {
      const Scalar gain = at(theta);
      if (is_finite(gain)) found.push_back(gain);
    };
    add(Scalar{0});
    add(acos(Scalar{-1}));
    for (const Scalar& x : cosines()) add(polished(acos(clamp<Scalar>(x, Scalar{-1}, Scalar{1}))));
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  struct Point {
    Scalar re, im;
  };
  static Point value(const Coefficients& p, const Scalar& theta) {
    using std::cos, std::sin;
    Point sum{Scalar{0}, Scalar{0}};
    for (Eigen::Index i = 0; i < p.size(); ++i) {
      const Scalar angle = Scalar(static_cast<int>(i)) * theta;
      sum.re += p[i] * cos(angle);
      sum.im += p[i] * sin(angle);
    }
    return sum;
  }

  // -p_0/p_1, by its real part
  [[nodiscard]] Scalar at(const Scalar& theta) const {
    const Point p0 = value(a_, theta), p1 = value(c_, theta);
    return -(p0.re * p1.re + p0.im * p1.im) / (p1.re * p1.re + p1.im * p1.im);
  }

  [[nodiscard]] Coefficients sines() const {
    const Eigen::Index N = a_.size() - 1;
    Coefficients r = Coefficients::Zero(N + 1);
    for (Eigen::Index k = 1; k <= N; ++k) {
      for (Eigen::Index j = 0; j + k <= N; ++j) r[k] += a_[j + k] * c_[j] - a_[j] * c_[j + k];
    }
    return r;
  }

  // Newton's steps on sum r_k sin(k theta), which only ever come closer to the root.
  [[nodiscard]] Scalar polished(Scalar theta) const {
    using std::abs, std::cos, std::sin;
    const Coefficients r = sines();
    Scalar smallest = std::numeric_limits<Scalar>::infinity(), best = theta;
    for (int i = 0; i < 8; ++i) {
      Scalar f{0}, slope{0};
      for (Eigen::Index k = 1; k < r.size(); ++k) {
        const Scalar n(static_cast<int>(k));
        f += r[k] * sin(n * theta);
        slope += n * r[k] * cos(n * theta);
      }
      if (!(abs(f) < smallest)) break;
      smallest = abs(f);
      best = theta;
      theta -= f / slope;
    }
    return best;
  }

  // Real roots in (-1, 1) of sum_k u_k U_k(x), u_k = r_(k+1), and some that are only near: eigenvalues of
  // 2 x U_k = U_(k-1) + U_(k+1), where U_n is replaced by -sum u_k/u_n U_k.
  [[nodiscard]] std::vector<Scalar> cosines() const {
    using std::abs, std::sqrt;
    const Coefficients r = sines();
    Eigen::Index n = r.size() - 2;
    // Dividing by a small r_n would lose the roots that matter; what it moves them by, Newton's steps mend.
    const Scalar negligible = sqrt(std::numeric_limits<Scalar>::epsilon()) / Scalar{16} * r.cwiseAbs().maxCoeff();
    while (n > 0 && !(abs(r[n + 1]) > negligible)) --n;
    std::vector<Scalar> found;
    if (n <= 0) return found;
    const Scalar half = Scalar{1} / Scalar{2};
    DynamicMatrix<Scalar> colleague = DynamicMatrix<Scalar>::Zero(n, n);
    for (Eigen::Index k = 0; k + 1 < n; ++k) colleague(k, k + 1) = colleague(k + 1, k) = half;
    for (Eigen::Index k = 0; k < n; ++k) colleague(n - 1, k) -= half * r[k + 1] / r[n + 1];
    const Scalar close = Scalar{1} / Scalar{1000};  // a double root may come out as a complex pair
    for (const auto& root : eigenvalues_of<Scalar>(colleague)) {
      if (abs(root.imag()) < close && abs(root.real()) < Scalar{1} + close) found.push_back(root.real());
    }
    return found;
  }

  Coefficients a_, c_;
};

}  // namespace detail

/// Every interval of B_c >= 0 over which the sampled loop with K_c has a spectral radius below `radius`, rising: the
/// ends are where a root meets the circle. Rounded.
///
/// Off line: some 20 us.
/// @throws std::invalid_argument  where a field cannot be used
template <Real Scalar>
[[nodiscard]] std::vector<GainInterval<Scalar>> stable_gains(const SampledWall<Scalar>& loop,
                                                             const HapticPlant<Scalar>& plant, const Scalar& K_c,
                                                             const Scalar& radius = Scalar{1}) {
  loop.check();
  plant.check();
  expect(is_finite(K_c) && K_c > Scalar{0}, "stable_gains: K_c", "finite and > 0", K_c);
  expect(is_finite(radius) && radius > Scalar{0}, "stable_gains: radius", "finite and > 0", radius);
  const auto at = [&](const Scalar& B_c) { return detail::wall_polynomial_of<Scalar>(loop, plant, {K_c, B_c}); };
  const auto p0 = at(Scalar{0});
  // p is affine in B_c; a unit that is about as large as the gains of interest keeps the difference exact enough
  const Scalar unit = plant.mass / loop.period;
  const detail::WallCoefficients<Scalar> p1 = (at(unit) - p0) / unit;
  std::vector<GainInterval<Scalar>> intervals;
  if (!is_finite(p0) || !is_finite(p1)) return intervals;
  std::vector<Scalar> ends{Scalar{0}};
  for (const Scalar& gain : detail::CircleCrossings<Scalar>(p0, p1, radius).gains()) {
    if (gain > ends.back()) ends.push_back(gain);
  }
  const auto stable = [&](const Scalar& B_c) { return detail::roots_inside(at(B_c), radius); };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool last = i + 1 == ends.size();
    const Scalar upper = last ? std::numeric_limits<Scalar>::infinity() : ends[i + 1];
    if (!stable(last ? Scalar{2} * ends[i] + unit : (ends[i] + upper) / Scalar{2})) continue;
    if (!intervals.empty() && intervals.back().upper == ends[i]) {
      intervals.back().upper = upper;
    } else {
      intervals.push_back({ends[i], upper});
    }
  }
  return intervals;
}

}  // namespace limpid
