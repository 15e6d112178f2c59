// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/environment/maxwell_branches.hpp>
#include <limpid/environment/presliding.hpp>
#include <limpid/environment/spline_knots.hpp>
#include <limpid/estimation/sign_change.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace limpid {

/// A tissue whose whole force law is learnt, beside the tool's state:
///
///     F_e = c(x) + b(x) v + sum_i K_i chi_i + F_c z + r
///
/// c is a cubic B-spline over depth, b is linear between dampers, chi_i are the stretches of Maxwell branches, z is
/// Dahl's bristle, r a force that fades: what is left. Where `contact` says so the tissue begins at an edge, where c =
/// 0, and cannot pull: F_e is that where c > 0 and that is > 0, else 0. All is linear in the parameters, which lie in
/// one vector
///
///     (x, v, r, F_c, K_1 ..., b_j ..., c_j ...)
///
/// b_j and c_j in a ring: the one with index j in place j modulo their number, so that a range that grows at either end
/// moves nothing. Places that are not in use hold zero.
/// @realtime  no allocation, no throw for built-in scalars
template <int Branches = 5, int Dampers = 16, int Coefficients = 96, Real Scalar_ = double>
class TissueLaw {
 public:
  using Scalar = Scalar_;
  static constexpr int position = 0, velocity = 1, residual = 2, friction = 3, first_branch = 4;
  static constexpr int first_damper = first_branch + Branches, first_coefficient = first_damper + Dampers;
  static constexpr int states = first_coefficient + Coefficients;
  static constexpr int most_coefficients = Coefficients, most_dampers = Dampers, branches = Branches;
  static constexpr int most_pieces = 4;  ///< of a step: touched, left, touched again; the last to its end
  using State = Eigen::Matrix<Scalar, states, 1>;
  using Branch = MaxwellBranches<Branches, Scalar>;

  struct Settings {
    Scalar mass{}, tool_damping{};                  ///< kg, N s/m
    Scalar knot_spacing{}, damper_spacing{};        ///< m
    typename Branch::Lags lags{};                   ///< tau, s
    Scalar presliding{};                            ///< travel, m
    Scalar residual_time{};                         ///< s
    Scalar least_slope{}, most_damping{};           ///< N/m beyond what was visited; N s/m
    bool relaxation = false, dry_friction = false;  ///< what is there at all
  };

  /// Of the path, not of the parameters.
  struct Memory {
    typename Branch::Stretch chi{};
    Scalar bristle{0};
  };

  struct Point {
    Scalar x{0}, v{0}, residual{0};
    Memory memory{};
  };

  /// A part of a step in which the tissue is pressed all the time, or not at all.
  struct Piece {
    Scalar length{0};  // s
    bool pressed = true;
    Scalar jump{0};  // of the force at its end, N
  };

  /// Dampers `low` to `high`, one each `spacing`.
  struct DamperRange {
    int low = 0, high = 1;
  };

  TissueLaw(const Settings& settings, const Scalar& x) noexcept
      : settings_{settings}, knots_(settings.knot_spacing, x), visited_low_{x}, visited_high_{x} {
    dampers_.low = SplineKnots<Scalar>::cell(x / settings.damper_spacing);
    dampers_.high = dampers_.low + 1;
  }

  [[nodiscard]] const SplineKnots<Scalar>& knots() const noexcept { return knots_; }
  [[nodiscard]] SplineKnots<Scalar>& knots() noexcept { return knots_; }
  [[nodiscard]] const DamperRange& dampers() const noexcept { return dampers_; }
  [[nodiscard]] DamperRange& dampers() noexcept { return dampers_; }
  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }

  [[nodiscard]] static int coefficient(int j) noexcept { return first_coefficient + wrapped(j, Coefficients); }
  [[nodiscard]] static int damper(int j) noexcept { return first_damper + wrapped(j, Dampers); }

  /// Depths for which there was a sample, m.
  void visit(const Scalar& x) noexcept {
    visited_low_ = std::min(visited_low_, x);
    visited_high_ = std::max(visited_high_, x);
  }

  /// Whether it begins at an edge, and cannot pull.
  [[nodiscard]] bool contact() const noexcept { return contact_; }
  void begin_at_edge() noexcept { contact_ = true; }

  /// The edge is nowhere: there is no depth at which it pushes.
  void detach(State& s) noexcept {
    contact_ = true;
    for (int j = knots_.low(); j <= knots_.high(); ++j) s[coefficient(j)] = Scalar{-1};
  }

  struct Elastic {
    Scalar force{0}, slope{0};  // N, N/m
  };
  [[nodiscard]] Elastic elastic(const State& s, const Scalar& x) const noexcept {
    const auto w = knots_.at(x);
    Elastic result;
    for (std::size_t k = 0; k < 4; ++k) {
      const Scalar& c = s[coefficient(w.first + static_cast<int>(k))];
      result.force += w.value[k] * c;
      result.slope += w.slope[k] * c;
    }
    return result;
  }

  /// Where the dampers about x have a say: the first of two, and the second's part.
  struct DamperWeights {
    int first;
    Scalar second;
  };
  [[nodiscard]] DamperWeights damper_weights(const Scalar& x) const noexcept {
    const auto low = static_cast<Scalar>(dampers_.low), high = static_cast<Scalar>(dampers_.high);
    const Scalar at = std::min(std::max(x / settings_.damper_spacing, low), high);
    const int first = std::min(SplineKnots<Scalar>::cell(at), dampers_.high - 1);
    return {first, at - static_cast<Scalar>(first)};
  }
  [[nodiscard]] Scalar damping(const State& s, const Scalar& x) const noexcept {
    const auto [first, second] = damper_weights(x);
    return s[damper(first)] * (Scalar{1} - second) + s[damper(first + 1)] * second;
  }

  /// Of `damping` over depth, N s/m^2; zero beyond the dampers.
  [[nodiscard]] Scalar damping_slope(const State& s, const Scalar& x) const noexcept {
    const Scalar at = x / settings_.damper_spacing;
    if (!(at > Scalar(dampers_.low) && at < Scalar(dampers_.high))) return Scalar{0};
    const int first = damper_weights(x).first;
    return (s[damper(first + 1)] - s[damper(first)]) / settings_.damper_spacing;
  }

  [[nodiscard]] Scalar memory_force(const State& s, const Memory& memory) const noexcept {
    Scalar force = s[friction] * memory.bristle;
    for (int i = 0; i < Branches; ++i) force += s[first_branch + i] * memory.chi[std::size_t(i)];
    return force;
  }

  /// F_e, N, of what was learnt.
  [[nodiscard]] Scalar force(const State& s, const Point& p) const noexcept {
    return pressed(s, p) ? pressed_force(s, p) : Scalar{0};
  }

  /// The same where the tissue is known to push.
  [[nodiscard]] Scalar pressed_force(const State& s, const Point& p) const noexcept {
    return elastic(s, p.x).force + damping(s, p.x) * p.v + memory_force(s, p.memory) + p.residual;
  }

  /// Whether it pushes.
  [[nodiscard]] bool pressed(const State& s, const Point& p) const noexcept {
    return !contact_ || push(s, p) > Scalar{0};
  }

  /// Of the tool there under the operator's force F, m/s^2, with what is safe as in `step`.
  [[nodiscard]] Scalar acceleration(const State& s, const Point& p, const Scalar& F) const noexcept {
    return acceleration<true>(s, p.x, p.v, memory_force(s, p.memory) + p.residual, F, pressed(s, p));
  }

  /// Over a step of h seconds in which the operator's force goes from F0 to F1, N: the classical Runge-Kutta method,
  /// the memory carried by the mean velocity; in parts where the damper alone would leave the method's region. Where
  /// `safe`, beyond the visited depths no slope is under the least one, and no damper above the most.
  template <bool safe>
  void step(const State& s, Point& p, const Scalar& F0, const Scalar& F1, const Scalar& h) noexcept {
    step<safe>(s, p, F0, F1, h, [](const Point&, const Piece&) {});
  }
  /// The same.
  /// @param take  called with the end of each piece, and the piece
  template <bool safe, typename Take>
  void step(const State& s, Point& p, const Scalar& F0, const Scalar& F1, const Scalar& h, Take&& take) noexcept {
    const Scalar slope = (F1 - F0) / h;
    Piece piece{.length = h, .pressed = pressed(s, p), .jump = Scalar{0}};
    Scalar done{0};
    const auto after = [&](const Scalar& part) {
      Point q = p;
      advance<safe>(s, q, F0 + slope * done, F0 + slope * (done + part), part, piece.pressed);
      return q;
    };
    for (int events = 0; contact_ && events + 1 < most_pieces; ++events) {
      const auto found =
          detail::sign_change(piece.length, piece.pressed, after, [&](const Point& q) { return push(s, q); });
      if (!found.changed) break;
      done += piece.length = found.part;
      p = found.end;
      piece.jump = jump(s, p) * Scalar(piece.pressed ? -1 : 1);
      take(std::as_const(p), std::as_const(piece));
      piece = {.length = h - done, .pressed = !piece.pressed, .jump = Scalar{0}};
      if (!(piece.length > Scalar{0})) return;
    }
    p = after(piece.length);
    take(std::as_const(p), std::as_const(piece));
  }

  /// What of the residual is left after h seconds.
  [[nodiscard]] Scalar residual_left(const Scalar& h) const noexcept {
    using std::exp;
    return exp(-h / settings_.residual_time);
  }

 private:
  // Above zero where the tissue is pressed, N.
  [[nodiscard]] Scalar push(const State& s, const Point& p) const noexcept {
    const Scalar c = elastic(s, p.x).force;
    return std::min(c, c + damping(s, p.x) * p.v + memory_force(s, p.memory) + p.residual);
  }

  // Of the force at an event, N: at the edge, c = 0, there is one; where the force itself is zero none.
  [[nodiscard]] Scalar jump(const State& s, const Point& p) const noexcept {
    const Scalar force = pressed_force(s, p);
    return elastic(s, p.x).force <= force ? std::max(force, Scalar{0}) : Scalar{0};
  }

  [[nodiscard]] static int wrapped(int j, int count) noexcept {
    const int rest = j % count;
    return rest < 0 ? rest + count : rest;
  }

  void set_step(const Scalar& h) noexcept {
    step_length_ = h;
    half_ = Branch::step_of(settings_.lags, h / Scalar{2});
    whole_ = Branch::step_of(settings_.lags, h);
    residual_half_ = residual_left(h / Scalar{2});
  }

  void remember(Memory& memory, const typename Branch::Step& step, const Scalar& v, const Scalar& h) const noexcept {
    if (settings_.relaxation) Branch::advance(memory.chi, step, v);
    if (settings_.dry_friction) memory.bristle = presliding_after(memory.bristle, v, h, settings_.presliding);
  }

  // N; the elastic part beyond the visited depths from their end on with a slope that is safe.
  template <bool safe>
  [[nodiscard]] Scalar velocity_free_force(const State& s, const Scalar& x) const noexcept {
    if constexpr (!safe) {
      return elastic(s, x).force;
    } else {
      const Scalar inside = std::min(std::max(x, visited_low_), visited_high_);
      const Elastic there = elastic(s, inside);
      return there.force + std::max(there.slope, settings_.least_slope) * (x - inside);
    }
  }

  template <bool safe>
  [[nodiscard]] Scalar acceleration(const State& s, const Scalar& x, const Scalar& v, const Scalar& rest,
                                    const Scalar& F, bool pressed) const noexcept {
    if (!pressed) return (F - settings_.tool_damping * v) / settings_.mass;
    const Scalar b = std::min(std::max(damping(s, x), Scalar{0}), settings_.most_damping);
    return (F - velocity_free_force<safe>(s, x) - (b + settings_.tool_damping) * v - rest) / settings_.mass;
  }

  // In parts where the damper alone would leave the method's region.
  template <bool safe>
  void advance(const State& s, Point& p, const Scalar& F0, const Scalar& F1, const Scalar& h, bool pressed) noexcept {
    const Scalar b = (pressed ? damping(s, p.x) : Scalar{0}) + settings_.tool_damping, rate = b / settings_.mass * h;
    const int parts = rate > Scalar(2) ? std::min(8, 1 + static_cast<int>(std::min(rate, Scalar(64)) / Scalar(2))) : 1;
    const Scalar part = h / Scalar(parts), slope = (F1 - F0) / Scalar(parts);
    if (part != step_length_) set_step(part);
    for (int i = 0; i < parts; ++i) {
      short_step<safe>(s, p, F0 + slope * Scalar(i), F0 + slope * Scalar(i + 1), part, pressed);
    }
  }

  template <bool safe>
  void short_step(const State& s, Point& p, const Scalar& F0, const Scalar& F1, const Scalar& h,
                  bool pressed) const noexcept {
    const bool remembers = settings_.relaxation || settings_.dry_friction;
    const Scalar moved(Scalar(pressed ? 1 : 0) / Scalar{2});  // of a tissue that is left alone nothing moves
    const Scalar half = h / Scalar{2}, Fm = (F0 + F1) / Scalar{2};
    const Scalar r_half = p.residual * residual_half_, r_end = r_half * residual_half_;
    const auto memory_after = [&](const typename Branch::Step& step, const Scalar& v, const Scalar& length) {
      if (!remembers) return Scalar{0};
      Memory later = p.memory;
      remember(later, step, v, length);
      return memory_force(s, later);
    };
    const Scalar a1 = acceleration<safe>(s, p.x, p.v, memory_force(s, p.memory) + p.residual, F0, pressed);
    const Scalar v2 = p.v + half * a1;
    const Scalar a2 = acceleration<safe>(s, p.x + half * p.v, v2,
                                         memory_after(half_, moved * (p.v + v2), half) + r_half, Fm, pressed);
    const Scalar v3 = p.v + half * a2;
    const Scalar a3 =
        acceleration<safe>(s, p.x + half * v2, v3, memory_after(half_, moved * (p.v + v3), half) + r_half, Fm, pressed);
    const Scalar v4 = p.v + h * a3;
    const Scalar a4 =
        acceleration<safe>(s, p.x + h * v3, v4, memory_after(whole_, moved * (p.v + v4), h) + r_end, F1, pressed);
    const Scalar before = p.v, sixth = h / Scalar{6};
    p.x += sixth * (p.v + Scalar{2} * (v2 + v3) + v4);
    p.v += sixth * (a1 + Scalar{2} * (a2 + a3) + a4);
    p.residual = r_end;
    if (remembers) remember(p.memory, whole_, moved * (before + p.v), h);
  }

  Settings settings_;
  SplineKnots<Scalar> knots_;
  DamperRange dampers_{};
  bool contact_ = false;
  Scalar visited_low_, visited_high_;
  Scalar step_length_{0}, residual_half_{1};
  typename Branch::Step half_{}, whole_{};
};

}  // namespace limpid
