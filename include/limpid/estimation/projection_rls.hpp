// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/lane_exponential.hpp>
#include <limpid/core/lane_select.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/estimation/any_above.hpp>
#include <limpid/estimation/box_projection.hpp>
#include <limpid/estimation/least_squares_flow.hpp>
#include <limpid/estimation/ud_factors.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>

namespace limpid {

/// Recursive least squares with forgetting and projection on a box, thesis (4.43)-(4.47); each axis for itself.
///
///     theta_hat' = Proj(-Gamma phi eps / (1 + nu phi' Gamma phi)),     eps = phi' theta_hat - F
///     Gamma'     = alpha Gamma - Gamma phi phi' Gamma / (1 + nu phi' Gamma phi)
///
/// A step is the exact solution of the law for phi and F held over it (`LeastSquaresFlow`), whatever its length; Gamma
/// is kept as U D U' and so definite by construction. It lies within 2e-15 of the law, by the series that serves all
/// but the first ticks; RK4 to 4e-7 in twice the time, one update a sample to 2e-2 in half of it, a symmetric Gamma is
/// a tenth faster and no more exact (bench/time_error). After 1e6 ticks of 1 ms (k, b, c) differ from the law in 50
/// digits by 2e-15, 3e-14, 4e-16 of their box in double and 5e-7, 1.3e-5, 3e-7 in float, Gamma by 5e-14 and 4e-6
/// (bench/stress). Two points of the law are read as follows.
///
/// Windup: (4.45) as printed stops altogether once lambda_max(Gamma) passes rho_M, and then never moves again. Here
/// only the forgetting stops: a step that starts from Gamma uses, in place of alpha, the largest alpha' <= alpha for
/// which exp(alpha' dt) lambda_max(Gamma) <= rho_M. lambda_max(Gamma) <= rho_M holds always, to the roundings of the
/// factors in one step (16 at most, of rho_M): the next step starts by taking them back, lest they add up. Where alpha'
/// would make up for eight of them or less it is 0, so that axes at rest take the series.
///
/// Projection: the step is taken freely and then brought back to the box in the metric of Gamma^-1 (`project_on_box`).
/// @tparam N     parameters of an axis
/// @realtime     update: no allocation, no throw, bounded work; some 150 flops an axis for N = 2, two thirds of them
///               for the step's u
template <int N, int Axes = 1, Real Scalar = double>
class ProjectionRLS {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, N>;      ///< row: axis, column: parameter
  using Regressor = Eigen::Array<Scalar, Axes, N>;  ///< row: axis, column: parameter
  using Gain = Eigen::Matrix<Scalar, N, N>;

  struct Settings {
    Theta lower = unset();          ///< corner of the box, in the parameters' units
    Theta upper = unset();          ///< the opposite corner, same units
    Theta initial = unset();        ///< theta_hat(0), within the box
    Theta initial_gain = unset();   ///< diagonal of Gamma(0), in parameter^2 / (N^2 s), <= gain_limit and > 0: at
                                    ///< least the factors' floor, the smallest normal number over epsilon
    Scalar forgetting = Scalar{2};  ///< alpha, 1/s, >= 0
    Scalar normalisation = Scalar{1} / Scalar{100};         ///< nu, s, >= 0, with alpha nu < 1
    Scalar gain_limit = Scalar{5} * Scalar{1'000'000'000};  ///< rho_M, bound on lambda_max(Gamma), units of the gain
  };

  /// Gamma = U D U'.
  struct Factors {
    Gain U;                         ///< unit upper triangular
    Eigen::Matrix<Scalar, N, 1> D;  ///< positive
  };

  /// @throws std::invalid_argument  where a setting is outside the range given at its field
  explicit ProjectionRLS(const Settings& settings)
      : lower_{columns(settings.lower)},
        upper_{columns(settings.upper)},
        alpha_{settings.forgetting},
        rho_M_{settings.gain_limit},
        flow_{alpha_, settings.normalisation},
        state_{columns(checked(settings).initial), Factorised{columns(settings.initial_gain)}} {}

  /// phi and F with the axes side by side, for a law that runs more than once with the same.
  class Held {
   public:
    /// @param phi  regressor phi_e,zd; row: axis
    /// @param F    measured force less its known part, N
    Held(const Regressor& phi, const Vector& F) noexcept : phi_{to_lane_columns<Axes>(phi)}, F_{to_lanes<Axes>(F)} {}

    /// Whether phi and F are finite and small enough to be squared.
    [[nodiscard]] bool is_finite() const noexcept { return have_squares(phi_, F_); }

   private:
    friend ProjectionRLS;
    std::array<Lanes<Axes, Scalar>, N> phi_;
    Lanes<Axes, Scalar> F_;
  };

  /// The law over `dt` seconds with `phi` and `F` held.
  /// @param phi  regressor phi_e,zd; row: axis
  /// @param F    measured force less its known part, N
  /// @return     not_finite (also where phi or F is too large to be squared, or the two together too large for the
  ///             step, or where D would fall below the factors' floor, the smallest normal number over epsilon) or
  ///             clock_backwards: nothing changed, on no axis; at_bound: the box held a parameter
  [[nodiscard]] Status update(const Scalar& dt, const Regressor& phi, const Vector& F) noexcept {
    return update(dt, Held(phi, F));
  }
  [[nodiscard]] Status update(const Scalar& dt, const Held& held) noexcept {
    return flat<Scalar>([&]() noexcept { return updated(dt, held.phi_, held.F_); });
  }

  /// theta_hat, always inside the box.
  [[nodiscard]] Theta theta() const noexcept {
    Theta theta;
    for (int j = 0; j < N; ++j) theta.col(j) = column(state_.theta, j).template head<Axes>();
    return theta;
  }

  /// Gamma of an axis, multiplied out; `factors` are what is definite to the last bit.
  [[nodiscard]] Gain gain(int axis) const noexcept { return state_.Gamma.product(axis); }
  [[nodiscard]] Factors factors(int axis) const noexcept { return {state_.Gamma.U(axis), state_.Gamma.D(axis)}; }

 private:
  using Array = Lanes<Axes, Scalar>;
  static constexpr int lanes = Array::SizeAtCompileTime;
  using Columns = std::array<Array, N>;
  using Factorised = UDFactors<N, Array>;
  using Flow = LeastSquaresFlow<Array>;
  struct State {
    Columns theta;
    Factorised Gamma;
  };

  static Theta unset() { return Theta::Constant(std::numeric_limits<Scalar>::quiet_NaN()); }

  static const Array& column(const Columns& columns, int j) { return columns[static_cast<std::size_t>(j)]; }

  static Columns columns(const Theta& values) noexcept { return to_lane_columns<Axes>(values); }

  [[nodiscard]] Status updated(const Scalar& dt, const Columns& phi, const Array& F) noexcept {
    if (!is_finite(dt) || !have_squares(phi, F)) return Status::not_finite;
    if (!(dt > Scalar{0})) return Status::clock_backwards;
    if (dt != dt_) set_step(dt);
    State next;
    next = state_;  // assigned, not constructed: by whole packets
    flow(next, dt, phi, F);
    const Status bound = project(next);
    // else phi and F are too large for the step
    if (!finite(next.theta, next.Gamma.sum()) || !next.Gamma.is_resolved()) return Status::not_finite;
    state_ = next;
    return bound;
  }

  // No measurement is as large, and the box would hide one that is. NaN compares false.
  static bool have_squares(const Columns& phi, const Array& F) noexcept {
    Array sum = F * F;
    for (const auto& entry : phi) sum += entry * entry;
    return sum.sum() <= std::numeric_limits<Scalar>::max();
  }

  // Zero times a finite number is zero, times any other it is NaN.
  static bool finite(const Columns& columns, Array sum) noexcept {
    const Scalar none{0};
    sum *= none;
    for (const auto& entry : columns) sum += entry * none;
    return are_finite(sum);
  }

  static std::string at_least_the_floor() {
    std::ostringstream text;
    text << ">= " << Factorised::floor() << " (the floor of the factors)";
    return text.str();
  }

  static const Settings& checked(const Settings& s) {
    expect(is_finite(s.lower), "ProjectionRLS: lower", "finite", s.lower);
    expect(is_finite(s.upper) && (s.upper >= s.lower).all(), "ProjectionRLS: upper", "finite and >= lower", s.upper);
    expect(is_finite(s.initial) && (s.initial >= s.lower).all() && (s.initial <= s.upper).all(),
           "ProjectionRLS: initial", "within lower and upper", s.initial);
    expect(is_finite(s.gain_limit) && s.gain_limit > Scalar{0}, "ProjectionRLS: gain_limit", "finite and > 0",
           s.gain_limit);
    expect(is_finite(Scalar(Scalar{4 * N} * s.gain_limit)), "ProjectionRLS: gain_limit",
           "so far from the largest number that N gains add up", s.gain_limit);
    expect(is_finite(s.initial_gain) && (s.initial_gain > Scalar{0}).all() && (s.initial_gain <= s.gain_limit).all(),
           "ProjectionRLS: initial_gain", "> 0 and <= gain_limit", s.initial_gain);
    expect((s.initial_gain >= Factorised::floor()).all(), "ProjectionRLS: initial_gain", at_least_the_floor(),
           s.initial_gain);
    expect(is_finite(s.forgetting) && s.forgetting >= Scalar{0}, "ProjectionRLS: forgetting", "finite and >= 0",
           s.forgetting);
    expect(is_finite(s.normalisation) && s.normalisation >= Scalar{0} && s.forgetting * s.normalisation < Scalar{1},
           "ProjectionRLS: normalisation", "finite, >= 0 and < 1 / forgetting (else no excitation bounds the gain)",
           s.normalisation);
    return s;
  }

  void flow(State& next, const Scalar& dt, const Columns& phi, const Array& F) const noexcept {
    typename Flow::Forgetting less;
    const auto& forgetting = windup(next.Gamma, less) ? less : forgetting_;
    const auto seen = next.Gamma.along(phi);
    Array epsilon = -F;
    for (std::size_t j = 0; j < phi.size(); ++j) epsilon += phi[j] * next.theta[j];
    const Columns K = next.Gamma.downdate(seen, flow_.information(forgetting, dt, seen.s));
    next.Gamma.scale(forgetting.growth());
    for (std::size_t j = 0; j < phi.size(); ++j) next.theta[j] -= K[j] * epsilon;
  }

  // alpha dt, less where Gamma would grow past rho_M; what roundings have taken past it is taken back.
  bool windup(Factorised& Gamma, typename Flow::Forgetting& less) const noexcept {
    if (!any_above(Array(forgetting_.growth() * Gamma.trace()), rho_M_)) [[likely]]  // trace >= lambda_max
      return false;
    forget_less(Gamma, less);
    return true;
  }

  void set_step(const Scalar& dt) noexcept {
    dt_ = dt;
    forgetting_.exponent = Array::Constant(alpha_ * dt);
    forgetting_.mean = exponential_mean(forgetting_.exponent);
  }

  // Apart, so that the tick without it stays small. At rest Gamma stays at rho_M, to roundings: it is left there.
  [[gnu::noinline]] void forget_less(Factorised& Gamma, typename Flow::Forgetting& less) const noexcept {
    flat<Scalar>([&]() noexcept {
      using Limits = std::numeric_limits<Scalar>;
      const Scalar none{0}, one{1}, two{2}, roundings = Scalar{4} * Limits::epsilon();
      const Array room = Gamma.largest_eigenvalue(one / rho_M_).inverse().min(Limits::max());  // rho_M / lambda_max
      Gamma.scale(room.min(one));
      const Array whole = forgetting_.growth() - one, free = (room - one).max(none).min(two * whole);
      if (any_above(Array((free - roundings).min(whole - free)), none)) {
        forget_partly(room, free, less);
      } else {
        const Array above = two * free - whole;  // far above zero or below
        less.exponent = where_positive<Array>(above, forgetting_.exponent, Array::Zero());
        less.mean = where_positive<Array>(above, forgetting_.mean, Array::Ones());
        less.extent = Flow::Extent::whole_or_none;
      }
    });
  }

  void forget_partly(const Array& room, const Array& free, typename Flow::Forgetting& less) const noexcept {
    less.exponent = logarithm_of_one_plus<Array>(free).min(forgetting_.exponent);
    less.mean = exponential_mean(less.exponent);
    less.extent = Flow::Extent::any;
    if (any_above(less.exponent, Scalar{1})) less.mean = kept_within(room, less);
  }

  // exp(log(room)) has more roundings than room, the larger the more.
  static Array kept_within(const Array& room, const typename Flow::Forgetting& less) noexcept {
    Array mean = less.mean;
    for (int lane = 0; lane < lanes; ++lane) {
      const Scalar exponent = less.exponent[lane];
      if (exponent > Scalar{1}) mean[lane] = std::min(mean[lane], Scalar((room[lane] - Scalar{1}) / exponent));
    }
    return mean;
  }

  Status project(State& next) const noexcept {
    Array excess = Array::Zero();
    for (std::size_t j = 0; j < lower_.size(); ++j) {
      excess = excess.max(lower_[j] - next.theta[j]).max(next.theta[j] - upper_[j]);
    }
    if (!any_above(excess, Scalar{0})) [[likely]]
      return Status::ok;
    for (int lane = 0; lane < Axes; ++lane) {
      if (excess[lane] > Scalar{0}) project_lane(next, lane);
    }
    for (auto& column : next.theta) column.template tail<lanes - Axes>().setConstant(column[Axes - 1]);
    return Status::at_bound;
  }

  [[gnu::noinline]] void project_lane(State& next, int lane) const noexcept {
    const auto nearest = project_on_box<N, Scalar>(next.Gamma.U(lane), next.Gamma.D(lane), row(next.theta, lane),
                                                   row(lower_, lane), row(upper_, lane));
    for (int j = 0; j < N; ++j) next.theta[static_cast<std::size_t>(j)][lane] = nearest[j];
  }

  static Eigen::Matrix<Scalar, N, 1> row(const Columns& columns, int lane) noexcept {
    Eigen::Matrix<Scalar, N, 1> row;
    for (int j = 0; j < N; ++j) row[j] = column(columns, j)[lane];
    return row;
  }

  Columns lower_, upper_;
  Scalar alpha_, rho_M_;
  Scalar dt_{0};                          // of the last step, for which forgetting_ is set
  typename Flow::Forgetting forgetting_;  // alpha dt
  Flow flow_;
  State state_;
};

}  // namespace limpid
