// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/q_filter.hpp>
#include <limpid/core/held_step.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// How the two filters of Fig. 1, Q and Q P_n^-1, are made discrete.
enum class ObserverForm {
  tustin,          ///< force and velocity linear between ticks, the state by the trapezoidal rule
  step_invariant,  ///< force and velocity held between ticks, the state exact; no algebraic loop
  backward_euler,  ///< the slope at the end of a tick taken for all of it
};

namespace detail {

/// Q and s Q as one filter of the force g = F - b v and of p = m v/tau, in observer form and in units of tau, so that
/// one set of coefficients serves all axes. With D = s^n + a_(n-1) s^(n-1) + ... and N = c_(n-1) s^(n-1) + ...:
///
///     Q g - s Q p = x_(n-1) - c_(n-1) p,     tau x_i' = x_(i-1) - a_i x_(n-1) + c_i g - (c_(i-1) - c_(n-1) a_i) p
///
/// and with b v and m v' put in, Q [F - P_n^-1 v].
template <QFilter Q>
struct ObserverEquation {
  using Scalar = QFilterScalar<Q>;
  static constexpr int n = QFilterTraits<Q>::order;
  static constexpr int zeros = n - QFilterTraits<Q>::relative_degree;
  using Column = Eigen::Matrix<Scalar, n, 1, Eigen::DontAlign>;
  static_assert(QFilterTraits<Q>::relative_degree >= 1,
                "the Q of a disturbance observer needs a relative degree of at least 1: Q/P_n is improper with less");

  Column a = Column::Zero(), c = Column::Zero(), force = Column::Zero(), momentum = Column::Zero();

  explicit ObserverEquation(const Q& q) noexcept {
    const Polynomial<Scalar, n> D = QFilterTraits<Q>::denominator(q);
    const Polynomial<Scalar, zeros> N = QFilterTraits<Q>::numerator(q);
    for (int i = 0; i < n; ++i) a[i] = D[static_cast<std::size_t>(i)] / D.back();
    for (int i = 0; i <= zeros; ++i) c[i] = N[static_cast<std::size_t>(i)] / D.back();
    force = c;
    for (int i = 0; i < n; ++i) momentum[i] = (i > 0 ? Scalar(-c[i - 1]) : Scalar{0}) + c[n - 1] * a[i];
  }

  /// x at which the estimate rests at d while the velocity rests at p: F = b v + d.
  [[nodiscard]] Column at_rest(const Scalar& d, const Scalar& p) const noexcept {
    Column x;
    for (int i = 0; i < n; ++i) x[i] = (i + 1 < n ? Scalar(a[i + 1] - c[i + 1]) : Scalar{1}) * d + c[i] * p;
    return x;
  }

  /// A u of tau x' = A x
  [[nodiscard]] Column times_A(const Column& u) const noexcept {
    Column y = -a * u[n - 1];
    for (int i = 1; i < n; ++i) y[i] += u[i - 1];
    return y;
  }

  /// (I - k A)^-1 u, whose denominator k^n D(1/k) > 0
  [[nodiscard]] Column solve(const Scalar& k, const Column& u) const noexcept {
    Scalar top{0}, bottom{0};
    for (int i = 0; i < n; ++i) {
      top = top * k + u[i];
      bottom = (bottom + a[i]) * k;
    }
    // Horner's order gives sum u_i k^(n-1-i) and sum a_i k^(n-i)
    const Scalar last = top / (Scalar{1} + bottom);
    Column x;
    for (int i = 0; i < n; ++i) x[i] = u[i] + k * ((i > 0 ? x[i - 1] : Scalar{0}) - a[i] * last);
    return x;
  }
};

/// x[k+1] = Phi x[k] + before u[k] + now u[k+1] for each of the inputs g and p of ObserverEquation.
template <QFilter Q>
struct ObserverStep {
  using Equation = ObserverEquation<Q>;
  using Scalar = typename Equation::Scalar;
  using Column = typename Equation::Column;
  static constexpr int n = Equation::n;
  using Square = Eigen::Matrix<Scalar, n, n, Eigen::DontAlign>;

  struct Input {
    Column before = Column::Zero(), now = Column::Zero();
  };

  Square Phi = Square::Identity();
  Input force, momentum;

  ObserverStep() = default;

  /// Over h/tau = `length`.
  ObserverStep(const Equation& equation, ObserverForm form, const Scalar& length) noexcept {
    if (form == ObserverForm::step_invariant) {
      Square A;
      for (int i = 0; i < n; ++i) A.col(i) = equation.times_A(Column::Unit(i));
      const auto exact = held_step(A, length);
      Phi = exact.Phi;
      force.before = exact.Psi.lazyProduct(equation.force);
      momentum.before = exact.Psi.lazyProduct(equation.momentum);
      return;
    }
    // (I - k A) x[k+1] = (I + l A) x[k] + inputs: k = l = h/2 tau by Tustin, k = h/tau and l = 0 by Euler
    const bool tustin = form == ObserverForm::tustin;
    const Scalar k = tustin ? Scalar(length / Scalar{2}) : length, l = tustin ? k : Scalar{0};
    for (int i = 0; i < n; ++i) {
      const Column unit = Column::Unit(i);
      Phi.col(i) = equation.solve(k, Column(unit + l * equation.times_A(unit)));
    }
    force = {equation.solve(k, Column(l * equation.force)), equation.solve(k, Column(k * equation.force))};
    momentum = {equation.solve(k, Column(l * equation.momentum)), equation.solve(k, Column(k * equation.momentum))};
  }
};

}  // namespace detail

}  // namespace limpid
