// SPDX-License-Identifier: MIT
#include <limpid/estimation/projection_rls.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using limpid::ProjectionRLS;
using limpid::Status;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

/// theta_hat and Gamma of N parameters, by loops and for N of run time: a compiler needs long for matrices of 50
/// digits.
struct LawState {
  std::size_t N;
  std::array<Fifty, 3> theta{};
  std::array<std::array<Fifty, 3>, 3> Gamma{};
};

/// a x + b y
LawState sum(const Fifty& a, const LawState& x, const Fifty& b, const LawState& y) {
  LawState z{x.N};
  for (std::size_t i = 0; i < z.N; ++i) {
    z.theta[i] = a * x.theta[i] + b * y.theta[i];
    for (std::size_t j = 0; j < z.N; ++j) z.Gamma[i][j] = a * x.Gamma[i][j] + b * y.Gamma[i][j];
  }
  return z;
}

/// x + b y
LawState moved(LawState x, const Fifty& b, const LawState& y) {
  for (std::size_t i = 0; i < x.N; ++i) {
    x.theta[i] += b * y.theta[i];
    for (std::size_t j = 0; j < x.N; ++j) x.Gamma[i][j] += b * y.Gamma[i][j];
  }
  return x;
}

struct Law {
  Fifty alpha, nu, F;
  std::array<Fifty, 3> phi;

  [[nodiscard]] Fifty along_phi(std::size_t N, const std::array<Fifty, 3>& x) const {
    Fifty sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += phi[i] * x[i];
    return sum;
  }

  [[nodiscard]] std::array<Fifty, 3> direction(const LawState& y) const {  // Gamma phi
    std::array<Fifty, 3> direction;
    for (std::size_t i = 0; i < y.N; ++i) direction[i] = along_phi(y.N, y.Gamma[i]);
    return direction;
  }

  // (4.44)-(4.46) as printed, with phi_zd
  [[nodiscard]] LawState slope(const LawState& y) const {
    const std::array<Fifty, 3> d = direction(y);
    const Fifty m = Fifty(1) / (Fifty(1) + nu * along_phi(y.N, d));
    const Fifty epsilon = along_phi(y.N, y.theta) - F;
    LawState slope{y.N};
    for (std::size_t i = 0; i < y.N; ++i) {
      slope.theta[i] = d[i] * (-m * epsilon);
      for (std::size_t j = 0; j < y.N; ++j) slope.Gamma[i][j] = alpha * y.Gamma[i][j] - d[i] * d[j] * m;
    }
    return slope;
  }

  // Gragg's midpoint rule in 2, 4, ... 28 pieces, extrapolated to none: order 28.
  [[nodiscard]] LawState extrapolated(const LawState& y0, const Fifty& h) const {
    constexpr std::size_t columns = 14;
    const Fifty one = 1;
    std::array<LawState, columns> table{};
    for (std::size_t k = 0; k < columns; ++k) {
      const int pieces = 2 * (static_cast<int>(k) + 1);
      const Fifty piece = h / pieces;
      LawState older = y0, newer = moved(y0, piece, slope(y0));
      for (int i = 1; i < pieces; ++i) {
        const LawState next = moved(older, Fifty(2 * piece), slope(newer));
        older = newer;
        newer = next;
      }
      const Fifty half = one / Fifty(2);
      table[k] = sum(half, moved(older, piece, slope(newer)), half, newer);
      for (std::size_t j = k; j > 0; --j) {
        const Fifty ratio = Fifty(k + 1) / Fifty(j), weight = one / (ratio * ratio - one);
        table[j - 1] = sum(Fifty(one + weight), table[j], Fifty(-weight), table[j - 1]);
      }
    }
    return table[0];
  }

  [[nodiscard]] LawState integrated(LawState y, const Fifty& t) const {
    for (Fifty done = 0; done < t;) {
      const Fifty s = along_phi(y.N, direction(y));
      const Fifty fastest = Fifty(1) / 10 / (s / (1 + nu * s) + alpha + Fifty(1) / 10);
      const Fifty h = std::min(fastest, Fifty(t - done));
      y = extrapolated(y, h);
      done += h;
    }
    return y;
  }
};

struct Errors {
  Fifty theta = 0, Gamma = 0;
};

/// Largest differences of `actual` from `exact`, both some time after y: theta_hat over its size and that of its
/// change, Gamma over its trace.
Errors errors_of(const LawState& actual, const LawState& exact, const LawState& y) {
  using std::abs, std::max;
  Fifty size = 0, change = 0, trace = 0;
  Errors worst;
  for (std::size_t i = 0; i < y.N; ++i) {
    size = max(size, Fifty(abs(y.theta[i])));
    change = max(change, Fifty(abs(exact.theta[i] - y.theta[i])));
    trace += y.Gamma[i][i];
    worst.theta = max(worst.theta, Fifty(abs(actual.theta[i] - exact.theta[i])));
    for (std::size_t j = 0; j < y.N; ++j) {
      worst.Gamma = max(worst.Gamma, Fifty(abs(actual.Gamma[i][j] - exact.Gamma[i][j])));
    }
  }
  return {worst.theta / (size + change), worst.Gamma / trace};
}

/// What `rls` knows, Gamma from its factors U D U'.
template <int N, typename Scalar>
LawState state_of(const ProjectionRLS<N, 1, Scalar>& rls) {
  LawState y{N};
  const auto factors = rls.factors(0);
  for (int i = 0; i < N; ++i) {
    const auto row = static_cast<std::size_t>(i);
    y.theta[row] = Fifty(rls.theta()(0, i));
    for (int j = 0; j < N; ++j) {
      Fifty& entry = y.Gamma[row][static_cast<std::size_t>(j)];
      for (int k = 0; k < N; ++k) entry += Fifty(factors.U(i, k)) * Fifty(factors.D(k)) * Fifty(factors.U(j, k));
    }
  }
  return y;
}

/// Of one step of the law from a random state, against its integration in 50 digits.
template <int N, typename Scalar>
Errors errors_of_one_step(std::mt19937& random) {
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

  Law law{Fifty(settings.forgetting), Fifty(settings.normalisation), Fifty(Scalar(uniform(-3, 3))), {}};
  const Row phi = draw();
  for (int i = 0; i < N; ++i) law.phi[static_cast<std::size_t>(i)] = Fifty(phi(0, i));
  const LawState y = state_of<N, Scalar>(rls);
  const Scalar dt = pick({0.0009765625, 0.001, 0.0166, 0.1, 0.5});
  const LawState exact = law.integrated(y, Fifty(dt));
  REQUIRE(rls.update(dt, phi, Force::Constant(Scalar(law.F))) == Status::ok);
  return errors_of(state_of<N, Scalar>(rls), exact, y);
}

template <int N, typename Scalar>
Errors worst_of(int steps) {
  std::mt19937 random(444);
  Errors worst;
  for (int i = 0; i < steps; ++i) {
    const auto error = errors_of_one_step<N, Scalar>(random);
    worst.theta = maximum(worst.theta, error.theta);
    worst.Gamma = maximum(worst.Gamma, error.Gamma);
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
