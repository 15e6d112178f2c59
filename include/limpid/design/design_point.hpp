// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/environment/tool.hpp>

#include <Eigen/Core>

#include <array>
#include <string_view>

namespace limpid {

/// Stiffness and damping of a tissue at one point, rho = (k_e, b_e) of thesis section 4.4; what a gain is designed for.
template <Real Scalar = double>
struct Tissue {
  Scalar stiffness{0};  ///< k_e, N/m
  Scalar damping{0};    ///< b_e, N s/m

  friend bool operator==(const Tissue&, const Tissue&) = default;
};

/// The tissues with `lower` <= rho <= `upper`, entry by entry, eq. (4.38).
template <Real Scalar = double>
struct TissueBox {
  Tissue<Scalar> lower{}, upper{};

  /// @throws std::invalid_argument  where a bound is not finite or above its upper one
  void check() const {
    check_side("TissueBox: stiffness", lower.stiffness, upper.stiffness);
    check_side("TissueBox: damping", lower.damping, upper.damping);
  }

  [[nodiscard]] Tissue<Scalar> centre() const {
    return {lower.stiffness / Scalar{2} + upper.stiffness / Scalar{2},
            lower.damping / Scalar{2} + upper.damping / Scalar{2}};
  }

 private:
  static void check_side(std::string_view name, const Scalar& from, const Scalar& to) {
    expect(is_finite(from) && is_finite(to), name, "finite", is_finite(from) ? to : from);
    expect(from <= to, name, "lower <= upper", from);
  }
};

/// A corner of a box, as (rho - centre)/half width in {-1, 1}^2; of the rates, as their signs.
struct BoxCorner {
  int stiffness = 0, damping = 0;
};
inline constexpr std::array<BoxCorner, 4> box_corners{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

template <Real Scalar>
[[nodiscard]] Tissue<Scalar> tissue_at(const TissueBox<Scalar>& box, const BoxCorner& corner) {
  return {corner.stiffness < 0 ? box.lower.stiffness : box.upper.stiffness,
          corner.damping < 0 ? box.lower.damping : box.upper.damping};
}

namespace detail {

/// In the order of `box_corners`.
template <Real Scalar>
[[nodiscard]] std::array<Tissue<Scalar>, 4> vertices(const TissueBox<Scalar>& box) {
  return {tissue_at(box, box_corners[0]), tissue_at(box, box_corners[1]), tissue_at(box, box_corners[2]),
          tissue_at(box, box_corners[3])};
}

}  // namespace detail

/// Fastest change of a tissue, |rho'|_max of (4.51).
template <Real Scalar = double>
struct TissueRates {
  Scalar stiffness{0};  ///< N/(m s), >= 0
  Scalar damping{0};    ///< N/m, >= 0

  /// @throws std::invalid_argument  where a rate is negative or not finite
  void check() const {
    expect(is_finite(stiffness) && stiffness >= Scalar{0}, "TissueRates: stiffness", "finite and >= 0", stiffness);
    expect(is_finite(damping) && damping >= Scalar{0}, "TissueRates: damping", "finite and >= 0", damping);
  }
};

/// L = [L1 L2] of (4.12): N/m, N s/m.
template <Real Scalar = double>
using Gain = Eigen::Matrix<Scalar, 1, 2>;

/// L(rho) = L0 + L1 k_e + L2 b_e of thesis section 4.4.1; units as in ScheduledGain.
template <Real Scalar = double>
struct AffineGain {
  Gain<Scalar> L0 = Gain<Scalar>::Zero();
  Gain<Scalar> L1 = Gain<Scalar>::Zero();
  Gain<Scalar> L2 = Gain<Scalar>::Zero();

  /// @throws std::invalid_argument  where one of the six numbers is not finite
  void check() const {
    expect(is_finite(L0), "AffineGain: L0", "finite", L0);
    expect(is_finite(L1), "AffineGain: L1", "finite", L1);
    expect(is_finite(L2), "AffineGain: L2", "finite", L2);
  }

  [[nodiscard]] Gain<Scalar> operator()(const Tissue<Scalar>& rho) const {
    return L0 + L1 * rho.stiffness + L2 * rho.damping;
  }
};

/// What Theorems 2, 3 and 5 are told besides the tissue.
template <Real Scalar = double>
struct PredictorDesign {
  Tool<1, Scalar> tool{};
  Scalar T_d{0};                             ///< delay of the fed back error, s, > 0
  Scalar a2 = Scalar{4694} / Scalar{10000};  ///< M_2 = a2 M_1, != 0; thesis section 6.1.1
  Scalar a3 = Scalar{898} / Scalar{100000};  ///< M_3 = a3 M_1, s, != 0; thesis section 6.1.1

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    tool.check();
    expect(is_finite(T_d) && T_d > Scalar{0}, "PredictorDesign: T_d", "finite and > 0", T_d);
    expect(is_finite(a2) && a2 != Scalar{0}, "PredictorDesign: a2", "finite and != 0", a2);
    expect(is_finite(a3) && a3 != Scalar{0}, "PredictorDesign: a3", "finite and != 0", a3);
  }

  /// @throws std::invalid_argument  where the tool in `tissue` has no stiffness: the LMIs need k_t + k_e > 0
  void check(const Tissue<Scalar>& tissue) const {
    check();
    expect(is_finite(tissue.stiffness) && tool.stiffness + tissue.stiffness > Scalar{0}, "Tissue: stiffness",
           "finite, and > 0 with the tool's", tissue.stiffness);
    expect(is_finite(tissue.damping), "Tissue: damping", "finite", tissue.damping);
  }
};

/// What a test of an inequality came to. Only a certificate that an independent check accepted makes it decided.
enum class Verdict {
  feasible,    ///< variables were found and verified
  infeasible,  ///< a dual certificate was found and verified
  undecided,   ///< neither
};

[[nodiscard]] constexpr std::string_view describe(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::feasible:
      return "feasible";
    case Verdict::infeasible:
      return "infeasible";
    default:
      return "undecided";
  }
}

}  // namespace limpid
