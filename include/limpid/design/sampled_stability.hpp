// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/largest_root.hpp>
#include <limpid/design/root_radius.hpp>
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
      return is_finite(a + b + c) ? infinite_unless_told(detail::largest_root_magnitude(a, b, c)) : too_large();
    }
    const auto p = polynomial(tissue, L);
    if (!is_finite(p)) return too_large();
    if (p.size() == 3) return infinite_unless_told(detail::largest_root_magnitude(p[1], p[0]));
    if (p.size() == 4) return infinite_unless_told(detail::largest_root_magnitude(p[2], p[1], p[0]));
    return detail::root_radius(p);
  }

  /// Whether the radius is below `bound`: by the conditions of Schur and Cohn, which need no roots. No where `bound` is
  /// not above zero, or the numbers are too large to tell.
  [[nodiscard]] bool stable(const Tissue<Scalar>& tissue, const Gain<Scalar>& L,
                            const Scalar& bound = Scalar{1}) const noexcept {
    const auto p = polynomial(tissue, L);
    return is_finite(p) && detail::roots_inside(p, bound);
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

  static constexpr Scalar too_large() { return std::numeric_limits<Scalar>::infinity(); }
  // The closed forms of roots may overflow where the coefficients do not.
  static Scalar infinite_unless_told(const Scalar& radius) noexcept { return is_finite(radius) ? radius : too_large(); }

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
