// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace limpid {

/// Which line through a window gives the velocity.
enum class WindowFit {
  end,   ///< through its newest and its oldest position
  best,  ///< of least squares
};

/// Velocity from positions that are uncertain by a band, such as an encoder's: first-order adaptive windowing,
/// F. Janabi-Sharifi, V. Hayward, C.-S. J. Chen, Discrete-time adaptive windowing for velocity estimation, IEEE Trans.
/// Control Systems Technology 8(6), 2000.
///
/// The window grows back from the newest position, interval by interval up to `Longest` of them, while the line through
/// its newest and its oldest position passes every position between them within the band d:
///
///     |u_k - b (t_k - t_i) - u_i| <= d   for all i of the window,     b = (u_k - u_(k-n)) / (t_k - t_(k-n))
///
/// Motion that changes fast has short windows and little lag, steady motion long ones and little noise. Each position
/// narrows the slopes that pass all so far to an interval, so that a window costs O(n) and not O(n^2). Ticks may be
/// irregular. The answer lags by half the window. Of steady motion, read to d/2, all of the window serves, and the end
/// fit errs by at most d over its length.
/// @tparam Axes     number of independent axes, each with a window of its own
/// @tparam Longest  intervals of the longest window
/// @realtime        no allocation, no throw; at most 12 Longest flops an axis
template <int Axes = 1, int Longest = 32, Real Scalar = double>
class AdaptiveWindowVelocity {
  static_assert(Longest >= 1, "AdaptiveWindowVelocity: Longest: expected at least one interval");

 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    /// d, peak to peak of the position's uncertainty, in the input's unit, > 0; of an encoder, its step.
    Vector band = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    WindowFit fit = WindowFit::best;
  };

  struct Output {
    Vector value;   ///< b, input units per second; always finite
    Status status;  ///< `not_finite` or `clock_backwards`: the call changed nothing
  };

  /// @throws std::invalid_argument  where a band is not positive and finite
  explicit AdaptiveWindowVelocity(const Settings& settings) : band_{settings.band}, fit_{settings.fit} {
    expect(is_finite(band_) && (band_ > Scalar{0}).all(), "AdaptiveWindowVelocity: band", "finite and > 0", band_);
    past_.fill(Vector::Zero());
  }

  /// Takes the position `u` of the tick `now`. The first call gives zero.
  [[nodiscard]] Output update(Time now, const Vector& u) noexcept {
    if (!is_finite(u)) return {y_, Status::not_finite};
    if (known_ > 0 && now <= times_[newest_]) return {y_, Status::clock_backwards};
    const std::size_t last = newest_;
    newest_ = newest_ + 1 < size ? newest_ + 1 : 0;
    const Time oldest_time = std::exchange(times_[newest_], now);
    const Vector oldest = std::exchange(past_[newest_], u);
    Vector y = Vector::Zero();
    find_ages();
    for (int axis = 0; axis < Axes; ++axis) y[axis] = slope(axis);
    if (!is_finite(y)) {  // a finite position may still jump too far
      times_[newest_] = oldest_time;
      past_[newest_] = oldest;
      newest_ = last;
      return {y_, Status::not_finite};
    }
    if (known_ < std::size_t{Longest}) ++known_;
    y_ = y;
    return {y_, Status::ok};
  }

 private:
  static constexpr std::size_t size = std::size_t{Longest} + 1;

  // Of the positions before the newest one, the newest of them first.
  struct Ages {
    std::array<Scalar, std::size_t{Longest}> age, rate;  // s, 1/s
    std::array<std::size_t, std::size_t{Longest}> at;    // where in `past_`
  };

  void find_ages() noexcept {
    std::size_t at = newest_;
    for (std::size_t i = 0; i < known_; ++i) {
      at = at > 0 ? at - 1 : size - 1;
      ages_.at[i] = at;
      ages_.age[i] = in_seconds<Scalar>(elapsed(times_[newest_], times_[at]));
      ages_.rate[i] = Scalar{1} / ages_.age[i];
    }
  }

  // Intervals of the window: it grows while its slope is between `low` and `high`, those that pass all of its positions
  // within the band.
  [[nodiscard]] std::size_t window(int axis) const noexcept {
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Scalar u = past_[newest_][axis], d = band_[axis];
    Scalar low = -infinity, high = infinity;
    std::size_t n = 0;
    for (; n < known_; ++n) {
      const Scalar slope = (u - past_[ages_.at[n]][axis]) * ages_.rate[n], slack = d * ages_.rate[n];
      if (!(low <= slope && slope <= high)) break;
      low = low < slope - slack ? Scalar(slope - slack) : low;
      high = slope + slack < high ? Scalar(slope + slack) : high;
    }
    return n;
  }

  [[nodiscard]] Scalar slope(int axis) const noexcept {
    const std::size_t n = window(axis);
    if (n == 0) return known_ == 0 ? Scalar{0} : std::numeric_limits<Scalar>::quiet_NaN();
    const auto rise = [&](std::size_t i) { return Scalar(past_[newest_][axis] - past_[ages_.at[i]][axis]); };
    if (fit_ == WindowFit::end) return rise(n - 1) / ages_.age[n - 1];
    Scalar t{0}, u{0}, tt{0}, tu{0};  // sums, from the newest position
    for (std::size_t i = 0; i < n; ++i) {
      t += ages_.age[i];
      u += rise(i);
      tt += ages_.age[i] * ages_.age[i];
      tu += ages_.age[i] * rise(i);
    }
    const Scalar count = Scalar(static_cast<int>(n + 1));
    return (count * tu - t * u) / (count * tt - t * t);
  }

  Vector band_;
  WindowFit fit_;
  Ages ages_{};  // of the last call
  std::array<Time, size> times_{};
  std::array<Vector, size> past_;
  std::size_t newest_ = 0, known_ = 0;  // known_: positions before the next one
  Vector y_ = Vector::Zero();           // last good output
};

}  // namespace limpid
