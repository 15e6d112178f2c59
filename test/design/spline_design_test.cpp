// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"
#include "design_instances.hpp"
#include "eigen_instances.hpp"

#include <limpid/design/largest_box.hpp>
#include <limpid/design/spline_design.hpp>
#include <limpid/prediction/gain_table.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

using limpid::design_spline;
using limpid::KnotGrid;
using limpid::TissueBox;
using limpid::Verdict;

namespace {

const TissueBox<>& whole = limpid::test::box;
const auto& rates = limpid::test::rates;
const limpid::PredictorDesign<> slow = limpid::test::design_at(0.1, 0);

}  // namespace

TEST_CASE("at .93 of the box no affine gain is feasible, and a gain on three knots of stiffness is") {
  const TissueBox<> box = limpid::scaled_box(whole, 0.93);
  CHECK(limpid::printed_theorem5<double>(slow, box, rates).at_centre.lmi.solve().verdict == Verdict::infeasible);
  CHECK(design_spline(slow, KnotGrid<>::uniform(box, 2, 2), rates).verdict == Verdict::infeasible);
  const auto design = design_spline(slow, KnotGrid<>::uniform(box, 3, 2), rates);
  REQUIRE(design.verdict == Verdict::feasible);
  CHECK(design.gain.L.size() == 6);
  CHECK(limpid::verify_spline(slow, design.gain, rates).verdict == Verdict::feasible);
}

TEST_CASE("knots do not help at .95, and the multipliers prove it") {
  const auto design = design_spline(slow, KnotGrid<>::uniform(limpid::scaled_box(whole, 0.95), 3, 2), rates);
  CHECK(design.verdict == Verdict::infeasible);
  CHECK(!design.multipliers.Z.empty());
}

TEST_CASE("what is feasible with an affine gain is so with knots") {
  const TissueBox<> box = limpid::scaled_box(whole, 0.9);
  CHECK(limpid::printed_theorem5<double>(slow, box, rates).at_centre.lmi.solve().verdict == Verdict::feasible);
  CHECK(design_spline(slow, KnotGrid<>::uniform(box, 2, 2), rates).verdict == Verdict::feasible);
}

TEST_CASE("a spline that only an unstable loop would have is not verified") {
  limpid::GainSpline<> gain{KnotGrid<>::uniform(whole, 2, 2), {}};
  gain.L.assign(4, limpid::Gain<>(5000, 0));  // the predictor's spring overcome
  CHECK(limpid::verify_spline(slow, gain, rates).verdict == Verdict::infeasible);
}

TEST_CASE("the gain at run time is the one that was designed") {
  limpid::GainSpline<> gain{KnotGrid<>::uniform(whole, 3, 2), {}};
  for (int i = 0; i < 6; ++i) gain.L.push_back({-10.0 * i, 0.5 * i * i});
  limpid::GainTable<1> table(limpid::gain_table(gain, rates));
  for (const auto& [k, b] : {std::pair{200.0, 20.0}, {650.0, 25.0}, {1999.0, 39.0}, {1100.0, 40.0}}) {
    limpid::GainTable<1> fresh = table;
    (void)fresh.update(0.0, {Eigen::Array<double, 1, 1>::Constant(k), Eigen::Array<double, 1, 1>::Constant(b)});
    const limpid::Gain<> L = gain({k, b});
    CHECK(fresh.row().L1[0] == doctest::Approx(L[0]).epsilon(1e-13));
    CHECK(fresh.row().L2[0] == doctest::Approx(L[1]).epsilon(1e-13));
  }
}

TEST_CASE("knots that cannot be used are refused") {
  CHECK_THROWS_AS((void)KnotGrid<>::uniform(whole, 1, 2), std::invalid_argument);
  CHECK_THROWS_AS((void)KnotGrid<>::uniform({{200, 20}, {200, 40}}, 2, 2), std::invalid_argument);
  limpid::GainSpline<> gain{KnotGrid<>::uniform(whole, 2, 2), {}};
  CHECK_THROWS_AS((void)limpid::verify_spline(slow, gain, rates), std::invalid_argument);
}

TEST_CASE("the certificate of a design satisfies (4.51) at every corner of every cell and of the rates") {
  using Matrix2 = Eigen::Matrix2d;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const auto knots = KnotGrid<>::uniform(limpid::scaled_box(whole, 0.9), 3, 2);
  const auto design = design_spline(slow, knots, rates);
  REQUIRE(design.verdict == Verdict::feasible);
  const auto& P = design.certificate.P;
  const Matrix2 &Q = design.certificate.Q, &R = design.certificate.R, &X = design.certificate.X;
  const double d = design.certificate.d;
  REQUIRE(P.size() == 6);
  const auto least = [](const Eigen::MatrixXd& A) {  // of any size, so that the solver is compiled once for all
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues()[0];
  };
  CHECK(least(Q) > 0);
  CHECK(least(R) > 0);
  const double mass = slow.tool.mass, b_t = slow.tool.damping, k_t = slow.tool.stiffness;
  const double T = d * slow.T_d, a2 = slow.a2, a3 = d * slow.a3;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) {
      const auto at = [&P](int k, int l) -> const Matrix2& { return P[static_cast<std::size_t>(2 * k + l)]; };
      CHECK(least(at(i, j)) > 0);
      const limpid::Gain<> L = design.gain.L[static_cast<std::size_t>(2 * i + j)];
      Matrix2 A, BL = Matrix2::Zero();
      A << 0, 1, -(k_t + knots.stiffness(i)) / (mass * d * d), -(b_t + knots.damping(j)) / (mass * d);
      BL.row(1) << L[0] / (mass * d * d), L[1] / (mass * d);
      Eigen::Matrix<double, 6, 2> E;
      E << Matrix2::Identity(), a2 * Matrix2::Identity(), a3 * Matrix2::Identity();
      Eigen::Matrix<double, 2, 6> C;
      C << -A * X.transpose(), -BL * X.transpose(), X.transpose();
      for (const int cell : {std::max(i - 1, 0), std::min(i, 1)}) {
        for (const auto& sign : limpid::box_corners) {
          const Matrix2 by_k =
              (at(cell + 1, j) - at(cell, j)) * rates.stiffness / (knots.stiffness(cell + 1) - knots.stiffness(cell));
          const Matrix2 by_b = (at(i, 1) - at(i, 0)) * rates.damping / (knots.damping(1) - knots.damping(0));
          Matrix6 F = E * C + (E * C).transpose();
          F.block<2, 2>(0, 0) += Q - R / T + (sign.stiffness * by_k + sign.damping * by_b) / d;
          F.block<2, 2>(2, 0) += R / T;
          F.block<2, 2>(0, 2) += R / T;
          F.block<2, 2>(2, 2) -= Q + R / T;
          F.block<2, 2>(4, 0) += at(i, j);
          F.block<2, 2>(0, 4) += at(i, j);
          F.block<2, 2>(4, 4) += T * R;
          CHECK(least(-F) > 0);
        }
      }
    }
  }
}

TEST_CASE("a gain that no design found, and more knots than any memory, are refused") {
  CHECK_THROWS_WITH_AS((void)limpid::GainSpline<>{}({500, 30}), "GainSpline: L: expected one for each knot, got 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)KnotGrid<>::uniform(whole, 70'000, 70'000),
                       "KnotGrid: nodes: expected a million or fewer, got 4900000000", std::invalid_argument);
  CHECK_THROWS_AS((void)KnotGrid<>::uniform(whole, 2'000'000'000, 2), std::invalid_argument);
}
