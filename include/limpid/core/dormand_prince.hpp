// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>

#include <Eigen/Core>

#include <algorithm>

namespace limpid {

/// Integrates y' = f(t, y) by the explicit Runge-Kutta pair of orders 5 and 4 of Dormand and Prince (1980), with
/// the step chosen so that the local error of each entry stays below absolute + relative |y|.
///
/// For fixed-size states: a tool in a nonlinear environment, a simulated arm. Stiff systems are outside its use.
/// @tparam State  fixed-size Eigen vector or matrix
/// @realtime      no allocation, no throw; at most `most_steps` trials of six calls of f each
template <typename State, Real Scalar = typename State::Scalar>
class DormandPrince {
 public:
  struct Settings {
    Scalar absolute = std::max(Scalar(1e-12), std::numeric_limits<Scalar>::epsilon());  ///< in the state's units, > 0
    Scalar relative = std::max(Scalar(1e-10), 16 * std::numeric_limits<Scalar>::epsilon());  ///< of |y|, >= 0
    int most_steps = 10'000;  ///< trials in one call, accepted or not; > 0
  };

  DormandPrince() = default;

  /// @throws std::invalid_argument  where a tolerance or the number of steps cannot serve
  explicit DormandPrince(const Settings& settings) : settings_{settings} {
    expect(is_finite(settings.absolute) && settings.absolute > Scalar{0}, "DormandPrince: absolute", "finite and > 0",
           settings.absolute);
    expect(is_finite(settings.relative) && settings.relative >= Scalar{0}, "DormandPrince: relative", "finite and >= 0",
           settings.relative);
    expect(settings.most_steps > 0, "DormandPrince: most_steps", "> 0", settings.most_steps);
  }

  /// Takes `y` from t0 to t1, the first trial step being the whole way.
  /// @param f  f(t, y) -> State, y'; smooth between t0 and t1; must not throw: the program ends if it does
  /// @return   `ok`; or with `y` untouched: `clock_backwards` (t1 < t0), `not_finite` (y, a time or f's answer),
  ///           `limited` (not there after `most_steps`, or steps too short to move t)
  template <typename F>
  [[nodiscard]] Status advance(State& y, const Scalar& t0, const Scalar& t1, F&& f) const noexcept {
    if (!is_finite(y) || !is_finite(t0) || !is_finite(t1)) return Status::not_finite;
    if (t1 < t0) return Status::clock_backwards;
    if (t1 == t0) return Status::ok;
    Scalar t = t0, h = t1 - t0;
    State now = y, slope = f(t, now);
    if (!is_finite(slope)) return Status::not_finite;
    Status refused = Status::limited;  // why the last trial failed
    for (int step = 0; step < settings_.most_steps; ++step) {
      const bool last = h >= t1 - t;
      if (last) h = t1 - t;
      const Scalar next = last ? t1 : t + h;
      if (next == t) return refused;
      const Trial trial = attempt(t, now, slope, h, next, f);
      if (trial.error <= Scalar{1}) {  // false for NaN
        t = next;
        now = trial.y;
        slope = trial.slope;
        if (last) {
          y = now;
          return Status::ok;
        }
      }
      refused = is_finite(trial.error) ? Status::limited : Status::not_finite;
      h *= change_of_step(trial.error);
    }
    return refused;
  }

 private:
  struct Trial {
    State y;       // of order 5, at the end of the step
    State slope;   // f there: the first slope of the next step
    Scalar error;  // largest local error over its tolerance
  };

  static Scalar ratio(int over, int under) { return Scalar(over) / Scalar(under); }

  template <typename F>
  Trial attempt(const Scalar& t, const State& y, const State& k1, const Scalar& h, const Scalar& end,
                F& f) const noexcept {
    const State k2 = f(t + h * ratio(1, 5), State(y + h * ratio(1, 5) * k1));
    const State k3 = f(t + h * ratio(3, 10), State(y + h * (ratio(3, 40) * k1 + ratio(9, 40) * k2)));
    const State k4 =
        f(t + h * ratio(4, 5), State(y + h * (ratio(44, 45) * k1 - ratio(56, 15) * k2 + ratio(32, 9) * k3)));
    const State k5 = f(t + h * ratio(8, 9), State(y + h * (ratio(19372, 6561) * k1 - ratio(25360, 2187) * k2 +
                                                           ratio(64448, 6561) * k3 - ratio(212, 729) * k4)));
    const State k6 = f(end, State(y + h * (ratio(9017, 3168) * k1 - ratio(355, 33) * k2 + ratio(46732, 5247) * k3 +
                                           ratio(49, 176) * k4 - ratio(5103, 18656) * k5)));
    Trial trial;
    trial.y = y + h * (ratio(35, 384) * k1 + ratio(500, 1113) * k3 + ratio(125, 192) * k4 - ratio(2187, 6784) * k5 +
                       ratio(11, 84) * k6);
    trial.slope = f(end, trial.y);
    const State difference = h * (ratio(71, 57600) * k1 - ratio(71, 16695) * k3 + ratio(71, 1920) * k4 -
                                  ratio(17253, 339200) * k5 + ratio(22, 525) * k6 - ratio(1, 40) * trial.slope);
    const auto size = y.array().abs().max(trial.y.array().abs());
    trial.error = (difference.array().abs() / (settings_.absolute + settings_.relative * size)).maxCoeff();
    // maxCoeff may pass a NaN by
    if (!is_finite(trial.y) || !is_finite(trial.slope)) trial.error = std::numeric_limits<Scalar>::infinity();
    return trial;
  }

  // The local error grows with the fifth power of the step.
  static Scalar change_of_step(const Scalar& error) noexcept {
    using std::exp, std::log;
    const Scalar least = ratio(1, 10), most = Scalar{5};
    if (!(error < Scalar(1e4))) return least;
    if (error < Scalar(1e-4)) return most;
    return std::min(most, ratio(9, 10) * exp(-log(error) / Scalar{5}));
  }

  Settings settings_{};
};

}  // namespace limpid
