// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <concepts>

namespace limpid {

/// What a force sensor felt.
template <Real Scalar = double>
struct ForceReading {
  /// N, in the sensor's own frame; StylusFrame turns it into the base frame
  Eigen::Matrix<Scalar, 3, 1> force = Eigen::Matrix<Scalar, 3, 1>::Zero();
  Time stamp{};                ///< when it was felt
  Status status = Status::ok;  ///< of the sensor, see the concept
};

/// @realtime  no allocation for built-in scalars
template <Real Scalar>
[[nodiscard]] bool is_finite(const ForceReading<Scalar>& reading) noexcept {
  return is_finite(reading.force);
}

/// How limpid sees a force sensor of type S; specialise it to adapt a foreign type. Minimal:
///
///     using Scalar;                                              // a Real
///     static ForceReading<Scalar> read(S&, Time now) noexcept;   // does not wait
///
/// A type with members of these names needs no specialisation.
template <typename S>
struct ForceSensorTraits {};

template <typename S>
requires requires(S& sensor, Time now) {
  typename S::Scalar;
  sensor.read(now);
}
struct ForceSensorTraits<S> {
  using Scalar = typename S::Scalar;

  static auto read(S& sensor, Time now) noexcept(noexcept(sensor.read(now))) { return sensor.read(now); }
};

/// What measures a force of three axes, as that of the operator's hand on a handle.
///
/// Laws: `read` always gives a finite force, the last one known where there is no newer one; its status says
///
///     no_sample      before the first force, which is zero until then
///     stale          the newest is older than the sensor's settings allow
///     disconnected   the sensor does not answer
///     fault          the sensor says that it does not work; its forces are then not taken over
///     overload       a force beyond the sensor's range: there was more than it says
///
/// `stamp` never goes back, and is not after `now` where that does not go back either; reading twice gives the same
/// unless something came in between.
/// test/conformance/force_sensor_suite.hpp checks them for any type. Models: OptoForce, SimulatedForceSensor,
/// RecordedForceSensor.
template <typename S>
concept ForceSensor = Real<typename ForceSensorTraits<S>::Scalar> && requires(S& sensor, Time now) {
  { ForceSensorTraits<S>::read(sensor, now) }
  noexcept->std::same_as<ForceReading<typename ForceSensorTraits<S>::Scalar>>;
};

}  // namespace limpid
