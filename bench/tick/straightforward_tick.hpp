// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstddef>

namespace limpid::bench {

/// The tick of a palpation as one would write it first: fixed-size Eigen, axis by axis, equation by equation, without
/// a thought for sparsity or shared work. Same laws, same discretisations, hence the same torques as the library's.
class StraightforwardTick {
 public:
  struct Settings {
    Tool<3> tool;
    Eigen::Vector2d lower{200, 20}, upper{2000, 40}, initial{1100, 30}, initial_gain{1e9, 8e6};
    double alpha = 2, nu = 0.01, rho_M = 5e9;
    double L1 = 0, L2 = 0;
    Duration period, delay;
    Eigen::Vector3d wall, Lambda, Kd;
    Eigen::Matrix<double, 9, 1> Gamma, theta0;
  };

  explicit StraightforwardTick(const Settings& settings) : s_{settings}, theta_hat_{settings.theta0} {
    for (Axis& axis : axes_) {
      axis.theta = settings.initial;
      axis.held_theta = settings.initial;
      axis.Gamma = settings.initial_gain.asDiagonal();
    }
  }

  /// @param obeyed  whether the device had the torque that the last step gave
  Eigen::Vector3d step(Time now, const Eigen::Vector3d& F_h, const ToolState<3>& tool, const Eigen::Vector3d& q,
                       const Eigen::Vector3d& qdot, bool obeyed = true) {
    const double h = started_ ? in_seconds(now - now_) : 0;
    const bool fresh = sample(now, tool);
    Eigen::Vector3d x, v, a;
    for (int i = 0; i < 3; ++i) {
      Axis& axis = axes_[static_cast<std::size_t>(i)];
      if (started_ && sampled_) adapt(axis, h);
      if (started_) predict(axis, h, F_h_[i], F_h[i]);
      if (fresh) hold(axis, i);
      axis.held_theta = axis.theta;
      remember(axis);
      if (fresh) compare(axis);
      x[i] = axis.x[0];
      v[i] = axis.x[1];
      a[i] = acceleration(axis, F_h[i]);
    }
    times_[next_] = now;
    next_ = (next_ + 1) % history;
    if (fresh) sampled_ = true;
    const Eigen::Vector3d tau = track(obeyed ? h : 0, x + s_.wall, v, a, q, qdot, F_h);
    started_ = true;
    now_ = now;
    F_h_ = F_h;
    return tau;
  }

  // The root u of tau = E + (u - p' / s) / (1 - p), by Newton's iteration.
  static double information(double tau, double p, double nu, double s) {
    if (s < 1e-300) return tau;
    double l = s * tau / (1 + nu * s);
    for (int i = 0; i < 3; ++i) {
      const double whole = std::expm1(l), part = p > 0 ? std::expm1(p * l) : 0;
      const double f = (whole - part) / (1 - p) + nu * s * (p > 0 ? part / p : l) - s * tau;
      const double slope = (whole + 1 - p * (part + 1)) / (1 - p) + nu * s * (part + 1);
      l -= f / slope;
    }
    return std::expm1(l) / s;
  }

  /// Of an axis: (k, b), and Gamma.
  [[nodiscard]] Eigen::Vector2d theta(int axis) const { return axes_[static_cast<std::size_t>(axis)].theta; }
  [[nodiscard]] Eigen::Matrix2d Gamma(int axis) const { return axes_[static_cast<std::size_t>(axis)].Gamma; }

 private:
  static constexpr std::size_t history = 512;  // the delay is at least a tick
  static constexpr double l2 = 0.135, l3 = 0.130, g = 9.81;

  struct Axis {
    Eigen::Vector2d theta, held_theta;
    Eigen::Matrix2d Gamma;
    Eigen::Vector2d phi = Eigen::Vector2d::Zero();
    double F = 0;
    Eigen::Vector2d x = Eigen::Vector2d::Zero(), e = Eigen::Vector2d::Zero();
    std::array<Eigen::Vector2d, history> past{};
  };

  struct Sampled {
    Time taken{};
    ToolState<3> tool{};
  };

  // Sampled, delayed, held; true where a new sample arrives.
  bool sample(Time now, const ToolState<3>& tool) {
    if (now >= due_) {
      on_the_way_[sent_++ % 64] = {now, tool};
      due_ = s_.period * (now / s_.period + 1);
    }
    bool fresh = false;
    while (arrived_ < sent_ && on_the_way_[arrived_ % 64].taken + s_.delay <= now) {
      seen_ = on_the_way_[arrived_++ % 64];
      fresh = true;
    }
    return fresh;
  }

  void hold(Axis& axis, int i) const {
    axis.phi << seen_.tool.x[i], seen_.tool.v[i];
    axis.F = seen_.tool.force[i];
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
    const Eigen::Vector2d gain = axis.Gamma * axis.phi;
    const double s = axis.phi.dot(gain), epsilon = axis.phi.dot(axis.theta) - axis.F;
    const double u = information(alpha > 0 ? (T - 1) / alpha : h, alpha * s_.nu, s_.nu, s);
    axis.theta -= gain * (epsilon * u / (1 + s * u));
    axis.Gamma = T * (axis.Gamma - gain * gain.transpose() * (u / (1 + s * u)));
    project(axis);
  }

  void project(Axis& axis) const {
    for (int j = 0; j < 2; ++j) {
      const double bound = std::min(std::max(axis.theta[j], s_.lower[j]), s_.upper[j]);
      if (bound != axis.theta[j]) axis.theta += axis.Gamma.col(j) * ((bound - axis.theta[j]) / axis.Gamma(j, j));
    }
    axis.theta = axis.theta.cwiseMax(s_.lower).cwiseMin(s_.upper);
  }

  // Exact step of (4.25) with the held parameters, by the closed form of exp(A h) for real and complex eigenvalues.
  void predict(Axis& axis, double h, double F0, double F1) const {
    const double m = s_.tool.mass, k = (s_.tool.stiffness + axis.held_theta[0]) / m;
    const double b = (s_.tool.damping + axis.held_theta[1]) / m, sigma = b / 2, d = sigma * sigma - k;
    const double w = std::sqrt(std::abs(d)), decay = std::exp(-sigma * h);
    const double C = decay * (d > 0 ? std::cosh(w * h) : std::cos(w * h));
    const double S = decay * (d > 0 ? std::sinh(w * h) / w : std::sin(w * h) / w);
    Eigen::Matrix2d A, Phi;
    A << 0, 1, -k, -b;
    Phi = C * Eigen::Matrix2d::Identity() + S * (A + sigma * Eigen::Matrix2d::Identity());
    const Eigen::Vector2d B(0, 1 / m);
    const Eigen::Matrix2d inverse = A.inverse();
    const Eigen::Vector2d held = inverse * (Phi - Eigen::Matrix2d::Identity()) * B;
    const Eigen::Vector2d ramp = inverse * (held / h - B);
    const double feedback = s_.L1 * axis.e[0] + s_.L2 * axis.e[1];
    axis.x = Phi * axis.x + held * (F0 + feedback) + ramp * (F1 - F0);
  }

  void remember(Axis& axis) { axis.past[next_] = axis.x; }

  void compare(Axis& axis) const {
    std::size_t at = (next_ + history - 1) % history;
    while (times_[at] != seen_.taken) at = (at + history - 1) % history;
    axis.e = axis.past[at] - axis.phi;
  }

  double acceleration(const Axis& axis, double F_h) const {
    const double feedback = s_.L1 * axis.e[0] + s_.L2 * axis.e[1];
    return (F_h + feedback - (s_.tool.stiffness + axis.held_theta[0]) * axis.x[0] -
            (s_.tool.damping + axis.held_theta[1]) * axis.x[1]) /
           s_.tool.mass;
  }

  // (3.9)
  static Eigen::Matrix3d jacobian(const Eigen::Vector3d& q) {
    const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c23 = std::cos(q[1] + q[2]), s23 = std::sin(q[1] + q[2]);
    const double r = l2 * std::cos(q[1]) + l3 * c23, z = l2 * std::sin(q[1]) + l3 * s23;
    Eigen::Matrix3d J;
    J << -r * s1, -z * c1, -l3 * c1 * s23, r * c1, -z * s1, -l3 * s1 * s23, 0, r, l3 * c23;
    return J;
  }

  // (3.11)
  static Eigen::Matrix3d jacobian_dot(const Eigen::Vector3d& q, const Eigen::Vector3d& qdot) {
    const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c23 = std::cos(q[1] + q[2]), s23 = std::sin(q[1] + q[2]);
    const double r = l2 * std::cos(q[1]) + l3 * c23, z = l2 * std::sin(q[1]) + l3 * s23;
    Eigen::Matrix3d X, Y, Z, J;
    X << -r * c1, z * s1, l3 * s1 * s23, z * s1, -r * c1, -l3 * c1 * c23, l3 * s1 * s23, -l3 * c1 * c23, -l3 * c1 * c23;
    Y << r * s1, z * c1, l3 * c1 * s23, z * c1, r * s1, l3 * s1 * c23, l3 * c1 * s23, l3 * s1 * c23, l3 * s1 * c23;
    Z << 0, 0, 0, 0, z, l3 * s23, 0, l3 * s23, l3 * s23;
    J << qdot.transpose() * X, -qdot.transpose() * Y, -qdot.transpose() * Z;
    return J;
  }

  // (3.28)
  static Eigen::Matrix<double, 3, 9> regressor(const Eigen::Vector3d& q, const Eigen::Vector3d& v,
                                               const Eigen::Vector3d& vr, const Eigen::Vector3d& ar) {
    const double c2 = std::cos(q[1]), s2 = std::sin(q[1]), c3 = std::cos(q[2]), s3 = std::sin(q[2]);
    const double c23 = std::cos(q[1] + q[2]), s23 = std::sin(q[1] + q[2]), s223 = std::sin(2 * q[1] + q[2]);
    Eigen::Matrix<double, 3, 9> phi;
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
  Eigen::Vector3d track(double h, const Eigen::Vector3d& x, const Eigen::Vector3d& v, const Eigen::Vector3d& a,
                        const Eigen::Vector3d& q, const Eigen::Vector3d& qdot, const Eigen::Vector3d& F_h) {
    const double r = std::hypot(x[0], x[1]);
    const double q3 = std::acos((l2 * l2 + l3 * l3 - r * r - x[2] * x[2]) / (2 * l2 * l3)) - std::acos(-1.0);
    const Eigen::Vector3d q_e(std::atan2(x[1], x[0]),
                              std::atan2(x[2], r) + std::atan2(-l3 * std::sin(q3), l2 + l3 * std::cos(q3)), q3);
    const Eigen::Matrix3d inverse = jacobian(q_e).inverse();
    const Eigen::Vector3d qdot_e = inverse * v;
    const Eigen::Vector3d qddot_e = inverse * (a - jacobian_dot(q_e, qdot_e) * qdot_e);

    const Eigen::Vector3d qdot_r = qdot_e - s_.Lambda.cwiseProduct(q - q_e);
    const Eigen::Vector3d qddot_r = qddot_e - s_.Lambda.cwiseProduct(qdot - qdot_e), delta = qdot - qdot_r;
    const Eigen::Matrix<double, 3, 9> phi_r = regressor(q, qdot, qdot_r, qddot_r);
    const Eigen::Matrix<double, 9, 1> direction = phi_r.transpose() * delta;
    if (started_) theta_hat_ -= h / 2 * s_.Gamma.cwiseProduct(direction + direction_);
    direction_ = direction;
    return phi_r * theta_hat_ - s_.Kd.cwiseProduct(delta) - jacobian(q).transpose() * F_h;
  }

  Settings s_;
  std::array<Axis, 3> axes_{};
  std::array<Time, history> times_{};
  std::size_t next_ = 0;
  std::array<Sampled, 64> on_the_way_{};
  std::size_t sent_ = 0, arrived_ = 0;
  Sampled seen_{};
  Time due_{}, now_{};
  bool started_ = false, sampled_ = false;
  Eigen::Vector3d F_h_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 9, 1> theta_hat_, direction_ = Eigen::Matrix<double, 9, 1>::Zero();
};

}  // namespace limpid::bench
