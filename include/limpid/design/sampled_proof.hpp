// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/ball.hpp>
#include <limpid/design/cell_proof.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/mean_value_form.hpp>
#include <limpid/design/sampled_polynomial.hpp>
#include <limpid/design/second_order_enclosure.hpp>

#include <Eigen/Core>

#include <cmath>
#include <string_view>
#include <vector>

namespace limpid {

/// What came of a proof over a box of tissues.
template <Real Scalar = double>
struct SampledProof {
  Verdict verdict = Verdict::undecided;  ///< feasible: the radius is below the bound for every tissue of the box;
                                         ///< infeasible: it is above the bound in `tissue`
  int cells{0};                          ///< looked at
  TissueBox<Scalar> cell{};              ///< where it ended, unless feasible
  Tissue<Scalar> tissue{};               ///< centre of that cell or one of its corners
  std::string_view reason{};

  [[nodiscard]] bool proved() const { return verdict == Verdict::feasible; }
};

namespace detail {

/// Characteristic polynomials of all tissues of a cell, from exact data.
template <Real Scalar>
class SampledEnclosure {
 public:
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;

  SampledEnclosure(const SampledSystem<Scalar>& system, const Gain<Scalar>& L)
      : system_{system},
        L_{L},
        periods_{system.periods()},
        fraction_{system.fraction()},
        per_mass_{Number{Scalar{1}} / Number{system.tool.mass}} {
    L_over_m_ << Number{L[0]} / Number{system.tool.mass}, Number{L[1]} / Number{system.tool.mass};
  }

  [[nodiscard]] SampledCoefficients<Form> polynomial(const TissueBox<Scalar>& cell) const {
    const auto [kappa, beta] = parameters(cell);
    const auto flow = enclose_second_order_flow(kappa, beta, Number{system_.period});
    if (!(fraction_ > Scalar{0})) {
      return sampled_coefficients<Scalar, Form>(flow, nullptr, periods_, kappa, L_over_m_);
    }
    const auto rest = enclose_second_order_flow(kappa, beta, Number{system_.period} - Number{fraction_});
    return sampled_coefficients<Scalar, Form>(flow, &rest, periods_, kappa, L_over_m_);
  }

  [[nodiscard]] Eigen::Matrix<Form, Eigen::Dynamic, Eigen::Dynamic> monodromy(const TissueBox<Scalar>& cell) const {
    const auto [kappa, beta] = parameters(cell);
    const auto flow = enclose_second_order_flow(kappa, beta, Number{system_.period});
    const auto rest = fraction_ > Scalar{0}
                          ? enclose_second_order_flow(kappa, beta, Number{system_.period} - Number{fraction_})
                          : flow;
    return sampled_monodromy<Scalar, Form>(flow, rest, system_, kappa, Form{per_mass_}, L_);
  }

 private:
  struct Parameters {
    Form kappa, beta;
  };
  [[nodiscard]] Parameters parameters(const TissueBox<Scalar>& cell) const {
    const Form k_e = Form::first(cell.lower.stiffness, cell.upper.stiffness);
    const Form b_e = Form::second(cell.lower.damping, cell.upper.damping);
    return {per_mass_ * (Form{system_.tool.stiffness} + k_e), per_mass_ * (Form{system_.tool.damping} + b_e)};
  }

  SampledSystem<Scalar> system_;
  Gain<Scalar> L_;
  int periods_;
  Scalar fraction_;
  Number per_mass_;
  Eigen::Matrix<Number, 1, 2> L_over_m_;
};

template <Real Scalar>
[[nodiscard]] TissueBox<Scalar> box_of(const Cell<Scalar>& cell) {
  return {{cell.lower[0], cell.lower[1]}, {cell.upper[0], cell.upper[1]}};
}
template <Real Scalar>
[[nodiscard]] Cell<Scalar> cell_of(const TissueBox<Scalar>& box) {
  return {{box.lower.stiffness, box.lower.damping}, {box.upper.stiffness, box.upper.damping}};
}

}  // namespace detail

/// Proves that the spectral radius of the sampled error is below `radius` for every constant tissue of the box, or that
/// it is above it for one: by halving the box until the conditions of Jury, enclosed with everything that is rounded,
/// hold all over each cell. The given numbers are taken as exact.
///
/// Off line: some 2 us a cell; cells gather where the radius comes close to the bound.
/// @param most_cells  looked at before it gives up
/// @throws std::invalid_argument  where an argument is not finite, the box is empty, the system refused or the radius
///                                not positive
template <Real Scalar>
[[nodiscard]] SampledProof<Scalar> prove_sampled_stability(const SampledSystem<Scalar>& system,
                                                           const TissueBox<Scalar>& box, const Gain<Scalar>& L,
                                                           const Scalar& radius = Scalar{1}, int most_cells = 100'000) {
  system.check();
  box.check();
  expect(is_finite(L), "prove_sampled_stability: gain", "finite", L);
  expect(is_finite(radius) && radius > Scalar{0}, "prove_sampled_stability: radius", "finite and > 0", radius);
  expect(most_cells > 0, "prove_sampled_stability: most_cells", "> 0", most_cells);
  const detail::SampledEnclosure<Scalar> enclosure(system, L);
  const auto polynomial = [&](const detail::Cell<Scalar>& cell) { return enclosure.polynomial(detail::box_of(cell)); };
  const auto proof = detail::prove_roots_inside(detail::cell_of(box), polynomial, radius, most_cells);
  return {proof.verdict, proof.cells, detail::box_of(proof.cell), {proof.point[0], proof.point[1]}, proof.reason};
}

/// The same for one tissue.
template <Real Scalar>
[[nodiscard]] SampledProof<Scalar> prove_sampled_stability(const SampledSystem<Scalar>& system,
                                                           const Tissue<Scalar>& tissue, const Gain<Scalar>& L,
                                                           const Scalar& radius = Scalar{1}) {
  return prove_sampled_stability(system, TissueBox<Scalar>{tissue, tissue}, L, radius, 1);
}

}  // namespace limpid
