// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/force_sensor.hpp>

#include <doctest/doctest.h>

namespace limpid::test {

/// A reading that keeps the laws of the ForceSensor concept, in what a single one can tell.
template <ForceSensor S>
auto checked_reading(S& sensor, Time now, Time& last_stamp) {
  const auto reading = ForceSensorTraits<S>::read(sensor, now);
  CHECK(is_finite(reading));
  if (has(reading.status, Status::no_sample)) {
    CHECK(reading.force.isZero(0));
  } else {
    CHECK(reading.stamp >= last_stamp);
    CHECK(reading.stamp <= now);
    last_stamp = reading.stamp;
  }
  return reading;
}

/// Puts a sensor, from which nothing was read yet, through the laws of the ForceSensor concept.
/// @param pass  pass(): lets some time pass, in which frames may come, and gives the instant then
/// @param none  none(): from now on no frame comes
/// @return      the last reading
template <ForceSensor S, typename Pass, typename None>
auto check_force_sensor(S& sensor, Pass&& pass, None&& none) {
  Time last_stamp = Time::min(), now{};
  auto reading = checked_reading(sensor, now = pass(), last_stamp);
  const auto wait_until = [&](auto&& holds) {
    for (int k = 0; k < 100'000 && !holds(); ++k) reading = checked_reading(sensor, now = pass(), last_stamp);
    CHECK(holds());
  };
  wait_until([&] { return reading.status == Status::ok; });
  for (int k = 0; k < 50; ++k) reading = checked_reading(sensor, now = pass(), last_stamp);
  none();
  wait_until([&] { return has(reading.status, Status::stale); });
  const auto known = reading;
  reading = checked_reading(sensor, pass(), last_stamp);
  CHECK(reading.force == known.force);
  CHECK(reading.stamp == known.stamp);
  reading = checked_reading(sensor, now, last_stamp);
  CHECK(reading.stamp == known.stamp);
  return reading;
}

/// @param unplug  unplug(): takes the sensor away
template <ForceSensor S, typename Pass, typename None, typename Unplug>
void check_force_sensor(S& sensor, Pass&& pass, None&& none, Unplug&& unplug) {
  const auto known = check_force_sensor(sensor, pass, none);
  unplug();
  Time last_stamp = known.stamp;
  auto reading = checked_reading(sensor, pass(), last_stamp);
  for (int k = 0; k < 100'000 && !has(reading.status, Status::disconnected); ++k) {
    reading = checked_reading(sensor, pass(), last_stamp);
  }
  CHECK(has(reading.status, Status::disconnected));
  CHECK(reading.force == known.force);
  CHECK(reading.stamp == known.stamp);
}

}  // namespace limpid::test
