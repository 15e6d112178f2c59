// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lanes.hpp>
#include <limpid/estimation/any_above.hpp>
#include <limpid/estimation/exponential_mean.hpp>
#include <limpid/estimation/least_squares_flow.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace limpid::bench {

/// Gamma with all its entries, its symmetry left to the roundings. Interface of UDFactors, as the other forms.
template <typename Array>
struct FullCovariance {
  using Columns = std::array<Array, 2>;
  struct Direction {
    Columns column, row;  // Gamma phi, phi' Gamma
    Array s;
  };
  Array a, b, c, d;

  explicit FullCovariance(const Columns& diagonal)
      : a{diagonal[0]}, b{Array::Zero()}, c{Array::Zero()}, d{diagonal[1]} {}

  [[nodiscard]] Direction along(const Columns& phi) const noexcept {
    Direction seen{{a * phi[0] + b * phi[1], c * phi[0] + d * phi[1]},
                   {a * phi[0] + c * phi[1], b * phi[0] + d * phi[1]},
                   Array::Zero()};
    seen.s = phi[0] * seen.column[0] + phi[1] * seen.column[1];
    return seen;
  }
  Columns downdate(const Direction& seen, const Array& u) noexcept {
    using Scalar = typename Array::Scalar;
    const Array factor = u / (Scalar{1} + seen.s * u);
    const Columns K{seen.column[0] * factor, seen.column[1] * factor};
    a -= K[0] * seen.row[0];
    b -= K[0] * seen.row[1];
    c -= K[1] * seen.row[0];
    d -= K[1] * seen.row[1];
    return K;
  }
  void scale(const Array& factor) noexcept {
    for (Array* entry : {&a, &b, &c, &d}) *entry *= factor;
  }
};

/// Gamma's upper triangle.
template <typename Array>
struct SymmetricCovariance {
  using Columns = std::array<Array, 2>;
  struct Direction {
    Columns column;
    Array s;
  };
  Array a, b, d;

  explicit SymmetricCovariance(const Columns& diagonal) : a{diagonal[0]}, b{Array::Zero()}, d{diagonal[1]} {}

  [[nodiscard]] Direction along(const Columns& phi) const noexcept {
    Direction seen{{a * phi[0] + b * phi[1], b * phi[0] + d * phi[1]}, Array::Zero()};
    seen.s = phi[0] * seen.column[0] + phi[1] * seen.column[1];
    return seen;
  }
  Columns downdate(const Direction& seen, const Array& u) noexcept {
    using Scalar = typename Array::Scalar;
    const Array factor = u / (Scalar{1} + seen.s * u);
    const Columns K{seen.column[0] * factor, seen.column[1] * factor};
    a -= K[0] * seen.column[0];
    b -= K[0] * seen.column[1];
    d -= K[1] * seen.column[1];
    return K;
  }
  void scale(const Array& factor) noexcept {
    for (Array* entry : {&a, &b, &d}) *entry *= factor;
  }
};

/// Potter's square root: Gamma = S S'.
template <typename Array>
struct SquareRoot {
  using Columns = std::array<Array, 2>;
  struct Direction {
    Columns f, column;  // S' phi, Gamma phi
    Array s;
  };
  Array a, b, c, d;

  explicit SquareRoot(const Columns& diagonal)
      : a{diagonal[0].sqrt()}, b{Array::Zero()}, c{Array::Zero()}, d{diagonal[1].sqrt()} {}

  [[nodiscard]] Direction along(const Columns& phi) const noexcept {
    const Columns f{a * phi[0] + c * phi[1], b * phi[0] + d * phi[1]};
    return {f, {a * f[0] + b * f[1], c * f[0] + d * f[1]}, f[0] * f[0] + f[1] * f[1]};
  }
  Columns downdate(const Direction& seen, const Array& u) noexcept {
    using Scalar = typename Array::Scalar;
    const Array w = Scalar{1} + seen.s * u, factor = u / w, root = Scalar{1} / w.sqrt();
    const Columns K{seen.column[0] * factor, seen.column[1] * factor};
    const Array part = (Scalar{1} + root).inverse();
    const Array left0 = K[0] * part, left1 = K[1] * part;
    a -= left0 * seen.f[0];
    b -= left0 * seen.f[1];
    c -= left1 * seen.f[0];
    d -= left1 * seen.f[1];
    return K;
  }
  void scale(const Array& factor) noexcept {
    const Array root = factor.sqrt();
    for (Array* entry : {&a, &b, &c, &d}) *entry *= root;
  }
};

/// The law of a tick: (4.44)-(4.46) solved exactly for phi and F held, or one update a sample with the weight dt.
enum class Gathering { exact, per_sample };

/// (4.44)-(4.46) with two parameters; with ProjectionRLS's inputs and its tests of them and of the box, which no
/// parameter leaves here.
template <template <typename> class Form, Gathering gathering, int Axes, typename Scalar>
class LeastSquares {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, 2>;

  LeastSquares(const Theta& initial, const Theta& gain, const Theta& bound, const Scalar& alpha, const Scalar& nu)
      : alpha_{alpha},
        nu_{nu},
        flow_{alpha, nu},
        bound_{columns(bound)},
        theta_{columns(initial)},
        Gamma_{columns(gain)} {}

  void update(const Scalar& dt, const Theta& phi_of_axes, const Vector& F_of_axes) noexcept {
    const Columns phi = columns(phi_of_axes);
    const Array F = to_lanes<Axes>(F_of_axes);
    if (!(((F + phi[0] + phi[1]) * Scalar{0}).sum() == Scalar{0})) return;
    const Array exponent = Array::Constant(alpha_ * dt);
    const typename Flow::Forgetting forgetting{exponent, exponential_mean(exponent)};
    const auto seen = Gamma_.along(phi);
    const Array epsilon = phi[0] * theta_[0] + phi[1] * theta_[1] - F;
    const Columns K = Gamma_.downdate(seen, information(forgetting, dt, seen.s));
    Gamma_.scale(forgetting.growth());
    for (std::size_t j = 0; j < 2; ++j) theta_[j] -= K[j] * epsilon;
    const Array excess = (theta_[0].abs() - bound_[0]).max(theta_[1].abs() - bound_[1]);
    if (any_above(excess, Scalar{0})) theta_[0].setZero();
  }

  [[nodiscard]] Theta theta() const noexcept {
    Theta theta;
    for (int j = 0; j < 2; ++j) theta.col(j) = theta_[static_cast<std::size_t>(j)].template head<Axes>();
    return theta;
  }

 private:
  using Array = Lanes<Axes, Scalar>;
  using Columns = std::array<Array, 2>;
  using Flow = LeastSquaresFlow<Array>;

  static Columns columns(const Theta& values) noexcept {
    return {to_lanes<Axes>(values.col(0)), to_lanes<Axes>(values.col(1))};
  }

  [[nodiscard]] Array information(const typename Flow::Forgetting& forgetting, const Scalar& dt,
                                  const Array& s) const noexcept {
    if constexpr (gathering == Gathering::exact) return flow_.information(forgetting, dt, s);
    return dt * (Scalar{1} + nu_ * s).inverse();
  }

  Scalar alpha_, nu_;
  Flow flow_;
  Columns bound_, theta_;
  Form<Array> Gamma_;
};

/// (4.44)-(4.46) as differential equations of theta_hat and Gamma's upper triangle, by Euler or by RK4.
template <bool fourth_order, int Axes, typename Scalar>
class IntegratedLeastSquares {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, 2>;

  IntegratedLeastSquares(const Theta& initial, const Theta& gain, const Theta&, const Scalar& alpha, const Scalar& nu)
      : alpha_{alpha}, nu_{nu} {
    for (int j = 0; j < 2; ++j) {
      at_[static_cast<std::size_t>(j)] = to_lanes<Axes>(initial.col(j));
      at_[static_cast<std::size_t>(2 + j)] = to_lanes<Axes>(gain.col(j));
    }
    at_[4] = Array::Zero();
  }

  void update(const Scalar& dt, const Theta& phi_of_axes, const Vector& F_of_axes) noexcept {
    const Array x = to_lanes<Axes>(phi_of_axes.col(0));
    const Array v = to_lanes<Axes>(phi_of_axes.col(1));
    const Array F = to_lanes<Axes>(F_of_axes);
    const State k1 = slope(at_, x, v, F);
    if constexpr (!fourth_order) {
      at_ = sum(at_, dt, k1);
    } else {
      const Scalar half = dt / Scalar{2}, third = dt / Scalar{3};
      const State k2 = slope(sum(at_, half, k1), x, v, F), k3 = slope(sum(at_, half, k2), x, v, F);
      const State k4 = slope(sum(at_, dt, k3), x, v, F);
      at_ = sum(sum(sum(sum(at_, third / Scalar{2}, k1), third, k2), third, k3), third / Scalar{2}, k4);
    }
  }

  [[nodiscard]] Theta theta() const noexcept {
    Theta theta;
    theta.col(0) = at_[0].template head<Axes>();
    theta.col(1) = at_[1].template head<Axes>();
    return theta;
  }

 private:
  using Array = Lanes<Axes, Scalar>;
  using State = std::array<Array, 5>;  // theta, Gamma_11, Gamma_22, Gamma_12

  static State sum(const State& a, const Scalar& t, const State& b) noexcept {
    State result;
    for (std::size_t i = 0; i < 5; ++i) result[i] = a[i] + t * b[i];
    return result;
  }

  [[nodiscard]] State slope(const State& at, const Array& x, const Array& v, const Array& F) const noexcept {
    const Array p = at[2] * x + at[4] * v, q = at[4] * x + at[3] * v;
    const Array per_m = (Scalar{1} + nu_ * (x * p + v * q)).inverse();
    const Array epsilon = (x * at[0] + v * at[1] - F) * per_m;
    return {-p * epsilon, -q * epsilon, alpha_ * at[2] - p * p * per_m, alpha_ * at[3] - q * q * per_m,
            alpha_ * at[4] - p * q * per_m};
  }

  Scalar alpha_, nu_;
  State at_;
};

}  // namespace limpid::bench
