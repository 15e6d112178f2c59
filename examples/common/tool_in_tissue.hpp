// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/environment/tool.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace limpid::examples {

/// What a tissue's force would be if nothing happened to it: F_e = elastic(x) + damping v.
struct UndisturbedForce {
  std::function<double(double)> elastic;  ///< N, at a depth in m
  double damping = 0;                     ///< N s/m
  std::optional<double> edge{};           ///< m, where contact begins; beyond it F_e >= 0. None: bilateral
};

/// What happens to a tissue during a run.
struct TissueChange {
  double step = 1;            ///< factor on the stiffness from some instant on
  double softening = 0;       ///< of the stiffness, 1/s
  double relaxation = 0;      ///< K of a Maxwell branch q' = K v - q / lag, N/m; K v only where it pushes
  double lag = 1;             ///< s
  double damping_growth = 0;  ///< N s/m per m of depth
  double friction = 0;        ///< Coulomb's, N

  bool operator==(const TissueChange&) const = default;

  /// Whether anything happens.
  [[nodiscard]] bool any() const {
    return step != 1 || softening != 0 || relaxation != 0 || damping_growth != 0 || friction != 0;
  }
};

/// The force of a tissue that changes; its elastic part known within a range of depths, beyond it its tangent.
class TissueForce {
 public:
  /// @param step_at  when the stiffness steps, s
  TissueForce(UndisturbedForce undisturbed, const TissueChange& change, double step_at)
      : undisturbed_{std::move(undisturbed)}, change_{change}, step_at_{step_at} {}

  void steps_at(double time) { step_at_ = time; }

  void know(double lower, double upper) {
    lower_ = lower;
    upper_ = upper;
    lower_slope_ = slope(lower);
    upper_slope_ = slope(upper);
  }

  /// @param q  force of the Maxwell branch, N
  [[nodiscard]] double operator()(double t, double x, double v, double q) const {
    return touches(x) ? touching(t, x, v, q) : 0;
  }

  /// Whether contact has begun at a depth.
  [[nodiscard]] bool touches(double x) const { return !undisturbed_.edge || x > *undisturbed_.edge; }

  /// Whether it begins at an edge, and cannot pull.
  [[nodiscard]] bool one_sided() const { return undisturbed_.edge.has_value(); }

  /// The same where contact has begun.
  [[nodiscard]] double touching(double t, double x, double v, double q) const {
    const double known = std::clamp(x, lower_, upper_);
    double elastic = undisturbed_.elastic(known);
    if (x != known) elastic += (x < known ? lower_slope_ : upper_slope_) * (x - known);
    const double stiffness = (t >= step_at_ ? change_.step : 1) * (1 - change_.softening * t);
    const double damping = undisturbed_.damping + change_.damping_growth * std::max(known, 0.0);
    const double force = stiffness * elastic + damping * v + q;
    return undisturbed_.edge ? std::max(force, 0.0) : force;
  }

  /// Of the rates at which a tool at a depth, or at the edge, can move of itself, about the largest, 1/s.
  [[nodiscard]] double fastest(double x, const Tool<1>& tool) const {
    const double depth = undisturbed_.edge ? std::max(x, *undisturbed_.edge + 1e-6) : x;
    const double damping = undisturbed_.damping + change_.damping_growth * std::max(depth, 0.0) + tool.damping;
    const double stiffness = std::max(change_.step, 1.0) * std::abs(slope(depth)) + change_.relaxation + tool.stiffness;
    return damping / tool.mass + std::sqrt(stiffness / tool.mass) + (change_.relaxation > 0 ? 1 / change_.lag : 0);
  }

  [[nodiscard]] const TissueChange& change() const { return change_; }

 private:
  [[nodiscard]] double slope(double x) const {
    constexpr double d = 1e-8;  // m
    return (undisturbed_.elastic(x + d) - undisturbed_.elastic(x - d)) / (2 * d);
  }

  UndisturbedForce undisturbed_;
  TissueChange change_;
  double step_at_;
  double lower_ = -std::numeric_limits<double>::infinity(), upper_ = std::numeric_limits<double>::infinity();
  double lower_slope_ = 0, upper_slope_ = 0;
};

/// The tool (3.29) in a tissue, by steps of Runge and Kutta's fourth order, parted where contact begins or ends: there
/// the force jumps. Coulomb friction holds the tool where it can.
class ToolInTissue {
 public:
  struct State {
    double x = 0, v = 0;  ///< m, m/s
    double q = 0;         ///< of the Maxwell branch, N
    bool stuck = true;    ///< read with friction only
  };

  ToolInTissue(TissueForce force, const Tool<1>& tool) : force_{std::move(force)}, tool_{tool} {}

  [[nodiscard]] TissueForce& tissue() { return force_; }

  /// A tick from `begin`, s, of `length`, s, over which the operator's force goes from F_0 to F_1 in a straight line.
  void advance(State& s, double begin, double length, double F_0, double F_1, int steps) const {
    const double h = length / steps;
    for (int i = 0; i < steps; ++i) {
      const double before = F_0 + (F_1 - F_0) * i / steps, after = F_0 + (F_1 - F_0) * (i + 1) / steps;
      step(s, begin + i * h, before, after, h);
    }
  }

  /// With which the tissue pushes back, friction included, N.
  [[nodiscard]] double force(const State& s, double t, double F_h) const {
    const double F_c = force_.change().friction;
    if (!(F_c > 0)) return force_(t, s.x, s.v, s.q);
    if (s.stuck) return force_(t, s.x, 0, s.q) + std::clamp(F_h - resisting(t, s), -F_c, F_c);
    return force_(t, s.x, s.v, s.q) + std::copysign(F_c, s.v);
  }

 private:
  struct Slope {
    double x, v, q;
  };

  // Of the tissue and the tool's spring on a tool at rest, N.
  [[nodiscard]] double resisting(double t, const State& s) const {
    return tool_.stiffness * s.x + force_(t, s.x, 0, s.q);
  }

  void step(State& s, double t, double before, double after, double h) const {
    const double F_c = force_.change().friction;
    double direction = s.v > 0 ? 1 : s.v < 0 ? -1 : 0;
    if (F_c > 0 && s.stuck) {
      const double net = before - resisting(t, s);
      if (std::abs(net) <= F_c) {
        s.q *= std::exp(-h / force_.change().lag);
        return;
      }
      s.stuck = false;
      direction = net > 0 ? 1 : -1;
    }
    const State next = past_edge(s, t, before, after, h, F_c * direction);
    const bool turned = F_c > 0 && next.v * direction < 0;
    s = next;
    if (turned && std::abs(after - resisting(t + h, s)) <= F_c) {
      s.stuck = true;
      s.v = 0;
    }
  }

  [[nodiscard]] State past_edge(const State& s, double t, double before, double after, double h,
                                double friction) const {
    const bool touching = force_.touches(s.x);
    const State next = moved(s, t, before, after, h, friction, touching);
    if (force_.touches(next.x) == touching) return next;
    const auto force_at = [&](double part) { return before + (after - before) * part / h; };
    double same = 0, other = h;  // s
    State there = next;
    for (int i = 0; i < 50; ++i) {
      const double part = same + (other - same) / 2;
      const State middle = moved(s, t, before, force_at(part), part, friction, touching);
      if (force_.touches(middle.x) == touching) {
        same = part;
      } else {
        other = part;
        there = middle;
      }
    }
    return moved(there, t + other, force_at(other), after, h - other, friction, !touching);
  }

  [[nodiscard]] State moved(const State& s, double t, double before, double after, double h, double friction,
                            bool touching) const {
    const auto slope = [&](double part, const Slope& k) {
      const double at = part * h, x = s.x + at * k.x, v = s.v + at * k.v, q = s.q + at * k.q;
      const double F_h = before + (after - before) * part;
      const double F_e = touching ? force_.touching(t + at, x, v, q) : 0;
      const bool pressed = F_e > 0 || !force_.one_sided();
      return Slope{v, (F_h - tool_.damping * v - tool_.stiffness * x - F_e - friction) / tool_.mass,
                   (pressed ? force_.change().relaxation * v : 0) - q / force_.change().lag};
    };
    const Slope k1 = slope(0, {0, 0, 0}), k2 = slope(0.5, k1), k3 = slope(0.5, k2), k4 = slope(1, k3);
    return {s.x + h / 6 * (k1.x + 2 * k2.x + 2 * k3.x + k4.x), s.v + h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v),
            s.q + h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q), false};
  }

  TissueForce force_;
  Tool<1> tool_;
};

}  // namespace limpid::examples
