// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_select.hpp>
#include <limpid/estimation/any_above.hpp>
#include <limpid/estimation/exponential_mean.hpp>
#include <limpid/estimation/information_series.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <limits>

namespace limpid {

/// Exact solution of the least squares law (4.44)-(4.46) over t seconds with phi and F constant, lane by lane.
///
/// With s = phi' Gamma phi and eps = phi' theta_hat - F at the start, Gamma^-1 obeys (Gamma^-1)' = -alpha Gamma^-1 +
/// phi phi' / (1 + nu phi' Gamma phi), and exp(alpha t) Gamma^-1 theta_tilde is constant, hence
///
///     Gamma(t)     = T (Gamma - Gamma phi phi' Gamma u / (1 + s u))
///     theta_hat(t) = theta_hat - Gamma phi eps u / (1 + s u)
///
/// T = exp(alpha t) and u, the information gathered, in seconds, follows from l = ln(1 + s u), p = alpha nu:
///
///     (exp(l) - exp(p l)) / (1 - p) + nu s (exp(p l) - 1) / p = s (T - 1) / alpha
///
/// For small z = s (T - 1) / (alpha (1 + nu s)) the solution is a series in z, set up for the alpha constructed with
/// and for alpha = 0. Else: the left side grows and is convex in l, so that Newton's iteration from above falls onto
/// the root. It runs on the ratio of l to its bound z, which is 1 at s = 0: no case is apart.
template <typename Array>
class LeastSquaresFlow {
 public:
  using Scalar = typename Array::Scalar;

  /// @param alpha  forgetting, 1/s, >= 0
  /// @param nu     normalisation, s, >= 0, with alpha nu < 1
  LeastSquaresFlow(const Scalar& alpha, const Scalar& nu) noexcept
      : nu_{nu},
        series_{Scalar(alpha * nu)},
        series_at_rest_{Scalar{0}},
        longest_{std::min(series_.most(), series_at_rest_.most())} {}

  /// How a step's forgetting compares with alpha as constructed, in all lanes.
  enum class Extent { whole, whole_or_none, any };

  /// Forgetting over a step, by lanes.
  struct Forgetting {
    Array exponent;                                                                      ///< alpha t, >= 0
    Array mean;                                                                          ///< of exp over [0, alpha t]
    Extent extent = Extent::whole;                                                       ///< of the exponent
    [[nodiscard]] Array growth() const noexcept { return Scalar{1} + exponent * mean; }  ///< T
  };

  /// Information u, s, gathered along phi over a step.
  /// @param t   length of the step, s, > 0
  /// @param s   phi' Gamma phi, 1/s, >= 0
  [[nodiscard]] Array information(const Forgetting& forgetting, const Scalar& t, const Array& s) const noexcept {
    const Array tau = forgetting.mean * t, reach = s * tau;  // (T - 1) / alpha
    const Array inverse = (Scalar{1} + nu_ * s).inverse();
    const Array z = reach * inverse;
    if constexpr (InformationSeries<Array>::exists) {
      if (!any_above(z, longest_) && forgetting.extent != Extent::any) [[likely]] {
        const Array by_series = tau * inverse * series_(z, inverse);
        if (forgetting.extent == Extent::whole) [[likely]]
          return by_series;
        return where_positive<Array>(forgetting.exponent, by_series, tau * inverse * series_at_rest_(z, inverse));
      }
    }
    return iterated(forgetting, t, s);
  }

  /// The same by Newton's iteration, whatever z.
  [[nodiscard]] Array iterated(const Forgetting& forgetting, const Scalar& t, const Array& s) const noexcept {
    const Array tau = forgetting.mean * t;
    const Array p = forgetting.exponent * (nu_ / t), w = Scalar{1} + nu_ * s;
    const Array inverse = w.inverse();
    const Array z = s * tau * inverse;
    const Equation equation{p, w, z};
    Array whole;
    if (!any_above(z, Scalar(detail::short_argument))) [[likely]] {
      whole = equation.solve(equation.series(inverse), ShortMean{});
    } else {
      whole = equation.solve(bounds(s * tau, z), Mean{});
    }
    return tau * inverse * whole;
  }

 private:
  static constexpr int most_steps = 64;

  struct ShortMean {
    EIGEN_ALWAYS_INLINE Array operator()(const Array& x) const noexcept { return short_exponential_mean(x); }
  };
  struct Mean {
    Array operator()(const Array& x) const noexcept { return exponential_mean(x); }
  };

  // Of l / z: l <= z, and l <= ln(1 + s tau).
  static Array bounds(const Array& target, const Array& z) noexcept {
    using std::log1p;
    const Array logarithm = target.unaryExpr([](const Scalar& a) { return Scalar(log1p(a)); });
    return (z > Scalar{0}).select((logarithm / z).min(Scalar{1}), Array::Ones());
  }

  struct Equation {
    const Array &p, &w, &z;  // alpha nu, 1 + nu s, the bound on l

    // l / z by its series in z, to the fourth term.
    EIGEN_ALWAYS_INLINE Array series(const Array& inverse) const noexcept {
      const Array pp = p * p;
      const Array a2 = (inverse + p) * (Scalar{1} / Scalar{2});
      const Array a3 = ((Scalar{1} + p) * inverse + pp) * (Scalar{1} / Scalar{6});
      const Array a4 = ((Scalar{1} + p + pp) * inverse + pp * p) * (Scalar{1} / Scalar{24});
      const Array c2 = Scalar{2} * a2 * a2 - a3;
      const Array c3 = Scalar{5} * a2 * (a3 - a2 * a2) - a4;
      return Scalar{1} + z * (z * (c2 + z * c3) - a2);
    }

    // Newton's iteration for l / z from `ratio`; returns (exp(l) - 1) / z at the root.
    template <typename F>
    EIGEN_ALWAYS_INLINE Array solve(const Array& start, F mean) const noexcept {
      const Scalar rounding = std::numeric_limits<Scalar>::epsilon() / Scalar{2};
      Array ratio, whole;
      ratio = start;
      for (int i = 0; i < most_steps; ++i) {
        const Array l = z * ratio, pl = p * l;
        const Array slow = mean(pl);
        const Array growth = Scalar{1} + pl * slow;       // exp(p l)
        const Array fast = growth * mean(Array(l - pl));  // (exp(l) - exp(p l)) / (l - p l)
        const Array miss = w - ratio * (fast + (w - Scalar{1}) * slow);
        const Array step = miss / (l * fast + w * growth);
        const Array here = ratio * (fast + p * (slow - fast));  // (exp(l) - 1) / z before the step
        whole = here + (Scalar{1} + z * here) * step;
        const Array next = z * step * step;  // about what one step more would do
        ratio += step;
        if (!any_above(Array(next - rounding * ratio), Scalar{0})) break;
      }
      return whole;
    }
  };

  Scalar nu_;
  InformationSeries<Array> series_, series_at_rest_;
  Scalar longest_;  // z of both
};

}  // namespace limpid
