// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/haptic_device.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <concepts>

namespace limpid::test {

/// Puts a device through the laws of the HapticDevice concept.
/// @param pass    pass(now): lets the device's time pass up to `now`, free of outside forces
/// @param unplug  unplug(): takes the device away; leave out where it cannot be
/// @param start   of the device's time
template <HapticDevice D, typename Pass>
void check_haptic_device(D& device, Pass&& pass, Time start = Time{}) {
  using Traits = HapticDeviceTraits<D>;
  const SafeTorque<Traits::joints, typename Traits::Scalar> none;
  Time last_stamp{-1};
  for (int k = 1; k <= 50; ++k) {
    const Time now = start + k * std::chrono::milliseconds(1);
    pass(now);
    const auto state = Traits::read(device, now), again = Traits::read(device, now);
    CHECK(is_finite(state));
    CHECK(!has(state.status, Status::disconnected));
    CHECK(state.q == again.q);  // reading moves nothing
    CHECK(state.qdot == again.qdot);
    CHECK(state.stamp == again.stamp);
    CHECK(state.stamp >= last_stamp);
    CHECK(state.stamp <= now);
    last_stamp = state.stamp;
    CHECK(!has(Traits::write(device, none), Status::disconnected | Status::fault));
  }
}

template <HapticDevice D, typename Pass, typename Unplug>
requires std::invocable<Unplug>
void check_haptic_device(D& device, Pass&& pass, Unplug&& unplug, Time start = Time{}) {
  using Traits = HapticDeviceTraits<D>;
  check_haptic_device(device, pass, start);
  const auto known = Traits::read(device, start + std::chrono::milliseconds(50));
  unplug();
  pass(start + std::chrono::milliseconds(51));
  CHECK(has(Traits::write(device, {}), Status::disconnected));
  const auto state = Traits::read(device, start + std::chrono::milliseconds(51));
  CHECK(has(state.status, Status::disconnected));
  CHECK(state.q == known.q);  // the last state known
  CHECK(state.qdot == known.qdot);
  CHECK(state.stamp == known.stamp);
}

}  // namespace limpid::test
