// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/design/gain_spline.hpp>
#include <limpid/design/lmi.hpp>
#include <limpid/design/printed_theorem5.hpp>
#include <limpid/design/reduced_theorem.hpp>
#include <limpid/prediction/gain_table.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace limpid {

/// What proves a spline feasible: the variables of (4.51), barred, in the coordinates of scaled_point.hpp.
template <Real Scalar = double>
struct SplineCertificate {
  using Matrix = Eigen::Matrix<Scalar, 2, 2>;

  std::vector<Matrix> P{};  ///< at each node of the knots, bilinear between them
  Matrix Q = Matrix::Zero(), R = Matrix::Zero(), X = Matrix::Zero();
  Scalar d{0};  ///< of the coordinates, 1/s
};

template <Real Scalar = double>
struct SplineDesign {
  Verdict verdict = Verdict::undecided;  ///< feasible: proved for `gain` as it stands, rounded
  GainSpline<Scalar> gain{};             ///< where feasible
  int iterations = 0;
  std::string reason{};
  LmiMultipliers<Scalar> multipliers{};     ///< where infeasible: the proof, of `SplineLmi`'s inequalities
  SplineCertificate<Scalar> certificate{};  ///< where feasible: the proof
};

namespace detail {

/// Theorem 5 with P(rho) and Y(rho) piecewise bilinear: tensor-product B-splines of degree 1 on a grid of knots over
/// the box; X, Q, R constant (thesis, future work).
///
/// In each cell of the knots P, Y and A(rho) are affine in each of rho_1 and rho_2, and X is constant: so is the left
/// side of (4.51), and dP/drho_i is affine in the other one. A function that is affine in each coordinate is, at every
/// point of a rectangle, a mean of its values at the four corners with weights >= 0; in rho' it is affine. So the
/// corners of all cells times the corners of the rates prove it everywhere. Across a knot line P is continuous, and the
/// right derivative of V is the one of a cell that the state then is in.
///
/// N is at its optimum, and S and gamma are left out: see `reduced_matrix`.
template <Real Scalar>
class SplineLmi {
 public:
  using Expression = LmiExpression<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// @param given  a gain to verify; none: Y is free
  SplineLmi(const PredictorDesign<Scalar>& design, const KnotGrid<Scalar>& knots, const TissueRates<Scalar>& rates,
            const GainSpline<Scalar>* given)
      : design_{design}, knots_{knots}, d_{time_scale(design, knots.box().centre())} {
    for (int node = 0; node < knots.nodes(); ++node) {
      P_.push_back(lmi_.symmetric("P" + std::to_string(node), 2));
    }
    for (int node = 0; node < knots.nodes(); ++node) {
      const ErrorDynamics<Scalar> e(design, knots.node(node), given ? given->L[index(node)] : Gain<Scalar>::Zero(),
                                    Coordinates::scaled, d_);
      Y_.push_back(given ? Expression(e.L) * transpose(X_) : lmi_.full("Y" + std::to_string(node), 1, 2));
    }
    for (int i = 0; i + 1 < knots.stiffnesses(); ++i) {
      for (int j = 0; j + 1 < knots.dampings(); ++j) require_cell(i, j, rates);
    }
    for (const Expression& P : P_) lmi_.require(P > 0);
    lmi_.require(Q_ > 0);
    lmi_.require(R_ > 0);
  }

  [[nodiscard]] const Lmi<Scalar>& lmi() const noexcept { return lmi_; }

  /// L = Y X'^-1 at the knots; between them it is bilinear too, X being constant.
  [[nodiscard]] GainSpline<Scalar> gain(const LmiResult<Scalar>& result) const {
    GainSpline<Scalar> gain{knots_, {}};
    for (const Expression& Y : Y_) gain.L.push_back(gain_of<Scalar>(result[X_], result[Y], design_.tool.mass, d_));
    return gain;
  }

  [[nodiscard]] SplineCertificate<Scalar> certificate(const LmiResult<Scalar>& result) const {
    SplineCertificate<Scalar> certificate{{}, result[Q_], result[R_], result[X_], d_};
    for (const Expression& P : P_) certificate.P.push_back(result[P]);
    return certificate;
  }

  /// Of an Lmi with Y free, the unknowns of one with Y given, which come in the same order but for Y.
  [[nodiscard]] Vector without_gain(const Vector& unknowns) const {
    return unknowns.head(unknowns.size() - 2 * knots_.nodes());
  }

 private:
  static std::size_t index(int node) { return static_cast<std::size_t>(node); }

  // The four corners of cell (i, j), each at the four corners of the rates.
  void require_cell(int i, int j, const TissueRates<Scalar>& rates) {
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        const int here = knots_.index(i + a, j + b);
        const Expression stiffer = P_[index(knots_.index(i + 1, j + b))] - P_[index(knots_.index(i, j + b))];
        const Expression damper = P_[index(knots_.index(i + a, j + 1))] - P_[index(knots_.index(i + a, j))];
        const auto by_stiffness =  // |rho_1'|_max / (length of the cell), in units of d
            rate_by_half_width(rates.stiffness, knots_.stiffness(i), knots_.stiffness(i + 1), d_) * half();
        const auto by_damping =
            rate_by_half_width(rates.damping, knots_.damping(j), knots_.damping(j + 1), d_) * half();
        for (const BoxCorner& sign : box_corners) {
          require(here, Expression(sign.stiffness) * (by_stiffness * stiffer) +
                            Expression(sign.damping) * (by_damping * damper));
        }
      }
    }
  }

  // (4.51) at one knot.
  void require(int node, const Expression& rate) {
    const ErrorDynamics<Scalar> e(design_, knots_.node(node), Gain<Scalar>::Zero(), Coordinates::scaled, d_);
    lmi_.require(reduced_matrix(e, P_[index(node)], Q_, R_, X_, Y_[index(node)], rate) < 0);
  }

  static Ball<Scalar> half() { return Ball<Scalar>(Scalar{1} / Scalar{2}); }

  PredictorDesign<Scalar> design_;
  KnotGrid<Scalar> knots_;
  Scalar d_;
  Lmi<Scalar> lmi_{};
  Expression X_ = lmi_.full("X", 2, 2), Q_ = lmi_.symmetric("Q", 2), R_ = lmi_.symmetric("R", 2);
  std::vector<Expression> P_, Y_;
};

}  // namespace detail

/// Whether Theorem 5 holds for a gain given at the knots, with P on the same knots. Off line: allocates.
/// @throws std::invalid_argument  where the design, the gain or the rates cannot be used
template <Real Scalar>
[[nodiscard]] SplineDesign<Scalar> verify_spline(const PredictorDesign<Scalar>& design, const GainSpline<Scalar>& gain,
                                                 const TissueRates<Scalar>& rates) {
  gain.check();
  detail::check_theorem5(design, gain.knots.box(), rates);
  const detail::SplineLmi<Scalar> given(design, gain.knots, rates, &gain);
  const LmiResult<Scalar> found = given.lmi().solve();
  SplineDesign<Scalar> result{found.verdict, gain, found.iterations, found.reason, found.multipliers, {}};
  if (found.feasible()) result.certificate = given.certificate(found);
  return result;
}

/// A gain by Theorem 5 on a grid of knots: feasible in more cases than an affine one, which 2 x 2 knots include.
///
/// Where a single tissue of the box has no gain, nothing can help. Off line: allocates; of 5 x 5 knots some 100 ms.
/// @param knots  over the box that rho stays in
/// @throws std::invalid_argument  where the design, the knots or the rates cannot be used
template <Real Scalar>
[[nodiscard]] SplineDesign<Scalar> design_spline(const PredictorDesign<Scalar>& design, const KnotGrid<Scalar>& knots,
                                                 const TissueRates<Scalar>& rates) {
  knots.check();
  detail::check_theorem5(design, knots.box(), rates);
  const detail::SplineLmi<Scalar> free(design, knots, rates, nullptr);
  const LmiResult<Scalar> found = free.lmi().solve();
  SplineDesign<Scalar> result{found.verdict, {}, found.iterations, found.reason, found.multipliers, {}};
  if (!found.feasible()) return result;
  result.gain = free.gain(found);
  result.certificate = free.certificate(found);
  // The gain was rounded: prove it again, at the same P, Q, R and X.
  const detail::SplineLmi<Scalar> given(design, knots, rates, &result.gain);
  if (certifies_feasible(given.lmi().problem(), free.without_gain(found.unknowns), Scalar{0})) return result;
  return verify_spline(design, result.gain, rates);
}

/// The gain as the predictor applies it: held inside the knots' box and below the rates of the design.
template <int Axes = 1, Real Scalar>
[[nodiscard]] typename GainTable<Axes, Scalar>::Settings gain_table(const GainSpline<Scalar>& gain,
                                                                    const TissueRates<Scalar>& rates) {
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  gain.check();
  rates.check();
  typename GainTable<Axes, Scalar>::Settings settings;
  settings.stiffness_knots = gain.knots.stiffness_knots;
  settings.damping_knots = gain.knots.damping_knots;
  for (const Gain<Scalar>& L : gain.L) settings.L.push_back({L[0], L[1]});
  settings.rate = {Vector::Constant(rates.stiffness), Vector::Constant(rates.damping)};
  return settings;
}

}  // namespace limpid
