// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/held_step.hpp>
#include <limpid/core/lanes.hpp>

#include <Eigen/Core>

namespace limpid::bench {

/// A step of x'' + beta x' + kappa x = f with the interface of SecondOrderStep, axes in lanes as there.
template <template <typename> class Law, int Axes, typename Scalar>
class OnLanes {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  void set(const Vector& kappa, const Vector& beta, const Scalar& h) noexcept {
    law_.set(lanes(kappa), lanes(beta), h);
  }

  void advance(Vector& x, Vector& v, const Vector& f0, const Vector& f1) const noexcept {
    Array X = lanes(x), V = lanes(v);
    law_.advance(X, V, lanes(f0), lanes(f1));
    x = X.template head<Axes>();
    v = V.template head<Axes>();
  }

 private:
  using Array = Lanes<Axes, Scalar>;
  static Array lanes(const Vector& values) noexcept { return to_lanes<Axes>(values); }
  Law<Array> law_;
};

template <typename Array>
struct ExplicitEuler {
  using Scalar = typename Array::Scalar;
  Array k, b;
  Scalar h;

  void set(const Array& kappa, const Array& beta, const Scalar& length) noexcept {
    k = kappa;
    b = beta;
    h = length;
  }
  void advance(Array& x, Array& v, const Array& f0, const Array&) const noexcept {
    const Array a = f0 - k * x - b * v;
    x += h * v;
    v += h * a;
  }
};

template <typename Array>
struct SemiImplicitEuler : ExplicitEuler<Array> {
  void advance(Array& x, Array& v, const Array& f0, const Array&) const noexcept {
    v += this->h * (f0 - this->k * x - this->b * v);
    x += this->h * v;
  }
};

/// The trapezoidal rule, solved for (x, v): everything that does not depend on them is made in `set`.
template <typename Array>
struct Tustin {
  using Scalar = typename Array::Scalar;
  Array stay, pull, push, x_from_x, x_from_v, x_from_f;

  void set(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    const Scalar half = h / Scalar{2};
    const Array implicit = half * (beta + half * kappa), inverse = (Scalar{1} + implicit).inverse();
    stay = (Scalar{1} - implicit) * inverse;
    pull = -h * kappa * inverse;
    push = half * inverse;
    x_from_x = Scalar{1} + half * pull;
    x_from_v = half + half * stay;
    x_from_f = half * push;
  }
  void advance(Array& x, Array& v, const Array& f0, const Array& f1) const noexcept {
    const Array x0 = x, v0 = v, f = f0 + f1;
    x = x_from_f * f + x_from_v * v0 + x_from_x * x0;
    v = push * f + stay * v0 + pull * x0;
  }
};

template <typename Array>
struct RungeKutta4 : ExplicitEuler<Array> {
  using typename ExplicitEuler<Array>::Scalar;
  using ExplicitEuler<Array>::h;

  void advance(Array& x, Array& v, const Array& f0, const Array& f1) const noexcept {
    const Scalar half = h / Scalar{2}, sixth = h / Scalar{6};
    const Array middle = (f0 + f1) * (Scalar{1} / Scalar{2});
    const Array v1 = v, a1 = slope(f0, x, v1);
    const Array v2 = v + half * a1, a2 = slope(middle, x + half * v1, v2);
    const Array v3 = v + half * a2, a3 = slope(middle, x + half * v2, v3);
    const Array v4 = v + h * a3, a4 = slope(f1, x + h * v3, v4);
    x += sixth * (v1 + Scalar{2} * (v2 + v3) + v4);
    v += sixth * (a1 + Scalar{2} * (a2 + a3) + a4);
  }
  EIGEN_ALWAYS_INLINE Array slope(const Array& f, const Array& x, const Array& v) const noexcept {
    return f - this->k * x - this->b * v;
  }
};

/// From the responses to an impulse, a step and a ramp, as SecondOrderStep.
template <typename Array>
struct FromResponses {
  using Scalar = typename Array::Scalar;
  Array g, s, r, x_from_x, v_from_x, v_from_v;
  Scalar rate;

  void use(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    x_from_x = Scalar{1} - kappa * s;
    v_from_x = -kappa * g;
    v_from_v = x_from_x - beta * g;
    rate = Scalar{1} / h;
  }
  void advance(Array& x, Array& v, const Array& f0, const Array& f1) const noexcept {
    const Array x0 = x, v0 = v, slope = (f1 - f0) * rate;
    x = r * slope + s * f0 + x_from_x * x0 + g * v0;  // f first: the chain from step to step is two products long
    v = s * slope + g * f0 + v_from_x * x0 + v_from_v * v0;
  }
};

/// Sine or hyperbolic sine, whichever the damping asks for; kappa not zero.
template <typename Array>
struct ClosedForm : FromResponses<Array> {
  using typename FromResponses<Array>::Scalar;

  void set(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    using std::abs, std::sqrt, std::exp, std::cos, std::cosh, std::sin, std::sinh;
    for (int i = 0; i < kappa.size(); ++i) {
      const Scalar k = kappa[i];
      const Scalar sigma = beta[i] / 2, d = sigma * sigma - k, w = sqrt(Scalar(abs(d))), wh = w * h;
      const Scalar decay = exp(Scalar(-sigma * h));
      const Scalar C = decay * (d > Scalar{0} ? Scalar(cosh(wh)) : Scalar(cos(wh)));
      const Scalar S = decay * (d > Scalar{0} ? Scalar(sinh(wh)) : Scalar(sin(wh))) / w;
      this->g[i] = S;
      this->s[i] = (Scalar{1} - C - sigma * S) / k;
      this->r[i] = (h - beta[i] * this->s[i] - S) / k;
    }
    this->use(kappa, beta, h);
  }
};

/// exp(A h) of (x, v, f, f') by the library's general series.
template <typename Array>
struct MatrixExponential : FromResponses<Array> {
  using typename FromResponses<Array>::Scalar;

  void set(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    using Matrix = Eigen::Matrix<Scalar, 4, 4>;
    for (int i = 0; i < kappa.size(); ++i) {
      Matrix A = Matrix::Zero();
      A(0, 1) = A(1, 2) = A(2, 3) = Scalar{1};
      A(1, 0) = -kappa[i];
      A(1, 1) = -beta[i];
      const Matrix Phi = held_step(A, h).Phi;
      this->g[i] = Phi(0, 1);
      this->s[i] = Phi(0, 2);
      this->r[i] = Phi(0, 3);
    }
    this->use(kappa, beta, h);
  }
};

}  // namespace limpid::bench
