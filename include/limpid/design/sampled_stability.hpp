// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/largest_root.hpp>
#include <limpid/design/sampled_polynomial.hpp>
#include <limpid/design/second_order_flow.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid {

/// Stability of a predictor in which the error is sampled, delayed and held, exactly: the eigenvalues of the error from
/// one sample to the next. Theorems 2 and 3 do not imply it.
///
/// For constant tissue. Rounded; what is proved of it says `prove_sampled_stability`.
/// @realtime  no allocation and no throw after construction where the delay is at most a period, some 250 flops;
///            otherwise off line
template <Real Scalar = double>
class SampledStability {
 public:
  /// @throws std::invalid_argument  where the system is refused
  explicit SampledStability(const SampledSystem<Scalar>& system) : system_{system} {
    system_.check();
    periods_ = system_.periods();
    fraction_ = system_.fraction();
  }

  [[nodiscard]] int degree() const noexcept { return periods_ + (fraction_ > Scalar{0} ? 3 : 2); }

  /// Coefficients p_0 ... p_N = 1 of the characteristic polynomial.
  [[nodiscard]] detail::SampledCoefficients<Scalar> polynomial(const Tissue<Scalar>& tissue,
                                                               const Gain<Scalar>& L) const noexcept {
    const Scalar kappa = kappa_of(tissue), beta = beta_of(tissue);
    const Gain<Scalar> over_mass = L / system_.tool.mass;
    const auto flow = detail::second_order_flow(kappa, beta, system_.period);
    if (!(fraction_ > Scalar{0})) {
      return detail::sampled_coefficients<Scalar, Scalar>(flow, nullptr, periods_, kappa, over_mass);
    }
    const auto rest = detail::second_order_flow<Scalar>(kappa, beta, system_.period - fraction_);
    return detail::sampled_coefficients<Scalar, Scalar>(flow, &rest, periods_, kappa, over_mass);
  }

  /// Spectral radius: the factor by which the error grows from sample to sample in the long run. Infinite where the
  /// numbers are too large to tell.
  [[nodiscard]] Scalar radius(const Tissue<Scalar>& tissue, const Gain<Scalar>& L) const {
    if (periods_ == 1 && !(fraction_ > Scalar{0})) {
      const auto [a, b, c] = cubic(tissue, L);
      return is_finite(a + b + c) ? detail::largest_root_magnitude(a, b, c) : std::numeric_limits<Scalar>::infinity();
    }
    const auto p = polynomial(tissue, L);
    if (!is_finite(p)) return std::numeric_limits<Scalar>::infinity();
    if (p.size() == 3) return detail::largest_root_magnitude(p[1], p[0]);
    if (p.size() == 4) return detail::largest_root_magnitude(p[2], p[1], p[0]);
    return radius_by_conditions(p);
  }

  /// Whether the radius is below `bound` > 0: by the conditions of Jury, which need no roots.
  [[nodiscard]] bool stable(const Tissue<Scalar>& tissue, const Gain<Scalar>& L,
                            const Scalar& bound = Scalar{1}) const noexcept {
    const auto p = polynomial(tissue, L);
    return is_finite(p) && inside(p, bound);
  }

  /// Takes (e, then the forces L e of the newest sample but one back to the oldest that still acts) from one sample to
  /// the next.
  [[nodiscard]] Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> monodromy(const Tissue<Scalar>& tissue,
                                                                                const Gain<Scalar>& L) const {
    const Scalar kappa = kappa_of(tissue), beta = beta_of(tissue);
    const auto flow = detail::second_order_flow(kappa, beta, system_.period);
    const auto rest = detail::second_order_flow<Scalar>(kappa, beta, system_.period - fraction_);
    return detail::sampled_monodromy<Scalar, Scalar>(flow, rest, system_, kappa, Scalar{1} / system_.tool.mass, L);
  }

 private:
  using Coefficients = detail::SampledCoefficients<Scalar>;

  // Whether all roots are smaller than `bound`.
  [[nodiscard]] static bool inside(Coefficients p, const Scalar& bound) noexcept {
    using std::abs;
    Scalar scale{1};
    for (Eigen::Index i = p.size() - 1; i >= 0; --i, scale /= bound) p[i] *= scale;
    // (p(z) - k p*(z))/z is one degree lower, and has one root fewer inside where |k| < 1.
    for (Eigen::Index N = p.size() - 1; N > 0; --N) {
      const Scalar k = p[0] / p[N];
      if (!(abs(k) < Scalar{1})) return false;
      for (Eigen::Index i = 0; 2 * i <= N; ++i) {
        const Scalar low = p[i], high = p[N - i];
        p[i] = low - k * high;
        p[N - i] = high - k * low;
      }
      for (Eigen::Index i = 0; i < N; ++i) p[i] = p[i + 1];
    }
    return true;
  }

  // The coefficient of z^(N-k) is the sum of (N over k) products of k roots; no root is larger than twice the largest
  // k-th root of these coefficients (Fujiwara). Between the two the interval is halved.
  [[nodiscard]] static Scalar radius_by_conditions(const Coefficients& p) noexcept {
    using std::abs, std::pow;
    const Eigen::Index N = p.size() - 1;
    Scalar lower{0}, upper{0}, binomial{1};
    for (Eigen::Index k = 1; k <= N; ++k) {
      binomial *= Scalar(static_cast<int>(N + 1 - k)) / Scalar(static_cast<int>(k));
      const Scalar size = abs(p[N - k]), part = Scalar{1} / Scalar(static_cast<int>(k));
      if (!(size > Scalar{0})) continue;
      lower = std::max<Scalar>(lower, pow(size / binomial, part));
      upper = std::max<Scalar>(upper, Scalar{2} * pow(size, part));
    }
    while (upper - lower > Scalar{2} * std::numeric_limits<Scalar>::epsilon() * upper) {
      const Scalar middle = lower + (upper - lower) / Scalar{2};
      (inside(p, middle) ? upper : lower) = middle;
    }
    return upper;
  }

  struct Cubic {
    Scalar a, b, c;  // z^3 + a z^2 + b z + c
  };
  // What `polynomial` holds where the delay is a period, kept in registers: maps are made of it.
  [[nodiscard]] Cubic cubic(const Tissue<Scalar>& tissue, const Gain<Scalar>& L) const noexcept {
    const auto flow = detail::second_order_flow(kappa_of(tissue), beta_of(tissue), system_.period);
    const Scalar L1 = L[0] / system_.tool.mass, L2 = L[1] / system_.tool.mass;
    return {-flow.trace, flow.determinant - (L1 * flow.s + L2 * flow.g),
            L1 * (flow.phi22 * flow.s - flow.g * flow.g) + L2 * flow.g};
  }

  [[nodiscard]] Scalar kappa_of(const Tissue<Scalar>& tissue) const noexcept {
    return (system_.tool.stiffness + tissue.stiffness) / system_.tool.mass;
  }
  [[nodiscard]] Scalar beta_of(const Tissue<Scalar>& tissue) const noexcept {
    return (system_.tool.damping + tissue.damping) / system_.tool.mass;
  }

  SampledSystem<Scalar> system_;
  int periods_{0};
  Scalar fraction_{0};
};

/// Spectral radius of the sampled error in `tissue`.
/// @throws std::invalid_argument  where an argument is not finite or the system refused
template <Real Scalar>
[[nodiscard]] Scalar sampled_radius(const SampledSystem<Scalar>& system, const Tissue<Scalar>& tissue,
                                    const Gain<Scalar>& L) {
  expect(is_finite(tissue.stiffness), "Tissue: stiffness", "finite", tissue.stiffness);
  expect(is_finite(tissue.damping), "Tissue: damping", "finite", tissue.damping);
  expect(is_finite(L), "Gain", "finite", L);
  return SampledStability<Scalar>(system).radius(tissue, L);
}

}  // namespace limpid
