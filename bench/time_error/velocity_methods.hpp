// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid::bench {

/// (u(t + h) - u(t)) / h
template <int Axes, typename Scalar>
class Difference {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  Vector update(Time now, const Vector& u) noexcept {
    if (!started_) u_ = u;
    const Scalar h = started_ ? in_seconds<Scalar>(now - now_) : Scalar{1};
    const Vector y = (u - u_) / h;
    started_ = true;
    now_ = now;
    u_ = u;
    return y;
  }

 private:
  bool started_ = false;
  Time now_{};
  Vector u_;
};

enum class Rule { explicit_euler, implicit_euler, tustin };

/// (5.3), tau y' + y = u', by a rule: y(t + h) = keep y(t) + take (u(t + h) - u(t)).
template <Rule rule, int Axes, typename Scalar>
class RuledDerivative {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  explicit RuledDerivative(const Scalar& time_constant) : tau_{time_constant} {}

  Vector update(Time now, const Vector& u) noexcept {
    if (started_) {
      if (now - now_ != step_) set_step(now - now_);
      y_ = keep_ * y_ + take_ * (u - u_);
    }
    started_ = true;
    now_ = now;
    u_ = u;
    return y_;
  }

 private:
  void set_step(Duration step) noexcept {
    const Scalar h = in_seconds<Scalar>(step);
    step_ = step;
    const Scalar before = rule == Rule::explicit_euler ? h : rule == Rule::tustin ? Scalar(h / Scalar{2}) : Scalar{0};
    take_ = Scalar{1} / (tau_ + (h - before));
    keep_ = (tau_ - before) * take_;
  }

  Scalar tau_, keep_{}, take_{};
  Duration step_{};
  bool started_ = false;
  Time now_{};
  Vector u_ = Vector::Zero(), y_ = Vector::Zero();
};

/// Observer of position, velocity and acceleration with a triple pole: the fading-memory filter of second degree,
/// Morrison, Introduction to Sequential Smoothing and Prediction, 1969.
template <int Axes, typename Scalar>
class ThirdOrderObserver {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  explicit ThirdOrderObserver(const Scalar& time_constant) : tau_{time_constant} {}

  Vector update(Time now, const Vector& u) noexcept {
    if (!started_) {
      x_ = u;
    } else {
      if (now - now_ != step_) set_step(now - now_);
      const Vector x = x_ + h_ * v_ + half_square_ * a_, e = u - x;
      x_ = x + on_x_ * e;
      v_ += h_ * a_ + on_v_ * e;
      a_ += on_a_ * e;
    }
    started_ = true;
    now_ = now;
    return v_;
  }

 private:
  void set_step(Duration step) noexcept {
    using std::exp;
    step_ = step;
    h_ = in_seconds<Scalar>(step);
    half_square_ = h_ * h_ / Scalar{2};
    const Scalar pole = exp(Scalar(-h_ / tau_)), rest = Scalar{1} - pole;
    on_x_ = Scalar{1} - pole * pole * pole;
    on_v_ = Scalar{3} * rest * rest * (Scalar{1} + pole) / (Scalar{2} * h_);
    on_a_ = rest * rest * rest / (h_ * h_);
  }

  Scalar tau_, h_{}, half_square_{}, on_x_{}, on_v_{}, on_a_{};
  Duration step_{};
  bool started_ = false;
  Time now_{};
  Vector x_ = Vector::Zero(), v_ = Vector::Zero(), a_ = Vector::Zero();
};

}  // namespace limpid::bench
