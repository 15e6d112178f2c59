// SPDX-License-Identifier: MIT
#pragma once

#include "tick/straightforward_tick.hpp"

#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace limpid::bench {

/// `StraightforwardTick` as one writes it who takes vectors and matrices of any size and does not think of where they
/// are kept. Same laws, same discretisations, hence the same torques.
class DynamicTick {
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;
  using In = const Eigen::Ref<const Vector>&;

 public:
  using Settings = StraightforwardTick::Settings;

  explicit DynamicTick(const Settings& settings)
      : s_{settings},
        L_{Eigen::RowVector2d(settings.L1, settings.L2)},
        lower_{settings.lower},
        upper_{settings.upper},
        wall_{settings.wall},
        Lambda_{settings.Lambda.asDiagonal()},
        Kd_{settings.Kd.asDiagonal()},
        Gamma_{settings.Gamma.asDiagonal()},
        theta_hat_{settings.theta0} {
    for (Axis& axis : axes_) {
      axis.theta = axis.held_theta = settings.initial;
      axis.Gamma = settings.initial_gain.asDiagonal();
      axis.past.resize(history, Vector::Zero(2));
    }
  }

  Vector step(Time now, In F_h, const ToolState<3>& tool, In q, In qdot) {
    const double h = started_ ? in_seconds(now - now_) : 0;
    const bool fresh = sample(now, tool);
    Vector x(3), v(3), a(3);
    for (int i = 0; i < 3; ++i) {
      Axis& axis = axes_[static_cast<std::size_t>(i)];
      if (started_ && sampled_) adapt(axis, h);
      if (started_) predict(axis, h, F_h_[i], F_h[i]);
      if (fresh) hold(axis, i);
      axis.held_theta = axis.theta;
      axis.past[next_] = axis.x;
      if (fresh) compare(axis);
      x[i] = axis.x[0];
      v[i] = axis.x[1];
      a[i] = acceleration(axis, F_h[i]);
    }
    times_[next_] = now;
    next_ = (next_ + 1) % history;
    if (fresh) sampled_ = true;
    const Vector tau = track(h, x + wall_, v, a, q, qdot, F_h);
    started_ = true;
    now_ = now;
    F_h_ = F_h;
    return tau;
  }

  /// Of an axis: (k, b), and Gamma.
  [[nodiscard]] Eigen::Vector2d theta(int axis) const { return axes_[static_cast<std::size_t>(axis)].theta; }
  [[nodiscard]] Eigen::Matrix2d Gamma(int axis) const { return axes_[static_cast<std::size_t>(axis)].Gamma; }

 private:
  static constexpr std::size_t history = 512;  // the delay is at least a tick
  static constexpr double l2 = 0.135, l3 = 0.130, g = 9.81;

  struct Axis {
    Vector theta, held_theta, phi = Vector::Zero(2);
    Matrix Gamma;
    double F = 0;
    Vector x = Vector::Zero(2), e = Vector::Zero(2);
    std::vector<Vector> past;
  };

  struct Sampled {
    Time taken{};
    Vector x, v, force;
  };

  // Sampled, delayed, held; true where a new sample arrives.
  bool sample(Time now, const ToolState<3>& tool) {
    if (now >= due_) {
      on_the_way_.push_back({now, tool.x, tool.v, tool.force});
      due_ = s_.period * (now / s_.period + 1);
    }
    bool fresh = false;
    while (!on_the_way_.empty() && on_the_way_.front().taken + s_.delay <= now) {
      seen_ = on_the_way_.front();
      on_the_way_.erase(on_the_way_.begin());
      fresh = true;
    }
    return fresh;
  }

  void hold(Axis& axis, int i) const {
    axis.phi << seen_.x[i], seen_.v[i];
    axis.F = seen_.force[i];
  }

  // (4.44)-(4.47), exact for a held sample: ProjectionRLS gives the equations.
  void adapt(Axis& axis, double h) const {
    const double tr = axis.Gamma.trace(), det = axis.Gamma.determinant();
    const double largest = tr / 2 + std::sqrt(std::max(0.0, tr * tr / 4 - det));
    double alpha = s_.alpha, T = 1 + std::expm1(alpha * h);
    if (T * largest > s_.rho_M) {
      T = std::max(1.0, s_.rho_M / largest);
      alpha = std::log(T) / h;
    }
    const Vector gain = axis.Gamma * axis.phi;
    const double s = axis.phi.dot(gain), epsilon = axis.phi.dot(axis.theta) - axis.F;
    const double u = StraightforwardTick::information(alpha > 0 ? (T - 1) / alpha : h, alpha * s_.nu, s_.nu, s);
    axis.theta -= gain * (epsilon * u / (1 + s * u));
    axis.Gamma = T * (axis.Gamma - gain * gain.transpose() * (u / (1 + s * u)));
    for (int j = 0; j < 2; ++j) {
      const double bound = std::min(std::max(axis.theta[j], lower_[j]), upper_[j]);
      if (bound != axis.theta[j]) axis.theta += axis.Gamma.col(j) * ((bound - axis.theta[j]) / axis.Gamma(j, j));
    }
    axis.theta = axis.theta.cwiseMax(lower_).cwiseMin(upper_);
  }

  // Exact step of (4.25) with the held parameters, by the closed form of exp(A h) for real and complex eigenvalues.
  void predict(Axis& axis, double h, double F0, double F1) const {
    const double m = s_.tool.mass, k = (s_.tool.stiffness + axis.held_theta[0]) / m;
    const double b = (s_.tool.damping + axis.held_theta[1]) / m, sigma = b / 2, d = sigma * sigma - k;
    const double w = std::sqrt(std::abs(d)), decay = std::exp(-sigma * h);
    const double C = decay * (d > 0 ? std::cosh(w * h) : std::cos(w * h));
    const double S = decay * (d > 0 ? std::sinh(w * h) / w : std::sin(w * h) / w);
    const Matrix I = Matrix::Identity(2, 2);
    Matrix A(2, 2), B(2, 1);
    A << 0, 1, -k, -b;
    B << 0, 1 / m;
    const Matrix Phi = C * I + S * (A + sigma * I), inverse = A.inverse();
    const Vector held = inverse * (Phi - I) * B, ramp = inverse * (held / h - B);
    const double feedback = (L_ * axis.e)(0);
    axis.x = Phi * axis.x + held * (F0 + feedback) + ramp * (F1 - F0);
  }

  void compare(Axis& axis) const {
    std::size_t at = (next_ + history - 1) % history;
    while (times_[at] != seen_.taken) at = (at + history - 1) % history;
    axis.e = axis.past[at] - axis.phi;
  }

  double acceleration(const Axis& axis, double F_h) const {
    return (F_h + (L_ * axis.e)(0) - (s_.tool.stiffness + axis.held_theta[0]) * axis.x[0] -
            (s_.tool.damping + axis.held_theta[1]) * axis.x[1]) /
           s_.tool.mass;
  }

  // (3.9)
  static Matrix jacobian(In q) {
    const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c23 = std::cos(q[1] + q[2]), s23 = std::sin(q[1] + q[2]);
    const double r = l2 * std::cos(q[1]) + l3 * c23, z = l2 * std::sin(q[1]) + l3 * s23;
    Matrix J(3, 3);
    J << -r * s1, -z * c1, -l3 * c1 * s23, r * c1, -z * s1, -l3 * s1 * s23, 0, r, l3 * c23;
    return J;
  }

  // (3.11)
  static Matrix jacobian_dot(In q, In qdot) {
    const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c23 = std::cos(q[1] + q[2]), s23 = std::sin(q[1] + q[2]);
    const double r = l2 * std::cos(q[1]) + l3 * c23, z = l2 * std::sin(q[1]) + l3 * s23;
    Matrix X(3, 3), Y(3, 3), Z(3, 3), J(3, 3);
    X << -r * c1, z * s1, l3 * s1 * s23, z * s1, -r * c1, -l3 * c1 * c23, l3 * s1 * s23, -l3 * c1 * c23, -l3 * c1 * c23;
    Y << r * s1, z * c1, l3 * c1 * s23, z * c1, r * s1, l3 * s1 * c23, l3 * c1 * s23, l3 * s1 * c23, l3 * s1 * c23;
    Z << 0, 0, 0, 0, z, l3 * s23, 0, l3 * s23, l3 * s23;
    J << qdot.transpose() * X, -qdot.transpose() * Y, -qdot.transpose() * Z;
    return J;
  }

  // (3.28)
  static Matrix regressor(In q, In v, In vr, In ar) {
    const double c2 = std::cos(q[1]), s2 = std::sin(q[1]), c3 = std::cos(q[2]), s3 = std::sin(q[2]);
    const double c23 = std::cos(q[1] + q[2]), s23 = std::sin(q[1] + q[2]), s223 = std::sin(2 * q[1] + q[2]);
    Matrix phi(3, 9);
    phi << ar[0], c2 * c2 * ar[0] - c2 * s2 * (v[1] * vr[0] + v[0] * vr[1]),
        c23 * c23 * ar[0] - c23 * s23 * (vr[0] * (v[1] + v[2]) + v[0] * (vr[1] + vr[2])),
        2 * c2 * c23 * ar[0] - s223 * (vr[0] * v[1] + v[0] * vr[1]) - c2 * s23 * (vr[0] * v[2] + v[0] * vr[2]), 0, 0,
        vr[0], 0, 0,  //
        0, ar[1] + c2 * s2 * v[0] * vr[0], ar[1] + ar[2] + c23 * s23 * v[0] * vr[0],
        2 * c3 * ar[1] + c3 * ar[2] + s223 * v[0] * vr[0] - s3 * ((vr[1] + vr[2]) * v[2] + v[1] * vr[2]), g * c2,
        g * c23, 0, vr[1], 0,  //
        0, 0, ar[1] + ar[2] + c23 * s23 * v[0] * vr[0], c3 * ar[1] + c2 * s23 * v[0] * vr[0] + s3 * v[1] * vr[1], 0,
        g * c23, 0, 0, vr[2];
    return phi;
  }

  // (3.3)-(3.6), (3.12), (3.14), then (4.1), (4.3), (4.7), (4.8)
  Vector track(double h, In x, In v, In a, In q, In qdot, In F_h) {
    const double r = std::hypot(x[0], x[1]);
    const double q3 = std::acos((l2 * l2 + l3 * l3 - r * r - x[2] * x[2]) / (2 * l2 * l3)) - std::acos(-1.0);
    Vector q_e(3);
    q_e << std::atan2(x[1], x[0]), std::atan2(x[2], r) + std::atan2(-l3 * std::sin(q3), l2 + l3 * std::cos(q3)), q3;
    const Matrix inverse = jacobian(q_e).inverse();
    const Vector qdot_e = inverse * v, qddot_e = inverse * (a - jacobian_dot(q_e, qdot_e) * qdot_e);

    const Vector qdot_r = qdot_e - Lambda_ * (q - q_e), qddot_r = qddot_e - Lambda_ * (qdot - qdot_e);
    const Vector delta = qdot - qdot_r;
    const Matrix phi_r = regressor(q, qdot, qdot_r, qddot_r);
    const Vector direction = phi_r.transpose() * delta;
    if (started_) theta_hat_ -= h / 2 * Gamma_ * (direction + direction_);
    direction_ = direction;
    return phi_r * theta_hat_ - Kd_ * delta - jacobian(q).transpose() * F_h;
  }

  Settings s_;
  Matrix L_;
  Vector lower_, upper_, wall_;
  Matrix Lambda_, Kd_, Gamma_;
  std::vector<Axis> axes_{3};
  std::vector<Time> times_ = std::vector<Time>(history);
  std::size_t next_ = 0;
  std::vector<Sampled> on_the_way_;
  Sampled seen_;
  Time due_{}, now_{};
  bool started_ = false, sampled_ = false;
  Vector F_h_ = Vector::Zero(3), theta_hat_, direction_ = Vector::Zero(9);
};

}  // namespace limpid::bench
