// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/force_sensor.hpp>
#include <limpid/device/recording.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <chrono>
#include <utility>

namespace limpid {

/// Plays a recording as a force sensor: `no_sample` before it begins, `stale` some time after its end.
/// @realtime  read: no allocation, no throw; as Recording::at
template <Real Scalar_ = double>
class RecordedForceSensor {
 public:
  using Scalar = Scalar_;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  struct Settings {
    Vector direction = Vector::UnitZ();                    ///< N on each axis by newton of the recording
    Time start{};                                          ///< of the recording's first sample
    Duration longest_age = std::chrono::milliseconds(20);  ///< after the recording's end, >= 0
  };

  /// @throws std::invalid_argument  where the settings cannot serve
  explicit RecordedForceSensor(Recording recording, const Settings& settings = Settings{})
      : recording_{std::move(recording)}, settings_{settings}, end_{later(settings.start, recording_.duration())} {
    expect(is_finite(settings.direction), "RecordedForceSensor: direction", "finite", settings.direction);
    expect(settings.longest_age >= Duration::zero(), "RecordedForceSensor: longest_age", ">= 0", settings.longest_age);
  }

  [[nodiscard]] ForceReading<Scalar> read(Time now) noexcept {
    if (now >= settings_.start) {
      newest_.stamp = std::max(newest_.stamp, std::min(now, end_));
      const Vector force = settings_.direction * Scalar(recording_.at(elapsed(newest_.stamp, settings_.start)));
      const bool finite = is_finite(force);
      if (finite) newest_.force = force;
      newest_.status = when(!finite, Status::not_finite);
    }
    ForceReading<Scalar> reading = newest_;
    if (!has(reading.status, Status::no_sample)) {
      reading.status |= when(elapsed(now, reading.stamp) > settings_.longest_age, Status::stale);
    }
    return reading;
  }

 private:
  Recording recording_;
  Settings settings_;
  Time end_;
  ForceReading<Scalar> newest_{Vector::Zero(), Time::min(), Status::no_sample};
};

}  // namespace limpid
