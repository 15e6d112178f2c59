// SPDX-License-Identifier: MIT
#include <limpid/device/haptic_device.hpp>
#include <limpid/device/simulated_omni.hpp>

#include <conformance/haptic_device_suite.hpp>

#include <doctest/doctest.h>

using limpid::DeviceState;
using limpid::HapticDevice;
using limpid::HapticDeviceTraits;
using limpid::Realism;
using limpid::SafeTorque;
using limpid::SimulatedOmni;
using limpid::Status;
using limpid::Time;

namespace {

// Somebody else's lever, with names of its own.
struct ForeignLever {
  float degrees = 30;
  float command = 0;
  bool on = true;
};

struct Wrong {  // each is one law short of a device
  using Scalar = double;
  static constexpr int joints = 3;
};
struct WithoutWrite : Wrong {
  DeviceState<3> read(Time) noexcept { return {}; }
};
struct WritesAnything : WithoutWrite {
  Status write(const Eigen::Vector3d&) noexcept { return Status::ok; }
};
struct WritesEither : WithoutWrite {
  Status write(const SafeTorque<3>&) noexcept { return Status::ok; }
};
struct Throws : Wrong {
  DeviceState<3> read(Time) { return {}; }
  Status write(const SafeTorque<3>&) noexcept { return Status::ok; }
};
struct WrongState : Wrong {
  DeviceState<2> read(Time) noexcept { return {}; }
  Status write(const SafeTorque<3>&) noexcept { return Status::ok; }
};

}  // namespace

template <>
struct limpid::HapticDeviceTraits<ForeignLever> {
  using Scalar = float;
  static constexpr int joints = 1;
  static DeviceState<1, float> read(ForeignLever& lever, Time now) noexcept {
    DeviceState<1, float> state;
    state.q[0] = lever.degrees * 0.0174532925F;
    if (lever.on) state.stamp = last = now;
    state.stamp = last;
    state.status = limpid::when(!lever.on, Status::disconnected);
    return state;
  }
  static Status write(ForeignLever& lever, const SafeTorque<1, float>& torque) noexcept {
    if (!lever.on) return Status::disconnected;
    lever.command = torque.value()[0];
    return Status::ok;
  }
  static inline Time last{};
};

// What accepts a bare torque beside a safe one lets the limiter be gone round.
template <>
struct limpid::HapticDeviceTraits<WritesEither> {
  using Scalar = double;
  static constexpr int joints = 3;
  static DeviceState<3> read(WritesEither& device, Time now) noexcept { return device.read(now); }
  static Status write(WritesEither& device, const SafeTorque<3>& torque) noexcept { return device.write(torque); }
  static Status write(WritesEither&, const Eigen::Vector3d&) noexcept { return Status::ok; }
};

static_assert(HapticDevice<SimulatedOmni<>>);
static_assert(HapticDevice<SimulatedOmni<float>>);
static_assert(HapticDevice<ForeignLever>);
static_assert(!HapticDevice<int>);
static_assert(!HapticDevice<Wrong>);
static_assert(!HapticDevice<WithoutWrite>);
static_assert(!HapticDevice<WritesAnything>);
static_assert(!HapticDevice<WritesEither>);
static_assert(!HapticDevice<Throws>);
static_assert(!HapticDevice<WrongState>);

TEST_CASE_TEMPLATE("the simulated Omni is a haptic device", Scalar, float, double, long double) {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedOmni<Scalar> omni({.realism = realism});
    limpid::test::check_haptic_device(
        omni, [&](Time now) { CHECK(omni.advance(now, SimulatedOmni<Scalar>::Vector::Zero()) == Status::ok); },
        [&] { omni.disconnect(); });
  }
}

TEST_CASE("a foreign device adapted from outside is one, too") {
  ForeignLever lever;
  limpid::test::check_haptic_device(
      lever, [](Time) {}, [&] { lever.on = false; });
}
