// SPDX-License-Identifier: MIT
#include <limpid/estimation/projection_rls.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::ProjectionRLS;
using limpid::Status;

namespace {

template <typename Scalar>
using Line = ProjectionRLS<1, 1, Scalar>;  // one parameter, one axis

template <typename Scalar>
typename Line<Scalar>::Theta one(double value) {
  return Line<Scalar>::Theta::Constant(Scalar(value));
}

template <typename Scalar>
typename Line<Scalar>::Settings line() {
  return {.lower = one<Scalar>(-8),
          .upper = one<Scalar>(8),
          .initial = one<Scalar>(2),
          .initial_gain = one<Scalar>(4),
          .forgetting = Scalar(0),
          .normalisation = Scalar(0),
          .gain_limit = Scalar(1024)};
}

}  // namespace

// gamma = 4, phi = 1/2, t = 3: 1 / (1/4 + 3/4) = 1; theta - theta* = (2 - 6) gamma(t) / gamma = -1
TEST_CASE_TEMPLATE("without forgetting it is least squares", Scalar, float, double, long double) {
  Line<Scalar> rls(line<Scalar>());
  CHECK(rls.update(Scalar(3), one<Scalar>(0.5), one<Scalar>(3)) == Status::ok);
  const Scalar roundings = 16 * std::numeric_limits<Scalar>::epsilon();  // some ten operations on numbers up to 6
  CHECK(std::abs(rls.gain(0)(0, 0) - Scalar(1)) <= roundings);
  CHECK(std::abs(rls.theta()(0) - Scalar(5)) <= 5 * roundings);
}

// (4.45) at rest, s = phi' Gamma phi: alpha (1 + nu s) = s, so s = alpha / (1 - alpha nu)
TEST_CASE_TEMPLATE("under constant excitation the gain settles where forgetting and information balance", Scalar, float,
                   double) {
  auto settings = line<Scalar>();
  settings.forgetting = Scalar(2);
  settings.normalisation = Scalar(0.25);
  Line<Scalar> rls(settings);
  for (int k = 0; k < 800; ++k) (void)rls.update(Scalar(0.0625), one<Scalar>(0.5), one<Scalar>(1));
  // s = 4, so gamma = 16; what is left of the start decays by exp(-alpha (1 - alpha nu) t) = exp(-50)
  CHECK(std::abs(rls.gain(0)(0, 0) - Scalar(16)) < 16 * 64 * std::numeric_limits<Scalar>::epsilon());
}

TEST_CASE_TEMPLATE("two halves of a step make the whole", Scalar, float, double) {
  using Rls = ProjectionRLS<3, 2, Scalar>;
  using Theta = typename Rls::Theta;
  Theta phi, gain;
  phi << Scalar(0.005), Scalar(0.01), Scalar(1), Scalar(-0.002), Scalar(0.03), Scalar(1);
  gain.rowwise() = Eigen::Array<Scalar, 1, 3>(Scalar(1e9), Scalar(8e6), Scalar(1e4));
  const typename Rls::Settings settings{.lower = Theta::Constant(-9e3),
                                        .upper = Theta::Constant(9e3),
                                        .initial = Theta::Constant(30),
                                        .initial_gain = gain};
  Rls whole(settings), halves(settings);
  const typename Rls::Vector F(Scalar(3), Scalar(-2));
  for (int k = 0; k < 3; ++k) {
    (void)whole.update(Scalar(0.0078125), phi, F);
    for (int half = 0; half < 2; ++half) (void)halves.update(Scalar(0.00390625), phi, F);
  }
  // roundings of nine steps, on numbers up to those of the change (1e4) and the gain's trace (1e9)
  const Scalar roundings = 100 * std::numeric_limits<Scalar>::epsilon();
  CHECK((whole.theta() - halves.theta()).abs().maxCoeff() <= Scalar(1e4) * roundings);
  CHECK((whole.gain(1) - halves.gain(1)).cwiseAbs().maxCoeff() <= Scalar(1e9) * roundings);
}
