// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/ball.hpp>
#include <limpid/design/mean_value_form.hpp>
#include <limpid/design/second_order_flow.hpp>

#include <cmath>
#include <limits>

namespace limpid::detail {

/// cosh(sqrt z), sinh(sqrt z)/sqrt z and the derivative of the second, entire functions of z >= or < 0.
///
///     C' = S/2,   S(z) = int_0^1 C(z t^2) dt,   C(4 z) = 2 C(z)^2 - 1,   S(4 z) = C(z) S(z)
template <Real Scalar>
struct HyperbolicBalls {
  Ball<Scalar> C, S, S1;
};

/// At one exact z: the power series on |z| <= 1, quadrupled until it spans z.
template <Real Scalar>
[[nodiscard]] HyperbolicBalls<Scalar> hyperbolic_at(Scalar z) {
  using std::abs;
  using Number = Ball<Scalar>;
  constexpr int most_quadruplings = 30;
  int quadruplings = 0;
  for (; abs(z) > Scalar{1} && quadruplings < most_quadruplings; ++quadruplings) z /= Scalar{4};
  if (!(abs(z) <= Scalar{1})) return {Number::whole_line(), Number::whole_line(), Number::whole_line()};
  // term = z^n/(2n)!; C sums it, S term/(2n+1), S1 its derivative (n+1) z^n/(2n+3)!.
  Scalar term{1}, C{0}, S{0}, S1{0};
  int n = 0;
  for (; abs(term) > std::numeric_limits<Scalar>::epsilon() / Scalar{8}; ++n) {
    const Scalar odd = term / Scalar(2 * n + 1);
    C += term;
    S += odd;
    S1 += odd * Scalar(n + 1) / Scalar((2 * n + 2) * (2 * n + 3));
    term *= z / Scalar((2 * n + 1) * (2 * n + 2));
  }
  // Each sum has lost less than 4 n eps of cosh(1), its rest is below 2 term.
  const Scalar lost = Scalar(8 * n + 2) * std::numeric_limits<Scalar>::epsilon();
  HyperbolicBalls<Scalar> at{{C, lost}, {S, lost}, {S1, lost}};
  for (; quadruplings > 0; --quadruplings) {
    at.S1 = (square(at.S) * Number{Scalar{1} / Scalar{2}} + at.C * at.S1) * Number{Scalar{1} / Scalar{4}};
    at.S = at.C * at.S;
    at.C = Number{Scalar{2}} * square(at.C) - Number{Scalar{1}};
  }
  return at;
}

/// Over a ball, from what holds at its centre: by bounds of S/2, S1 and S1' that hold at its top.
///
/// For z <= 0 they are below 1/2, 1/6 and 1/60, for z > 0 below that times C, and below C/(2 sqrt z), C/(2 z) and
/// C/(4 z sqrt z).
template <Real Scalar>
[[nodiscard]] HyperbolicBalls<Scalar> hyperbolic_over(const HyperbolicBalls<Scalar>& at_centre, const Ball<Scalar>& z) {
  using Number = Ball<Scalar>;
  const Scalar top = z.upper(), bottom = z.lower();
  const Number half{Scalar{1} / Scalar{2}};
  const Scalar C = top > Scalar{0} ? (half + half * exp(sqrt(Number{top}))).magnitude() : Scalar{1};
  const Number change{Scalar{0}, (Number{z.radius()} * Number{C}).magnitude()};
  Number first = half, second = Number{Scalar{1}} / Number{Scalar{6}}, third = Number{Scalar{1}} / Number{Scalar{60}};
  if (bottom > Scalar{8}) {
    const Number root = Number{Scalar{1}} / sqrt(Number{bottom});
    first = half * root;
    second = first * root;
    third = second * half * root;
  }
  return {at_centre.C + change * first, at_centre.S + change * second, at_centre.S1 + change * third};
}

/// s by its power series over a piece of h short enough, doubled until it spans h: nothing is divided by kappa, but the
/// bounds are wider than those of (1 - phi11)/kappa where kappa is not small.
template <Real Scalar>
[[nodiscard]] MeanValueForm<Scalar> step_response_by_doubling(const MeanValueForm<Scalar>& kappa,
                                                              const MeanValueForm<Scalar>& beta, Ball<Scalar> h) {
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;
  const Number one{Scalar{1}}, half{Scalar{1} / Scalar{2}};
  const auto is_short = [&] {
    return (beta.range() * h).magnitude() <= half.centre() &&
           (kappa.range() * h * h).magnitude() <= Scalar{1} / Scalar{4};
  };
  int doublings = 0;
  for (; !is_short() && doublings < 60; ++doublings) h *= half;
  if (!is_short()) return Form{Number::whole_line()};
  // s/h^2 = sum s_n, (n + 1) n s_(n+1) = -n B s_n - K s_(n-1), |s_n| < 1/n!; g/h = sum n s_n
  const Form B = h * beta, K = h * (h * kappa);
  Form older{}, newer{half}, s = newer, g{one};
  Scalar bound{1};  // of the terms left out, half
  for (int n = 2; bound > std::numeric_limits<Scalar>::epsilon() / Scalar{8}; ++n) {
    const Form next =
        Number{Scalar{-1}} / Number{Scalar(n + 1)} * (B * newer) - one / Number{Scalar(n * (n + 1))} * (K * older);
    s += next;
    g += Number{Scalar(n + 1)} * next;
    older = newer;
    newer = next;
    bound /= Scalar(n + 1);
  }
  const Form rest{Number{Scalar{0}, Scalar{2} * bound}};
  s = h * (h * (s + rest));
  g = h * (g + rest);
  for (; doublings > 0; --doublings) {
    const Form phi11 = Form{one} - kappa * s, phi22 = phi11 - beta * g;
    s = s + phi11 * s + square(g);
    g = g * (phi11 + phi22);
  }
  return s;
}

/// The flow over a cell of (kappa, beta). With alpha = beta h/2, z = alpha^2 - kappa h^2:
///
///     Phi = exp(-alpha) [C + alpha S, h S; -kappa h S, C - alpha S],   g = exp(-alpha) h S,   kappa s = 1 - phi11
template <Real Scalar>
[[nodiscard]] SecondOrderFlow<MeanValueForm<Scalar>> enclose_second_order_flow(const MeanValueForm<Scalar>& kappa,
                                                                               const MeanValueForm<Scalar>& beta,
                                                                               const Ball<Scalar>& h) {
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;
  const Number half{Scalar{1} / Scalar{2}};
  const Form alpha = half * h * beta, K = h * h * kappa, z = square(alpha) - K, decay = exp(-alpha);
  const Number range = z.range();
  // Bounds at a distance from the centre's centre hold for the centre's ball and for the range.
  const HyperbolicBalls<Scalar> at = hyperbolic_at(z.centre().centre()), near = hyperbolic_over(at, z.centre()),
                                over = hyperbolic_over(at, range);
  const Form C = decay * Form::of(z, near.C, half * over.S), S = decay * Form::of(z, near.S, over.S1);
  const Form phi11 = C + alpha * S, phi22 = C - alpha * S;
  const bool divisible = (K.range() - Number{Scalar{1} / Scalar{16}}).certainly_positive();
  const Form s = divisible ? (Form{Number{Scalar{1}}} - phi11) / kappa : step_response_by_doubling(kappa, beta, h);
  return {Number{Scalar{2}} * C, square(decay), phi11, phi22, s, h * S};
}

}  // namespace limpid::detail
