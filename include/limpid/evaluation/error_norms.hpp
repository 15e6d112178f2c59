// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace limpid {

/// A norm of the error in both senses of the thesis.
template <Real Scalar = double>
struct Norms {
  Scalar max{0};  ///< largest 2-norm of any tick, (3.36)
  Scalar l2{0};   ///< L2 norm over the time seen, (3.37), times sqrt(s)
};

/// The thesis's performance metrics of an error e = [x - x_e; v - v_e], (3.35).
///
///     max = max sqrt(e' e)  (3.36),      L2 = sqrt(int e' e dt)  (3.37)
///
/// The integral is the trapezoidal rule over the ticks, from the first one; it is summed with compensation, so that a
/// float counts long runs. (3.35) mixes metres and metres per second: position and velocity are also kept apart.
/// @tparam Axes  number of axes
/// @realtime     add: no allocation, no throw; some 7 flops an axis and 20 more
template <int Axes = 1, Real Scalar = double>
class ErrorNorms {
 public:
  /// @param now         time of the tick, later than the last one
  /// @param e_position  x - x_e, m, Axes x 1
  /// @param e_velocity  v - v_e, m/s, Axes x 1
  /// @return            not_finite or clock_backwards where the tick was left out
  template <typename X, typename V>
  Status add(Time now, const Eigen::DenseBase<X>& e_position, const Eigen::DenseBase<V>& e_velocity) noexcept {
    const Eigen::Matrix<Scalar, Axes, 1> e_x = e_position.derived(), e_v = e_velocity.derived();
    const Scalar xx = e_x.squaredNorm(), vv = e_v.squaredNorm();
    if (!is_finite(xx + vv)) return Status::not_finite;
    if (begun_ && now <= last_) return Status::clock_backwards;
    const Scalar half_dt = begun_ ? in_seconds<Scalar>(elapsed(now, last_)) / Scalar{2} : Scalar{0};
    position_.add(half_dt, xx);
    velocity_.add(half_dt, vv);
    total_.add(half_dt, xx + vv);
    last_ = now;
    begun_ = true;
    return Status::ok;
  }

  [[nodiscard]] Norms<Scalar> total() const noexcept { return total_.norms(); }        ///< of e, m and m/s mixed
  [[nodiscard]] Norms<Scalar> position() const noexcept { return position_.norms(); }  ///< of x - x_e, m
  [[nodiscard]] Norms<Scalar> velocity() const noexcept { return velocity_.norms(); }  ///< of v - v_e, m/s

 private:
  class Squares {
   public:
    void add(const Scalar& half_dt, const Scalar& square) noexcept {
      const Scalar piece = half_dt * (last_ + square) - lost_;
      const Scalar sum = sum_ + piece;
      lost_ = (sum - sum_) - piece;  // Kahan
      sum_ = sum;
      largest_ = largest_ < square ? square : largest_;
      last_ = square;
    }
    [[nodiscard]] Norms<Scalar> norms() const noexcept {
      using std::sqrt;
      return {sqrt(largest_), sqrt(sum_)};
    }

   private:
    Scalar sum_{0}, lost_{0}, largest_{0}, last_{0};
  };

  Squares total_, position_, velocity_;
  Time last_{};
  bool begun_ = false;
};

/// Change of an error by the predictor, (3.38): negative where it helps. 0 where both are 0, infinite where only the
/// error without it is.
template <Real Scalar>
[[nodiscard]] Scalar relative_change(const Scalar& with_prediction, const Scalar& without) {
  if (without == Scalar{0}) return with_prediction == Scalar{0} ? Scalar{0} : std::numeric_limits<Scalar>::infinity();
  return (with_prediction - without) / without;
}

/// The smallest relative change of a force that people feel, Weber's fraction, thesis 3.5.
inline constexpr double weber_threshold = 0.07;

/// Whether people can feel a relative change, for better or for worse.
template <Real Scalar>
[[nodiscard]] bool significant(const Scalar& change) {
  using std::abs;
  return abs(change) > real<Scalar>(weber_threshold);
}

}  // namespace limpid
