// SPDX-License-Identifier: MIT
#include <limpid/device/force_sensor.hpp>

#include <conformance/force_sensor_suite.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <limits>

using limpid::ForceReading;
using limpid::ForceSensor;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

namespace {

// Somebody else's scale, with names of its own.
struct ForeignScale {
  float grams = 0;
  Time at{};
  bool any = false, on = true;
};

struct Wrong {  // each is one law short of a sensor
  using Scalar = double;
};
struct WithoutScalar {
  ForceReading<> read(Time) noexcept { return {}; }
};
struct Throws : Wrong {
  ForceReading<> read(Time) { return {}; }
};
struct WrongScalar : Wrong {
  ForceReading<float> read(Time) noexcept { return {}; }
};
struct BareVector : Wrong {
  Eigen::Vector3d read(Time) noexcept { return Eigen::Vector3d::Zero(); }
};
struct WithoutTime : Wrong {
  ForceReading<> read() noexcept { return {}; }
};

}  // namespace

template <>
struct limpid::ForceSensorTraits<ForeignScale> {
  using Scalar = float;
  static ForceReading<float> read(ForeignScale& scale, Time now) noexcept {
    ForceReading<float> reading;
    reading.force[2] = -scale.grams * 0.00981F;
    reading.stamp = scale.at;
    reading.status = when(!scale.any, Status::no_sample) | when(!scale.on, Status::disconnected) |
                     when(scale.any && now - scale.at > 20ms, Status::stale);
    return reading;
  }
};

static_assert(ForceSensor<ForeignScale>);
static_assert(!ForceSensor<int>);
static_assert(!ForceSensor<Wrong>);
static_assert(!ForceSensor<WithoutScalar>);
static_assert(!ForceSensor<Throws>);
static_assert(!ForceSensor<WrongScalar>);
static_assert(!ForceSensor<BareVector>);
static_assert(!ForceSensor<WithoutTime>);

TEST_CASE("a foreign scale adapted from outside is a force sensor") {
  ForeignScale scale;
  Time now{};
  bool weighs = true;
  limpid::test::check_force_sensor(
      scale,
      [&] {
        now += 1ms;
        if (weighs && now > 5ms) {
          scale.any = true;
          scale.at = now;
          scale.grams += 1;
        }
        return now;
      },
      [&] { weighs = false; }, [&] { scale.on = false; });
}

TEST_CASE("a reading is finite where its force is") {
  ForceReading<> reading;
  CHECK(is_finite(reading));
  reading.force[1] = std::numeric_limits<double>::infinity();
  CHECK(!is_finite(reading));
}
