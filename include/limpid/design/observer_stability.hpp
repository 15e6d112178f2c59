// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/observer_step.hpp>
#include <limpid/control/q_filter.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/held_step.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <string>

namespace limpid {

/// A linear device M v' + B v = F with a disturbance observer on each axis: the velocity is sampled every T, the force
/// held for T, and so that nothing but the observers acts, command and operator rest.
template <int Axes = 1, Real Scalar = double>
struct ObservedPlant {
  using Matrix = Eigen::Matrix<Scalar, Axes, Axes>;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  Matrix M = Matrix::Constant(std::numeric_limits<Scalar>::quiet_NaN());        ///< kg, symmetric, positive definite
  Matrix B = Matrix::Constant(std::numeric_limits<Scalar>::quiet_NaN());        ///< N s/m
  Vector mass = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());     ///< nominal m of each axis, kg, > 0
  Vector damping = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< nominal b, N s/m, >= 0
  Scalar period = Scalar{1} / Scalar{1000};                                     ///< T, s, > 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    expect(is_finite(M) && M == M.transpose() && Eigen::LLT<Matrix>(M).info() == Eigen::Success, "ObservedPlant: M",
           "finite, symmetric and positive definite", M);
    expect(is_finite(B), "ObservedPlant: B", "finite", B);
    expect(is_finite(mass) && (mass > Scalar{0}).all(), "ObservedPlant: mass", "finite and > 0", mass);
    expect(is_finite(damping) && (damping >= Scalar{0}).all(), "ObservedPlant: damping", "finite and >= 0", damping);
    expect(is_finite(period) && period > Scalar{0}, "ObservedPlant: period", "finite and > 0", period);
  }
};

/// Takes (v, states of the observers axis by axis) from one tick to the next; the algebraic loop solved, as in
/// DisturbanceObserver. Off line.
/// @param tau  time constant of Q, s; that of `q` itself does not count
template <QFilter Q, int Axes>
[[nodiscard]] auto observed_monodromy(const ObservedPlant<Axes, QFilterScalar<Q>>& plant, const Q& q, ObserverForm form,
                                      const QFilterScalar<Q>& tau) {
  using Scalar = QFilterScalar<Q>;
  using Matrix = typename ObservedPlant<Axes, Scalar>::Matrix;
  constexpr int n = QFilterTraits<Q>::order, size = Axes * (1 + n);
  const detail::ObserverEquation<Q> equation(q);
  const detail::ObserverStep<Q> step(equation, form, plant.period / tau);
  const Eigen::LDLT<Matrix> M(plant.M);
  const auto exact = held_step(Matrix(-M.solve(plant.B)), plant.period);
  const Matrix Gamma = exact.Psi * M.solve(Matrix::Identity());
  const Scalar loop = Scalar{1} / (Scalar{1} - step.force.now[n - 1]), direct = equation.c[n - 1];

  Eigen::Matrix<Scalar, size, size> result;
  for (int column = 0; column < size; ++column) {
    const Eigen::Matrix<Scalar, size, 1> from = Eigen::Matrix<Scalar, size, 1>::Unit(column);
    const Eigen::Matrix<Scalar, Axes, 1> v = from.template head<Axes>();
    Eigen::Matrix<Scalar, Axes, 1> F;  // d_hat, all that the device applies
    for (int i = 0; i < Axes; ++i) F[i] = from[Axes + i * n + n - 1] - direct * plant.mass[i] / tau * v[i];
    const Eigen::Matrix<Scalar, Axes, 1> v_next = exact.Phi * v + Gamma * F;
    result.col(column).template head<Axes>() = v_next;
    for (int i = 0; i < Axes; ++i) {
      const Scalar p = plant.mass[i] / tau * v[i], p_next = plant.mass[i] / tau * v_next[i];
      Eigen::Matrix<Scalar, n, 1> x = step.Phi * from.template segment<n>(Axes + i * n);
      x += step.force.before * (F[i] - plant.damping[i] * v[i]) + step.momentum.before * p;
      x += step.momentum.now * p_next - step.force.now * (plant.damping[i] * v_next[i]);
      x += step.force.now * (loop * (x[n - 1] - direct * p_next));  // F[k+1]
      result.col(column).template segment<n>(Axes + i * n) = x;
    }
  }
  return result;
}

/// Spectral radius of the loop at a cut-off in Hz: the factor by which it grows from tick to tick in the long run.
/// Off line; rounded.
/// @throws std::invalid_argument  where an argument cannot be used
template <QFilter Q, int Axes>
[[nodiscard]] QFilterScalar<Q> observed_radius(const ObservedPlant<Axes, QFilterScalar<Q>>& plant, const Q& q,
                                               ObserverForm form, const QFilterScalar<Q>& cutoff) {
  using Scalar = QFilterScalar<Q>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  plant.check();
  detail::check_q_filter(q, "observed_radius");
  expect(is_finite(cutoff) && cutoff > Scalar{0}, "observed_radius: cutoff", "finite and > 0", cutoff);
  const Matrix loop = observed_monodromy(plant, q, form, time_constant_of(cutoff));
  if (!is_finite(loop)) return std::numeric_limits<Scalar>::infinity();
  const auto roots = detail::eigenvalues_of<Scalar>(loop);
  if (roots.empty()) return std::numeric_limits<Scalar>::infinity();
  Scalar largest{0};
  for (const auto& root : roots) {
    const Scalar square = root.real() * root.real() + root.imag() * root.imag();
    if (square > largest) largest = square;
  }
  using std::sqrt;
  return sqrt(largest);
}

/// What became of the search for the limit of a cut-off.
template <Real Scalar = double>
struct CutoffLimit {
  /// Hz: below it, down to `lowest`, no cut-off that was looked at is unstable; 0 where `lowest` itself is, infinite
  /// where none up to `highest` is
  Scalar cutoff{0};
  Scalar lowest{0}, highest{0};  ///< what was looked at, Hz, in steps of 1 %
  std::string reason;            ///< how the limit came about

  [[nodiscard]] bool found() const noexcept { return cutoff > Scalar{0} && is_finite(cutoff); }
};

/// The lowest cut-off 1/(2 pi tau) at which the sampled loop of plant and observers is unstable, for a Q of the shape
/// of `q`, whatever its own cut-off. Between 1e-4/T and 10/T, by steps of 1 % and then by halving; rounded, not proved.
/// Roots count as unstable beyond a magnitude of 1 + sqrt(epsilon), since a nominal plant without damping has one at 1.
/// Off line.
/// @throws std::invalid_argument  where an argument cannot be used
template <QFilter Q, int Axes>
[[nodiscard]] CutoffLimit<QFilterScalar<Q>> observer_cutoff_limit(const ObservedPlant<Axes, QFilterScalar<Q>>& plant,
                                                                  const Q& q, ObserverForm form) {
  using Scalar = QFilterScalar<Q>;
  using std::sqrt;
  plant.check();
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  const auto unstable = [&](const Scalar& cutoff) {
    return !(observed_radius<Q, Axes>(plant, q, form, cutoff) <= Scalar{1} + sqrt(epsilon));
  };
  CutoffLimit<Scalar> limit{.cutoff = std::numeric_limits<Scalar>::infinity(),
                            .lowest = Scalar{1} / (Scalar{10'000} * plant.period),
                            .highest = Scalar{10} / plant.period,
                            .reason = "no cut-off up to the highest is unstable"};
  if (unstable(limit.lowest)) {
    limit.cutoff = Scalar{0};
    limit.reason = "the lowest cut-off is unstable";
    return limit;
  }
  Scalar stable = limit.lowest, next = stable;
  while (next < limit.highest) {
    next = stable * (Scalar{101} / Scalar{100});
    if (unstable(next)) break;
    stable = next;
  }
  if (!(next < limit.highest)) return limit;
  while (next - stable > Scalar{4} * epsilon * next) {
    const Scalar middle = stable + (next - stable) / Scalar{2};
    (unstable(middle) ? next : stable) = middle;
  }
  limit.cutoff = stable;
  limit.reason = "a root leaves the unit circle";
  return limit;
}

/// The limit in closed form for FirstOrderQ made discrete by Tustin's rule, of a plant of little damping, in Hz:
///
///     lambda_min(M)/(pi m T)
///
/// where lambda_min(M)/m is, for axes with different nominal masses, the smallest root of det(M - lambda diag(m)). The
/// root leaves the circle at z = -1, where Q is 0 and Q P_n^-1 is m/tau; damping raises the limit by
/// (lambda_max(M^-1 B) T/2)^2/3 of itself at most.
/// @throws std::invalid_argument  where the plant cannot be used
template <int Axes, Real Scalar>
[[nodiscard]] Scalar first_order_cutoff_limit(const ObservedPlant<Axes, Scalar>& plant) {
  using Matrix = typename ObservedPlant<Axes, Scalar>::Matrix;
  using std::atan;
  plant.check();
  const Matrix roots = plant.mass.sqrt().inverse().matrix().asDiagonal();
  const Matrix scaled = roots * plant.M * roots;
  const Scalar smallest = Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[0];
  return smallest / (Scalar{4} * atan(Scalar{1}) * plant.period);
}

}  // namespace limpid
