// SPDX-License-Identifier: MIT
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <limits>
#include <string>

using limpid::Status;
using namespace std::chrono_literals;

static_assert(limpid::Real<float> && limpid::Real<double> && limpid::Real<long double>);
static_assert(!limpid::Real<int> && !limpid::Real<std::string> && !limpid::Real<Eigen::Vector3d>);

TEST_CASE("statuses join, and each bit is found again") {
  const Status joined = Status::singular | Status::not_finite;
  CHECK(has(joined, Status::singular));
  CHECK(has(joined, Status::not_finite));
  CHECK_FALSE(has(joined, Status::fault));
  CHECK((joined & Status::singular) == Status::singular);
  CHECK((joined & Status::fault) == Status::ok);
  Status status = Status::ok;
  status |= Status::stale;
  CHECK(status == Status::stale);
}

TEST_CASE("a bit is set where its condition holds") {
  CHECK(limpid::when(true, Status::limited) == Status::limited);
  CHECK(limpid::when(false, Status::limited) == Status::ok);
}

TEST_CASE("a status names its bits") {
  CHECK(describe(Status::ok) == "ok");
  CHECK(describe(Status::singular | Status::not_finite) == "not_finite, singular");
  Status all = Status::ok;
  for (int bit = 0; bit < 18; ++bit) all |= static_cast<Status>(1U << bit);
  CHECK(describe(all) ==
        "not_finite, clock_backwards, no_sample, out_of_order, out_of_history, overflow, singular, unreachable, "
        "at_bound, "
        "limited, joint_limit, workspace_limit, fault, disconnected, stale, coarse, lost, overload");
}

TEST_CASE_TEMPLATE("a difference of times becomes seconds, and keeps a millisecond after an hour", Scalar, float,
                   double, long double) {
  CHECK(limpid::in_seconds<Scalar>(1ms) == Scalar(1) / Scalar(1000));
  const limpid::Time hour = 1h, next = hour + 1ms;
  CHECK(limpid::in_seconds<Scalar>(next - hour) == Scalar(1) / Scalar(1000));
}

TEST_CASE("seconds become the nearest nanosecond") {
  CHECK(limpid::from_seconds(0.016) == 16ms);
  CHECK(limpid::from_seconds(1.0 / 3) == 333'333'333ns);
  CHECK(limpid::from_seconds(-2.6e-9) == -3ns);
}

TEST_CASE("a setting that holds passes, one that does not is named with what it was") {
  CHECK_NOTHROW(limpid::expect(true, "A: b", "> 0", 1));
  CHECK_THROWS_WITH_AS(limpid::expect(false, "A: b", "> 0", -1.5), "A: b: expected > 0, got -1.5",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(limpid::expect(false, "A: b", "> 0", Eigen::Array3d(1, -2, 0.5)),
                       "A: b: expected > 0, got 1 -2 0.5", std::invalid_argument);
  CHECK_THROWS_WITH_AS(limpid::expect(false, "A: period", "> 0", limpid::Duration(-2ms)),
                       "A: period: expected > 0, got -0.002 s", std::invalid_argument);
  CHECK_THROWS_WITH_AS(limpid::expect(false, "A: name", "one of x, y", "z"), "A: name: expected one of x, y, got z",
                       std::invalid_argument);
}

TEST_CASE_TEMPLATE("finite is what is neither infinite nor not a number, in every entry", Scalar, float, double,
                   long double) {
  constexpr Scalar inf = std::numeric_limits<Scalar>::infinity(), nan = std::numeric_limits<Scalar>::quiet_NaN();
  CHECK(limpid::is_finite(std::numeric_limits<Scalar>::max()));
  CHECK(limpid::is_finite(std::numeric_limits<Scalar>::denorm_min()));
  for (const Scalar bad : {inf, -inf, nan}) {
    CHECK_FALSE(limpid::is_finite(bad));
    for (int i = 0; i < 6; ++i) {
      Eigen::Matrix<Scalar, 2, 3> values = Eigen::Matrix<Scalar, 2, 3>::Constant(std::numeric_limits<Scalar>::max());
      CHECK(limpid::is_finite(values));
      values(i % 2, i / 2) = bad;
      CHECK_FALSE(limpid::is_finite(values));
    }
  }
}
