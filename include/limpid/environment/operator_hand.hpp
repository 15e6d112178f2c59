// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace limpid {

/// Where the energy of a hand has gone since its first tick, J, over all axes:
///
///     initial + work = kinetic + elastic + dissipated + delivered
template <Real Scalar = double>
struct HandEnergy {
  Scalar initial{0};     ///< kinetic energy at the first tick
  Scalar work{0};        ///< done by the intended force on the hand
  Scalar kinetic{0};     ///< of the hand now
  Scalar elastic{0};     ///< in the grip now
  Scalar dissipated{0};  ///< in the grip
  Scalar delivered{0};   ///< to the device, through its tip

  /// What is missing or too much: zero to the error of the integrals.
  [[nodiscard]] Scalar residual() const noexcept { return initial + work - kinetic - elastic - dissipated - delivered; }
};

/// Passive operator who presses by intention (thesis 3.5, 7.3.1): a hand of mass M, pushed by the intended force F_i,
/// that holds the device's tip through a grip of damping B and stiffness K.
///
///     M x_h'' = F_i - F_h        F_h = K (x_h - x_t) + B (v_h - v_t)     on the tip
///
/// At rest F_h = F_i, so that a recorded force can serve as the intention. Whatever the tip does, no more energy is
/// delivered than the intention has done work and was there at the start.
///
/// Exact over a tick for an intention that is linear in time and a tip on the cubic between (x_t, v_t) of its ends, for
/// the stretch of the grip e = x_h - x_t:     M e'' + B e' + K e = F_i - M x_t''
///
/// The integrals of the energies are taken with four Gauss points a tick, of error 5.6e-10 h^9 times the eighth
/// derivative of the power.
/// @tparam Axes  number of axes, each moving for itself
/// @realtime     no allocation, no throw; some 150 flops an axis, 700 more where a tick is not as long as the last one
template <int Axes = 1, Real Scalar = double>
class OperatorHand {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    Vector mass = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());       ///< M, kg, > 0
    Vector damping = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());    ///< B, N s/m, >= 0
    Vector stiffness = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< K, N/m, >= 0
  };

  struct Output {
    Vector force;   ///< F_h on the tip at `now`, N; always finite
    Status status;  ///< `not_finite` or `clock_backwards`: the call changed nothing
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit OperatorHand(const Settings& settings) : M_{settings.mass}, B_{settings.damping}, K_{settings.stiffness} {
    expect(is_finite(M_) && (M_ > Scalar{0}).all(), "OperatorHand: mass", "finite and > 0", M_);
    expect(is_finite(B_) && (B_ >= Scalar{0}).all(), "OperatorHand: damping", "finite and >= 0", B_);
    expect(is_finite(K_) && (K_ >= Scalar{0}).all(), "OperatorHand: stiffness", "finite and >= 0", K_);
    expect(is_finite(Vector(K_ / M_)) && is_finite(Vector(B_ / M_)), "OperatorHand: mass",
           "a finite stiffness and damping over it", M_);
  }

  /// Moves to `now`. The first call takes hold of the tip, moving with it, with the grip relaxed.
  /// @param intention  F_i at `now`, N
  /// @param x, v       of the tip at `now`, m, m/s
  [[nodiscard]] Output advance(Time now, const Vector& intention, const Vector& x, const Vector& v) noexcept {
    if (started_ && now <= now_) return {force_, Status::clock_backwards};
    if (!is_finite(intention) || !is_finite(x) || !is_finite(v)) return {force_, Status::not_finite};
    if (!started_) return start(now, intention, x, v);
    const Duration length = elapsed(now, now_);
    if (length != length_) set_step(length);
    const Tick tick(*this, in_seconds<Scalar>(length), intention, x, v);
    Vector e = e_, edot = edot_;
    steps_[points].advance(e, edot, tick.forcing(*this, Scalar{0}), tick.forcing(*this, Scalar{1}));
    HandEnergy<Scalar> energy = spent(tick);
    const Vector force = store(e, edot, v, energy);
    if (!is_finite(force) || !is_finite(energy.residual())) return {force_, Status::not_finite};
    return keep(now, intention, x, v, e, edot, force, energy);
  }

  [[nodiscard]] const HandEnergy<Scalar>& energy() const noexcept { return energy_; }
  [[nodiscard]] Vector position() const noexcept { return x_ + e_; }     ///< x_h, m
  [[nodiscard]] Vector velocity() const noexcept { return v_ + edot_; }  ///< v_h, m/s

 private:
  static constexpr std::size_t points = 4;

  // Gauss-Legendre on [0, 1]: 1/2 -+ sqrt(3/7 +- (2/7) sqrt(6/5))/2, with the weights (18 -+ sqrt(30))/72.
  struct Quadrature {
    std::array<Scalar, points> at, weight;
    Quadrature() noexcept {
      using std::sqrt;
      const Scalar root = sqrt(Scalar(30)), wide = sqrt((Scalar(15) + Scalar{2} * root) / Scalar(35)),
                   narrow = sqrt((Scalar(15) - Scalar{2} * root) / Scalar(35)), half = Scalar{1} / Scalar{2};
      at = {half - half * wide, half - half * narrow, half + half * narrow, half + half * wide};
      const Scalar outer = (Scalar(18) - root) / Scalar(72), inner = (Scalar(18) + root) / Scalar(72);
      weight = {outer, inner, inner, outer};
    }
  };

  // What is given over a tick, as functions of the part of it that has passed.
  struct Tick {
    Scalar h;
    Vector F0, rise;           // F_i
    Vector v0, a0, jerk_step;  // of the tip; a = a0 + part jerk_step

    Tick(const OperatorHand& hand, const Scalar& length, const Vector& F1, const Vector& x1, const Vector& v1) noexcept
        : h{length}, F0{hand.F_i_}, rise{F1 - hand.F_i_}, v0{hand.v_} {
      const Vector mean = (x1 - hand.x_) / h;
      a0 = (Scalar{6} * mean - Scalar{4} * v0 - Scalar{2} * v1) / h;
      jerk_step = (Scalar{6} * (v0 + v1) - Scalar{12} * mean) / h;
    }
    [[nodiscard]] Vector intention(const Scalar& part) const noexcept { return F0 + part * rise; }
    [[nodiscard]] Vector velocity(const Scalar& part) const noexcept {
      return v0 + (h * part) * (a0 + (part / Scalar{2}) * jerk_step);
    }
    // of e'' + (B/M) e' + (K/M) e
    [[nodiscard]] Vector forcing(const OperatorHand& hand, const Scalar& part) const noexcept {
      return intention(part) / hand.M_ - (a0 + part * jerk_step);
    }
  };

  void set_step(Duration length) noexcept {
    const Scalar h = in_seconds<Scalar>(length);
    const Vector kappa = K_ / M_, beta = B_ / M_;
    for (std::size_t i = 0; i < points; ++i) steps_[i].set(kappa, beta, quadrature_.at[i] * h);
    steps_[points].set(kappa, beta, h);
    length_ = length;
  }

  // The integrals up to the end of the tick.
  [[nodiscard]] HandEnergy<Scalar> spent(const Tick& tick) const noexcept {
    HandEnergy<Scalar> energy = energy_;
    const Vector f0 = tick.forcing(*this, Scalar{0});
    for (std::size_t i = 0; i < points; ++i) {
      const Scalar part = quadrature_.at[i], weight = quadrature_.weight[i] * tick.h;
      Vector e = e_, edot = edot_;
      steps_[i].advance(e, edot, f0, tick.forcing(*this, part));
      const Vector v_t = tick.velocity(part);
      energy.work += weight * (tick.intention(part) * (v_t + edot)).sum();
      energy.dissipated += weight * (B_ * edot * edot).sum();
      energy.delivered += weight * ((K_ * e + B_ * edot) * v_t).sum();
    }
    return energy;
  }

  // F_h, and what hand and grip hold.
  Vector store(const Vector& e, const Vector& edot, const Vector& v, HandEnergy<Scalar>& energy) const noexcept {
    const Vector v_h = v + edot;
    energy.kinetic = (M_ * v_h * v_h).sum() / Scalar{2};
    energy.elastic = (K_ * e * e).sum() / Scalar{2};
    return K_ * e + B_ * edot;
  }

  Output start(Time now, const Vector& intention, const Vector& x, const Vector& v) noexcept {
    const Vector none = Vector::Zero();
    HandEnergy<Scalar> energy;
    const Vector force = store(none, none, v, energy);
    energy.initial = energy.kinetic;
    if (!is_finite(energy.kinetic)) return {force_, Status::not_finite};
    started_ = true;
    return keep(now, intention, x, v, none, none, force, energy);
  }

  Output keep(Time now, const Vector& intention, const Vector& x, const Vector& v, const Vector& e, const Vector& edot,
              const Vector& force, const HandEnergy<Scalar>& energy) noexcept {
    now_ = now;
    F_i_ = intention;
    x_ = x;
    v_ = v;
    e_ = e;
    edot_ = edot;
    force_ = force;
    energy_ = energy;
    return {force_, Status::ok};
  }

  Vector M_, B_, K_;
  Quadrature quadrature_{};
  Duration length_{};                                              // for which steps_ are
  std::array<SecondOrderStep<Axes, Scalar>, points + 1> steps_{};  // to each point, and to the end
  bool started_ = false;
  Time now_{};
  Vector F_i_ = Vector::Zero(), x_ = Vector::Zero(), v_ = Vector::Zero();  // intention and tip at the last tick,
  Vector e_ = Vector::Zero(), edot_ = Vector::Zero();                      // stretch of the grip,
  Vector force_ = Vector::Zero();                                          // and F_h
  HandEnergy<Scalar> energy_{};
};

}  // namespace limpid
