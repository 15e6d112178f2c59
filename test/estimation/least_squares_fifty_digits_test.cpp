// SPDX-License-Identifier: MIT
#include <limpid/estimation/projection_rls.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using limpid::ProjectionRLS;
using limpid::Status;
using limpid::test::Fifty;

namespace {

/// theta_hat beside Gamma.
template <int N>
using LawState = Eigen::Matrix<Fifty, N, N + 1>;

template <int N>
struct Law {
  Fifty alpha, nu, F;
  Eigen::Matrix<Fifty, N, 1> phi;

  // (4.44)-(4.46) as printed, with phi_zd
  [[nodiscard]] LawState<N> slope(const LawState<N>& y) const {
    const Eigen::Matrix<Fifty, N, 1> theta = y.col(0);
    const Eigen::Matrix<Fifty, N, N> Gamma = y.template rightCols<N>();
    const Eigen::Matrix<Fifty, N, 1> direction = Gamma * phi;
    const Fifty m = Fifty(1) / (Fifty(1) + nu * phi.dot(direction));
    const Fifty epsilon = phi.dot(theta) - F;
    LawState<N> slope;
    slope.col(0) = direction * (-m * epsilon);
    slope.template rightCols<N>() = Gamma * alpha - direction * direction.transpose() * m;
    return slope;
  }

  // Gragg's midpoint rule in 2, 4, ... 28 pieces, extrapolated to none: order 28.
  [[nodiscard]] LawState<N> extrapolated(const LawState<N>& y0, const Fifty& h) const {
    constexpr std::size_t columns = 14;
    std::array<LawState<N>, columns> table;
    for (std::size_t k = 0; k < columns; ++k) {
      const int pieces = 2 * (static_cast<int>(k) + 1);
      const Fifty piece = h / pieces;
      LawState<N> older = y0, newer = y0 + slope(y0) * piece;
      for (int i = 1; i < pieces; ++i) {
        const LawState<N> next = older + slope(newer) * (2 * piece);
        older = newer;
        newer = next;
      }
      table[k] = (older + newer + slope(newer) * piece) / Fifty(2);
      for (std::size_t j = k; j > 0; --j) {
        const Fifty ratio = Fifty(k + 1) / Fifty(j), weight = Fifty(1) / (ratio * ratio - Fifty(1));
        table[j - 1] = table[j] + (table[j] - table[j - 1]) * weight;
      }
    }
    return table[0];
  }

  [[nodiscard]] LawState<N> integrated(LawState<N> y, const Fifty& t) const {
    for (Fifty done = 0; done < t;) {
      const Fifty s = phi.dot(y.template rightCols<N>() * phi);
      const Fifty fastest = Fifty(1) / 10 / (s / (1 + nu * s) + alpha + Fifty(1) / 10);
      const Fifty h = std::min(fastest, Fifty(t - done));
      y = extrapolated(y, h);
      done += h;
    }
    return y;
  }
};

template <int N>
struct Errors {
  Fifty theta = 0, Gamma = 0;
};

/// Largest differences between one step of the law from a random state and its integration in 50 digits: theta_hat over
/// its size and that of its change, Gamma over its trace before the step.
template <int N, typename Scalar>
Errors<N> errors_of_one_step(std::mt19937& random) {
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto pick = [&](std::initializer_list<double> values) {
    return Scalar(*(values.begin() + std::uniform_int_distribution<long>(0, long(values.size()) - 1)(random)));
  };
  using Rls = ProjectionRLS<N, 1, Scalar>;
  using Row = typename Rls::Theta;
  typename Rls::Settings settings{.lower = Row::Constant(Scalar(-1e30)),
                                  .upper = Row::Constant(Scalar(1e30)),
                                  .initial = Row::Constant(Scalar(1100)),
                                  .initial_gain = Row::Constant(Scalar(1e6)),
                                  .forgetting = pick({0, 0.5, 2, 20}),
                                  .normalisation = pick({0, 0.01, 0.0390625}),
                                  .gain_limit = Scalar(1e30)};
  settings.initial_gain(0) = Scalar(1e9);
  Rls rls(settings);
  const auto draw = [&] {
    Row phi;
    for (int j = 0; j < N; ++j) phi(j) = Scalar(std::pow(10.0, uniform(-6, -1)) * (uniform(-1, 1) < 0 ? -1 : 1));
    return phi;
  };
  using Force = typename Rls::Vector;
  for (int i = 0; i < 3; ++i) (void)rls.update(Scalar(0.001), draw(), Force::Constant(Scalar(uniform(-3, 3))));

  Law<N> law{Fifty(settings.forgetting), Fifty(settings.normalisation), Fifty(Scalar(uniform(-3, 3))), {}};
  const Row phi = draw();
  law.phi = phi.matrix().transpose().template cast<Fifty>();
  // Gamma from its factors, so that both start from the same matrix
  const auto [U, D] = rls.factors(0);
  const Eigen::Matrix<Fifty, N, N> U50 = U.template cast<Fifty>();
  LawState<N> y;
  y.col(0) = rls.theta().matrix().transpose().template cast<Fifty>();
  y.template rightCols<N>() = U50 * D.template cast<Fifty>().asDiagonal() * U50.transpose();
  const Scalar dt = pick({0.0009765625, 0.001, 0.0166, 0.1, 0.5});
  const LawState<N> exact = law.integrated(y, Fifty(dt));
  REQUIRE(rls.update(dt, phi, Force::Constant(Scalar(law.F))) == Status::ok);

  const auto after = rls.factors(0);
  const Eigen::Matrix<Fifty, N, N> U_after = after.U.template cast<Fifty>();
  const Eigen::Matrix<Fifty, N, N> Gamma = U_after * after.D.template cast<Fifty>().asDiagonal() * U_after.transpose();
  const Eigen::Matrix<Fifty, N, 1> theta = rls.theta().matrix().transpose().template cast<Fifty>();
  const Fifty size = y.col(0).cwiseAbs().maxCoeff() + (exact.col(0) - y.col(0)).cwiseAbs().maxCoeff();
  return {(theta - exact.col(0)).cwiseAbs().maxCoeff() / size,
          (Gamma - exact.template rightCols<N>()).cwiseAbs().maxCoeff() / y.template rightCols<N>().trace()};
}

template <int N, typename Scalar>
Errors<N> worst_of(int steps) {
  std::mt19937 random(444);
  Errors<N> worst;
  for (int i = 0; i < steps; ++i) {
    const auto error = errors_of_one_step<N, Scalar>(random);
    worst.theta = std::max(worst.theta, error.theta);
    worst.Gamma = std::max(worst.Gamma, error.Gamma);
  }
  return worst;
}

}  // namespace

// The tolerance in 50 digits is the integration's: its last column alters the result by less.
TEST_CASE("in 50 digits a step is the solution of (4.44)-(4.46)") {
  const auto two = worst_of<2, Fifty>(15);
  const auto three = worst_of<3, Fifty>(8);
  CHECK(two.theta < Fifty("1e-28"));
  CHECK(two.Gamma < Fifty("1e-28"));
  CHECK(three.theta < Fifty("1e-28"));
  CHECK(three.Gamma < Fifty("1e-28"));
  MESSAGE("worst relative differences, theta_hat ", two.theta.str(3), " ", three.theta.str(3), ", Gamma ",
          two.Gamma.str(3), " ", three.Gamma.str(3));
}

// A step rounds some 20 times in a row; phi' theta_hat - F cancels, which the size of the change accounts for.
TEST_CASE_TEMPLATE("a step differs from the solution by roundings alone", Scalar, float, double) {
  const Fifty rounding = Fifty(std::numeric_limits<Scalar>::epsilon());
  const auto two = worst_of<2, Scalar>(40);
  CHECK(two.theta < 40 * rounding);
  CHECK(two.Gamma < 40 * rounding);
  MESSAGE("worst in roundings, theta_hat ", Fifty(two.theta / rounding).str(3), ", Gamma ",
          Fifty(two.Gamma / rounding).str(3));
}
