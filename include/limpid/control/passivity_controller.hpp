// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <limits>

namespace limpid {

/// Which force and which motion make the energy of a tick.
enum class EnergyPairing {
  held_force,  ///< f1[k-1] . (x[k] - x[k-1]): what a force held over the period really took
  same_tick,   ///< f[k] . v[k] T, as printed by Hannaford and Ryu: blind to what holding the force generates
};

/// Passivity observer and controller of Hannaford and Ryu (IEEE Trans. Robotics and Automation 18, 2002) at an
/// impedance port: motion comes in, force goes out. The observer counts the energy W that has gone into the port over
/// all axes together; the controller adds a damper, for a tick at a time, where more came out than had gone in.
///
///     W[k] = W[k-1] + (energy of the tick)     alpha = -W/(|v|^2 T) where W < 0, else 0     f1 = f + alpha v
///
/// f and f1 resist the motion: the device is given -f1, and f . v > 0 is power into the port. T is the last period,
/// taken for the next one.
///
/// `held_force` counts what really happened, the damper's share with it, so that what could not be dissipated within a
/// tick, at rest or at the largest damping, stays owed. `same_tick` counts alpha |v|^2 T as dissipated at once.
/// @tparam Axes  axes of the one port
/// @realtime     no allocation, no throw; some 6 flops an axis and 10 more
template <int Axes = 1, Real Scalar = double>
class PassivityController {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    EnergyPairing pairing = EnergyPairing::held_force;
    /// Upper bound of alpha, N s/m, >= 0; may be infinite. A damper that is sampled makes a mass m swing where it is
    /// above some m/T, and drives it unstable above 2 m/T: take m/T of the lightest axis or less.
    Scalar largest_damping = std::numeric_limits<Scalar>::quiet_NaN();
    /// |v| above which it dissipates, m/s, >= 0; above the noise of the velocity at rest.
    Scalar smallest_speed{0};
    /// Upper bound of W, J, >= 0. Where it is finite, energy that was dissipated long ago does not license an active
    /// port later; where it is less than the port may rightly give back, a spring's energy, the port feels damped.
    Scalar most_stored = std::numeric_limits<Scalar>::infinity();
  };

  struct Output {
    Vector force;   ///< f1, N; always finite
    Scalar alpha;   ///< N s/m
    Scalar energy;  ///< W before this tick's damper, J
    /// at_bound: not all that is owed is asked for in this tick; not_finite, clock_backwards: the last answer
    Status status;
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit PassivityController(const Settings& settings) : settings_{settings} {
    expect(settings.largest_damping >= Scalar{0}, "PassivityController: largest_damping", ">= 0",
           settings.largest_damping);
    expect(is_finite(settings.smallest_speed) && settings.smallest_speed >= Scalar{0},
           "PassivityController: smallest_speed", "finite and >= 0", settings.smallest_speed);
    expect(settings.most_stored >= Scalar{0}, "PassivityController: most_stored", ">= 0", settings.most_stored);
  }

  /// The first call starts the clock and the account, at W = 0, and gives f as it is.
  /// @param f        what the port's controller asks for at `now`, N, resisting the motion
  /// @param x, v     of the port at `now`, m, m/s
  /// @param applied  -(what the device really applied since the last call), N: f1, or less behind a limiter
  [[nodiscard]] Output update(Time now, const Vector& f, const Vector& x, const Vector& v,
                              const Vector& applied) noexcept {
    if (started_ && now <= now_) return held(Status::clock_backwards);
    const Scalar T = started_ ? in_seconds<Scalar>(elapsed(now, now_)) : Scalar{0};
    const Scalar taken = settings_.pairing == EnergyPairing::held_force ? Scalar((applied * (x - x_)).sum())
                                                                        : Scalar(dissipated_ + (f * v).sum() * T);
    const Scalar W = std::min<Scalar>(started_ ? Scalar(energy_ + taken) : Scalar{0}, settings_.most_stored);
    const Scalar square = (v * v).sum(), per_damping = square * T;
    // at a speed so low that alpha overflows it rests
    const bool moves = square > settings_.smallest_speed * settings_.smallest_speed &&
                       -W < per_damping * std::numeric_limits<Scalar>::max();
    const Scalar wanted = W < Scalar{0} && moves ? Scalar(-W / per_damping) : Scalar{0};
    const Scalar alpha = std::min<Scalar>(wanted, settings_.largest_damping);
    const Vector f1 = f + alpha * v;
    // a large square may have overflowed where the force has not
    if (!is_finite(f1) || !is_finite(W) || !is_finite(square) || !is_finite(x) || (started_ && !is_finite(taken))) {
      return held(Status::not_finite);
    }
    started_ = true;
    now_ = now;
    x_ = x;
    energy_ = W;
    dissipated_ = alpha * per_damping;
    force_ = f1;
    alpha_ = alpha;
    return {f1, alpha, W, when(W < Scalar{0} && !(moves && wanted <= settings_.largest_damping), Status::at_bound)};
  }

  /// The same for a device that always applies what it is asked for.
  [[nodiscard]] Output update(Time now, const Vector& f, const Vector& x, const Vector& v) noexcept {
    return update(now, f, x, v, Vector(force_));
  }

  /// Forgets the account and the clock, as where contact begins anew: the next call is a first one.
  void reset() noexcept {
    started_ = false;
    energy_ = dissipated_ = alpha_ = Scalar{0};
    force_.setZero();
  }

 private:
  [[nodiscard]] Output held(Status status) const noexcept { return {force_, alpha_, energy_, status}; }

  Settings settings_;
  bool started_ = false;
  Time now_{};
  Vector x_ = Vector::Zero();
  Scalar energy_{0};               // W at the last tick
  Scalar dissipated_{0};           // alpha |v|^2 T then, as the classical pairing counts it
  Vector force_ = Vector::Zero();  // f1
  Scalar alpha_{0};
};

}  // namespace limpid
