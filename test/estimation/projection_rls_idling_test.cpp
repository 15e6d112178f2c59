// SPDX-License-Identifier: MIT
#include <estimation/press.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using limpid::ProjectionRLS;
using limpid::test::Fifty;
using limpid::test::idle;
using limpid::test::Linear;
using limpid::test::linear_model;
using limpid::test::Pair;
using limpid::test::press;

TEST_CASE("idling takes the gain to its limit and leaves it there") {
  Linear rls(linear_model());
  idle(rls, 804);                                                                     // exp(2 * 0.804) < 5
  CHECK(rls.gain(0)(0, 0) == doctest::Approx(1e9 * std::exp(1.608)).epsilon(1e-12));  // 804 roundings
  idle(rls, 5000);
  CHECK(rls.gain(0)(0, 0) == doctest::Approx(5e9).epsilon(1e-12));
  CHECK(rls.gain(0)(0, 0) <= 5e9 * (1 + 1e-12));
}

TEST_CASE("forgetting comes back as soon as there is room") {
  Linear rls(linear_model());
  idle(rls, 3000);
  press(rls, Pair(800, 33), 2);
  CHECK(rls.gain(0).trace() < 5e8);
  const double before = rls.gain(0).trace();
  idle(rls, 100);
  CHECK(rls.gain(0).trace() == doctest::Approx(before * std::exp(0.2)).epsilon(1e-12));
}

// (4.45) as printed is frozen by then and leaves (1100, 30) for good.
TEST_CASE_TEMPLATE("2 s after 1 s of idling the estimate is within 1 % of the truth", Scalar, float, double) {
  using Two = ProjectionRLS<2, 1, Scalar>;
  using Row2 = typename Two::Theta;
  for (const Row2& truth : {Row2(200, 40), Row2(800, 33), Row2(2000, 20)}) {
    CAPTURE(truth(0));
    Two rls({.lower = Row2(Scalar(200), Scalar(20)),
             .upper = Row2(Scalar(2000), Scalar(40)),
             .initial = Row2(Scalar(1100), Scalar(30)),
             .initial_gain = Row2(Scalar(1e9), Scalar(8e6))});
    idle(rls, 1000);
    press(rls, truth, 2);
    CHECK(((rls.theta() - truth) / truth).abs().maxCoeff() < Scalar(0.01));
  }
  using Three = ProjectionRLS<3, 1, Scalar>;
  using Row3 = typename Three::Theta;
  Three rls({.lower = Row3(Scalar(200), Scalar(20), Scalar(-55)),
             .upper = Row3(Scalar(2000), Scalar(40), Scalar(0)),
             .initial = Row3(Scalar(1100), Scalar(30), Scalar(0)),
             .initial_gain = Row3(Scalar(1e9), Scalar(8e6), Scalar(1e4))});
  idle(rls, 1000);
  const Row3 truth(Scalar(800), Scalar(33), Scalar(-2));
  press(rls, truth, 2);
  CHECK(((rls.theta() - truth) / truth).abs().maxCoeff() < Scalar(0.01));
}

namespace {

/// Axes pressed, at rest, hardly moved and left alone, side by side from a gain at its limit on: how far the gains and
/// estimates are from those of each axis alone in 50 digits, which knows no lanes and no series.
template <int N>
double worst_of_lanes(double pressed) {
  using Law = ProjectionRLS<N, 4>;
  using Alone = ProjectionRLS<N, 1, Fifty>;
  const Eigen::Array<double, 1, 3> lower(200, 20, -55), upper(2000, 40, 10), initial(1100, 30, 0), gain(1e9, 5e9, 1e4);
  const auto row = [](const Eigen::Array<double, 1, 3>& of) { return Eigen::Array<double, 1, N>(of.head<N>()); };
  const auto rows = [&](const Eigen::Array<double, 1, 3>& of) ->
      typename Law::Theta { return row(of).template replicate<4, 1>(); };
  Law law({.lower = rows(lower), .upper = rows(upper), .initial = rows(initial), .initial_gain = rows(gain)});
  const Alone one({.lower = row(lower).template cast<Fifty>(),
                   .upper = row(upper).template cast<Fifty>(),
                   .initial = row(initial).template cast<Fifty>(),
                   .initial_gain = row(gain).template cast<Fifty>()});
  std::array<Alone, 4> alone{one, one, one, one};
  for (int k = 0; k < 300; ++k) {
    const double w = 20 * 0.001 * k;
    typename Law::Regressor phi = Law::Regressor::Zero();
    phi.row(0).template head<2>() << pressed * std::sin(w), 20 * pressed * std::cos(w);
    phi(1, 0) = 0.002;
    phi.row(2).template head<2>() << 1e-6 * std::sin(w), 1e-5 * std::cos(w);
    const typename Law::Vector F = (phi.rowwise() * row({900, 33, -2})).rowwise().sum();
    (void)law.update(0.001, phi, F);
    for (int axis = 0; axis < 4; ++axis) {
      (void)alone[std::size_t(axis)].update(0.001, phi.row(axis).template cast<Fifty>(),
                                            Eigen::Array<Fifty, 1, 1>(Fifty(F[axis])));
    }
  }
  double worst = 0;
  for (int axis = 0; axis < 4; ++axis) {
    const Eigen::Matrix<double, N, N> exact = alone[std::size_t(axis)].gain(0).template cast<double>();
    const Eigen::Array<double, 1, N> theta = alone[std::size_t(axis)].theta().template cast<double>();
    for (int i = 0; i < N; ++i) {
      worst = std::max(worst, std::abs(law.theta()(axis, i) / theta[i] - 1) * (theta[i] != 0));
      for (int j = 0; j < N; ++j) {
        const double size = std::sqrt(exact(i, i) * exact(j, j));
        worst = std::max(worst, std::abs(law.gain(axis)(i, j) - exact(i, j)) / size);
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("at the limit of the gain each axis follows the law to roundings, whatever the others do") {
  // some five roundings a tick
  CHECK(worst_of_lanes<2>(0.003) < 300 * 5 * 1.2e-16);
  CHECK(worst_of_lanes<2>(0) < 300 * 5 * 1.2e-16);
  CHECK(worst_of_lanes<3>(0.003) < 300 * 5 * 1.2e-16);
}
