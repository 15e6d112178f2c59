// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/device/force_sensor.hpp>

#include <Eigen/Core>

namespace limpid {

/// Zeroes a force sensor in the loop: the mean of the next readings is from then on taken off each one. What hangs on
/// the sensor is taken off only for as long as it does not turn.
/// @realtime  no allocation, no throw; some 20 flops
template <Real Scalar_ = double>
class ForceZero {
 public:
  using Scalar = Scalar_;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  enum class State {
    none,       ///< nothing is taken off
    averaging,  ///< the zero before is still taken off
    zeroed,     ///< the mean is taken off
    unsteady,   ///< the readings differed too much, somebody held the sensor: the zero before is kept
  };

  struct Settings {
    int samples = 500;                               ///< readings of the mean, > 0
    Scalar largest_spread = Scalar(2) / Scalar(10);  ///< between the readings of an axis, N, > 0
  };

  /// @throws std::invalid_argument  where the settings cannot serve
  explicit ForceZero(const Settings& settings = Settings{}) : settings_{settings} {
    expect(settings.samples > 0, "ForceZero: samples", "> 0", settings.samples);
    expect(is_finite(settings.largest_spread) && settings.largest_spread > Scalar(0), "ForceZero: largest_spread",
           "finite and > 0", settings.largest_spread);
  }

  /// From the next reading on.
  void start() noexcept {
    state_ = State::averaging;
    count_ = 0;
  }

  /// The reading less the zero. Only readings that are `ok`, finite and newer than the last count for the mean.
  [[nodiscard]] ForceReading<Scalar> update(const ForceReading<Scalar>& reading) noexcept {
    if (state_ == State::averaging && reading.status == Status::ok && is_finite(reading) &&
        (count_ == 0 || reading.stamp > last_stamp_)) {
      average(reading);
    }
    ForceReading<Scalar> zeroed = reading;
    if (!has(reading.status, Status::no_sample)) zeroed.force -= zero_;
    return zeroed;
  }

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] const Vector& zero() const noexcept { return zero_; }  ///< N, what is taken off

 private:
  void average(const ForceReading<Scalar>& reading) noexcept {
    const Vector& force = reading.force;
    if (count_ == 0) {
      mean_.setZero();
      lowest_ = highest_ = force;
    }
    last_stamp_ = reading.stamp;
    lowest_ = lowest_.cwiseMin(force);
    highest_ = highest_.cwiseMax(force);
    if (!((highest_ - lowest_).array() <= settings_.largest_spread).all()) {
      state_ = State::unsteady;
      return;
    }
    mean_ += (force - mean_) / Scalar(++count_);
    if (count_ < settings_.samples) return;
    zero_ = mean_;
    state_ = State::zeroed;
  }

  Settings settings_;
  State state_ = State::none;
  int count_ = 0;
  Time last_stamp_{};
  Vector zero_ = Vector::Zero(), mean_ = Vector::Zero();       // N
  Vector lowest_ = Vector::Zero(), highest_ = Vector::Zero();  // of the readings averaged, N
};

}  // namespace limpid
