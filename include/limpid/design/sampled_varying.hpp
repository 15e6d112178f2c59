// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/cell_proof.hpp>
#include <limpid/design/common_quadratic.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/sampled_worst.hpp>
#include <limpid/design/verified_cholesky.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <string_view>
#include <vector>

namespace limpid {

/// What came of a proof for a tissue that may be another one of the box after each sample.
template <Real Scalar = double>
struct VaryingProof {
  Verdict verdict = Verdict::undecided;  ///< feasible: proved; infeasible: not even for constant tissues
  /// V = z' P z of the state z of `SampledStability::monodromy` falls below radius^2 V with every sample.
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> P{};
  int cells{0};  ///< looked at
  std::string_view reason{};

  [[nodiscard]] bool proved() const { return verdict == Verdict::feasible; }
};

namespace detail {

/// Proves radius^2 P - M' P M > 0 for every tissue of a box, by halving it.
template <Real Scalar>
class CommonQuadraticProof {
 public:
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;
  static constexpr int most = CommonQuadraticSearch<Scalar>::most;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Forms = Eigen::Matrix<Form, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Numbers = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

  /// @param W  any matrix; the closer W' P W comes to I, the fewer cells
  CommonQuadraticProof(const SampledEnclosure<Scalar>& enclosure, const Matrix& P, const Matrix& W,
                       const Scalar& radius)
      : enclosure_{enclosure}, W_{W.template cast<Number>()} {
    const Numbers exact = P.template cast<Number>();
    // W' (r^2 P - M' P M) W > 0 has W regular and the inner matrix positive definite.
    constant_ = W_.transpose().lazyProduct(Numbers(exact.lazyProduct(W_))) * (Number{radius} * Number{radius});
    P_ = exact.template cast<Form>();
    V_ = W_.template cast<Form>();
  }

  /// The number of cells it took, or 0.
  [[nodiscard]] int run(const TissueBox<Scalar>& box, int most_cells) const {
    std::vector<Cell<Scalar>> open{cell_of(box)};
    int cells = 0;
    while (!open.empty() && cells < most_cells) {
      const Cell<Scalar> cell = open.back();
      open.pop_back();
      ++cells;
      std::size_t side = 0;
      if (holds(box_of(cell), side)) continue;
      Cell<Scalar> low, high;
      if (!halve(cell, side, low, high)) return 0;
      open.push_back(high);
      open.push_back(low);
    }
    return open.empty() ? cells : 0;
  }

 private:
  [[nodiscard]] bool holds(const TissueBox<Scalar>& cell, std::size_t& side) const {
    const Forms M = enclosure_.monodromy(cell), MW = M.lazyProduct(V_), PMW = P_.lazyProduct(MW);
    const Forms F = MW.transpose().lazyProduct(PMW);
    Numbers range(F.rows(), F.cols());
    Scalar slope1{0}, slope2{0};
    for (Eigen::Index i = 0; i < F.rows(); ++i) {
      for (Eigen::Index j = 0; j < F.cols(); ++j) {
        range(i, j) = constant_(i, j) - F(i, j).range();
        slope1 += F(i, j).slope1().magnitude();
        slope2 += F(i, j).slope2().magnitude();
      }
    }
    side = slope1 > slope2 ? 0 : 1;
    return verified_positive_definite(range);
  }

  const SampledEnclosure<Scalar>& enclosure_;
  Numbers W_, constant_;
  Forms P_, V_;
};

}  // namespace detail

/// Proves that the sampled error falls by `radius` or more with every sample, in a norm of its own, though the tissue
/// may be another one of the box after each sample (constant between samples): one quadratic function P serves every
/// tissue, M(rho)' P M(rho) < radius^2 P.
///
/// P is searched for at chosen tissues by an ellipsoid method, then proved over the box by halving it, with everything
/// that is rounded enclosed. Where no P is found nothing is said: there need not be one for a stable error.
///
/// Off line: some 10 ms to a second; the degree (delay in periods, and two or three) at most 6.
/// @throws std::invalid_argument  where an argument is not finite, the box is empty, the system refused, the degree
///                                too large or the radius not positive
template <Real Scalar>
[[nodiscard]] VaryingProof<Scalar> prove_varying_stability(const SampledSystem<Scalar>& system,
                                                           const TissueBox<Scalar>& box, const Gain<Scalar>& L,
                                                           const Scalar& radius = Scalar{1}, int most_cells = 20'000) {
  system.check();
  expect(system.degree() <= detail::CommonQuadraticSearch<Scalar>::most, "prove_varying_stability: delay",
         "of at most 4 periods", system.delay);
  VaryingProof<Scalar> result;
  const SampledProof<Scalar> constant = prove_sampled_stability(system, box, L, radius, most_cells);
  if (constant.verdict != Verdict::feasible) {
    result.verdict = constant.verdict;
    result.cells = constant.cells;
    result.reason = constant.reason;
    return result;
  }
  const detail::SampledEnclosure<Scalar> enclosure(system, L);
  const SampledStability<Scalar> stability(system);
  const auto monodromy = [&](const Scalar& x, const Scalar& y) {
    return stability.monodromy(detail::tissue_at(box, x, y), L);
  };
  // With some room first, which a proof needs in few cells, then with less.
  for (const int room : {100, 1'000, 10'000}) {
    detail::CommonQuadraticSearch<Scalar> search(monodromy, radius * (Scalar{1} - Scalar{1} / Scalar(room)));
    if (!search.run()) continue;
    const detail::CommonQuadraticProof<Scalar> proof(enclosure, search.P(), search.W(), radius);
    result.cells = proof.run(box, most_cells);
    if (result.cells == 0) continue;
    result.verdict = Verdict::feasible;
    result.P = search.P();
    result.reason = "one quadratic function falls with every tissue of the box";
    return result;
  }
  result.reason = "stable for every constant tissue, but no common quadratic function was found and proved";
  return result;
}

}  // namespace limpid
