// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/frequency_response.hpp>
#include <limpid/design/gauss_quadrature.hpp>
#include <limpid/design/h2_norm.hpp>
#include <limpid/design/hinf_norm.hpp>
#include <limpid/design/transparency_model.hpp>
#include <limpid/design/transparency_problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace limpid::detail {

/// J, (11), and its slopes.
template <Real Scalar>
struct IndexSlopes {
  Scalar J{0};
  Scalar by_B_c{0}, by_K_c{0};
  Scalar error{0};  ///< of J
  NormVerdict verdict = NormVerdict::undecided;
};

/// The index of a stable loop with the exact hold, by quadrature of its difference to a rational one:
///
///     J = ||E_0||^2 + (1/pi) int_0^inf |E|^2 - |E_0|^2 dw,      E = w1 (Y_v - Y_t),  E_0 = w1 (Y_v - Y_0)
///     1/Y_0 = m s + b + (m r^2 - b r)/(s + r),                  r = sqrt(K/m)
///
/// Y_0 and Y_t agree to s^-2, so that the difference falls as w^-5 and its tail is bounded and small.
template <Real Scalar>
class ExactHoldIndex {
 public:
  using Complex = std::complex<Scalar>;

  ExactHoldIndex(const TransparencyProblem<Scalar>& problem, const WallFeedback<Scalar>& C)
      : problem_{problem}, C_{C}, m_{problem.plant.mass}, b_{problem.plant.damping} {
    using std::sqrt;
    r_ = sqrt(problem.wall.stiffness / m_);
    w1_ = balanced_states(problem.weight);
    // Where the weight lets through what is far above the hold's ripple, its bound serves the tail.
    if (w1_.A.norm() > ripple()) most_w1_ = hinf_norm(w1_).upper;
  }

  [[nodiscard]] IndexSlopes<Scalar> run() const {
    using std::abs, std::acos;
    const Scalar pi = acos(Scalar{-1}), period = ripple();
    const H2Norm<Scalar> reference = h2_norm(weighted_error(w1_, problem_.wall, reference_system()));
    if (reference.verdict != NormVerdict::finite) {
      return {reference.squared, Scalar{0}, Scalar{0}, infinity_of<Scalar>(), reference.verdict};
    }
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon(), scale = reference.squared;
    const Scalar most =
        std::min<Scalar>(Scalar(512) * std::max<Scalar>(period, w1_.A.norm()), Scalar(most_periods) * period);
    Scalar end = Scalar{4} * period;
    while (end < most && !(tail(end) <= epsilon * scale)) end *= Scalar{2};
    // Parts that double from far below the slowest rate to a period of the hold's ripple, which then they keep.
    const GaussQuadrature<Scalar, 3> quadrature;
    std::array<Scalar, 3> sum{};
    Scalar error = tail(end), from{0}, to = period / Scalar(4096);
    while (from < end) {
      const auto part = quadrature.integrate([this](const Scalar& omega) { return integrand(omega); }, from, to,
                                             pi * Scalar(16) * epsilon * scale);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += part.value[k] / pi;
      error += part.error / pi;
      from = to;
      to = std::min<Scalar>(end, from + std::min<Scalar>(from, period));
    }
    error += Scalar(256) * epsilon * scale;
    const Scalar J = scale + sum[0];
    if (!is_finite(J)) return {infinity_of<Scalar>(), Scalar{0}, Scalar{0}, infinity_of<Scalar>()};
    return {J, sum[1], sum[2], error, NormVerdict::finite};
  }

 private:
  static constexpr int most_periods = 4096;

  /// Of the hold, rad/s.
  [[nodiscard]] Scalar ripple() const {
    using std::acos;
    return Scalar{2} * acos(Scalar{-1}) / problem_.period;
  }
  [[nodiscard]] Scalar rho() const { return r_ * (m_ * r_ - b_); }

  // Y_0 = (s + r)/(m (s^2 + (r + b/m) s + r^2))
  [[nodiscard]] StateSpace<Scalar> reference_system() const {
    using Matrix = DynamicMatrix<Scalar>;
    StateSpace<Scalar> Y{Matrix::Zero(2, 2), Matrix::Zero(2, 1), Matrix::Zero(1, 2), Matrix::Zero(1, 1)};
    Y.A << -(r_ + b_ / m_), -r_, r_, Scalar{0};
    Y.B(0, 0) = Scalar{1} / m_;
    Y.C << Scalar{1}, Scalar{1};
    return Y;
  }

  // |E|^2 - |E_0|^2 and the slopes of |E|^2: dY_t/dC = -ZOH Y_t^2, dC/dB_c = 1, dC/dK_c = 1/s.
  [[nodiscard]] std::array<Scalar, 3> integrand(const Scalar& omega) const {
    const Complex s(Scalar{0}, omega), q = characteristic(problem_, C_, omega);
    const Complex Z = exact_hold(omega, problem_.period);
    const Complex Y = s / q, Y_v = s / Complex(problem_.wall.stiffness, problem_.wall.damping * omega);
    const Complex Y_0 = (s + r_) / (m_ * (s * s + (r_ + b_ / m_) * s + r_ * r_));
    const Complex w1 = response_at(w1_, s)(0, 0);
    const Scalar weight = w1.real() * w1.real() + w1.imag() * w1.imag();
    const Complex error = Y_v - Y, both = error + (Y_v - Y_0), difference = Y_0 - Y;
    const Complex by_K_c = Z * Y / q, by_B_c = Z * Y * Y;
    const auto real_part = [](const Complex& a, const Complex& b) -> Scalar {
      return a.real() * b.real() + a.imag() * b.imag();
    };
    return {weight * real_part(both, difference), Scalar{2} * weight * real_part(error, by_B_c),
            Scalar{2} * weight * real_part(error, by_K_c)};
  }

  /// A bound of the integral beyond `end`: the integrand falls at least as w^-5 from its bound there, or as w^-2 where
  /// nothing but a bound of w1 is known, by
  ///
  ///     Y_t - Y_0 = (rho/(s + r) - ZOH C) Y_t Y_0,   |ms + b + x| >= m w - |x|,   |w1| <= |C||B|/(w - |A|)
  [[nodiscard]] Scalar tail(const Scalar& end) const {
    using std::abs, std::acos;
    const auto& [K, B] = problem_.wall;
    const Scalar control = Scalar{2} / (end * problem_.period) * (abs(C_.B_c) + abs(C_.K_c) / end);
    const Scalar bend = abs(rho()) / end, least = m_ * end - control, least_0 = m_ * end - bend;
    if (!(least > Scalar{0}) || !(least_0 > Scalar{0})) return infinity_of<Scalar>();
    const Scalar difference = (bend + control) / (least * least_0);
    const Scalar room = end - w1_.A.norm();
    Scalar w1 = room > Scalar{0} ? Scalar(w1_.C.norm() * w1_.B.norm() / room) : infinity_of<Scalar>(), felt = end / K;
    if (B > Scalar{0}) {
      felt = std::min<Scalar>(felt, Scalar{1} / B);
    } else {
      w1 *= w1_.A.norm() / end;  // C B = 0
    }
    const bool falls = !(most_w1_ < w1);
    w1 = std::min<Scalar>(w1, most_w1_);
    const Scalar bound = w1 * w1 * difference * (Scalar{2} * (felt + Scalar{1} / least_0) + difference);
    return bound * end / ((falls ? Scalar{3} : Scalar{1}) * acos(Scalar{-1}));  // w^-4 where felt still grows
  }

  TransparencyProblem<Scalar> problem_;
  WallFeedback<Scalar> C_;
  Scalar m_, b_, r_{0}, most_w1_ = infinity_of<Scalar>();
  StateSpace<Scalar> w1_;
};

}  // namespace limpid::detail
