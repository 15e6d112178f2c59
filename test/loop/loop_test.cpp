// SPDX-License-Identifier: MIT
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"
#include "support/no_allocation.hpp"

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <memory>
#include <tuple>
#include <type_traits>
#include <vector>

using namespace scene;
using limpid::inputs;
using limpid::make_block;
using limpid::make_loop;
using limpid::Previous;
using limpid::Reported;
using limpid::signals;
using limpid::TickStatus;
using limpid::wants;

TEST_CASE("blocks in any order give what the calls by hand give") {
  const double by_hand =
      Tracking{}({}, EstimatedPrediction{}({}, Sampling{}({}, 2), Estimation{}({}, Sampling{}({}, 2))));
  auto forwards = make_loop<wants<Torque>, inputs<Force>>(Sampling{}, Estimation{}, EstimatedPrediction{}, Tracking{});
  auto backwards = make_loop<wants<Torque>, inputs<Force>>(Tracking{}, EstimatedPrediction{}, Estimation{}, Sampling{});
  const auto [torque, status] = forwards.step(Time{0}, 2.0);
  CHECK(torque == by_hand);
  CHECK(status == Status::ok);
  CHECK(backwards.step(Time{0}, 2.0).get<Torque>() == by_hand);
}

TEST_CASE("what nobody wants is no part of the loop, by type and by size") {
  auto known = make_loop<wants<Torque>, inputs<Force>>(Estimation{}, Tracking{}, KnownPrediction{}, Sampling{});
  using Known = decltype(known);
  static_assert(!Known::has<Estimation>);
  static_assert(Known::has<KnownPrediction>);
  static_assert(std::is_same_v<Known::Blocks, boost::hana::tuple<Sampling, KnownPrediction, Tracking>>);
  static_assert(sizeof(Known) == sizeof(KnownPrediction));  // the others that are left have no state
  CHECK(known.step(Time{0}, 2.0).get<Torque>() == -(7 * 3 + 2));
}

TEST_CASE("the same blocks keep the estimator where its estimate is wanted") {
  auto loop =
      make_loop<wants<Torque, Estimate>, inputs<Force>>(Estimation{}, Tracking{}, KnownPrediction{}, Sampling{});
  static_assert(decltype(loop)::has<Estimation>);
  static_assert(sizeof(loop) >= sizeof(Estimation) + sizeof(KnownPrediction));
  const auto [torque, estimate, status] = loop.step(Time{0}, 2.0);
  CHECK(torque == -23);
  CHECK(estimate == 30);
  CHECK(status == Status::ok);
}

TEST_CASE("a pruned block is never called") {
  int calls = 0;
  auto loop = make_loop<wants<Sample>, inputs<Force>>(
      Sampling{}, make_block<struct Unwanted, signals<Sample>, signals<Motion>>([&calls](Time, double x) {
        ++calls;
        return x;
      }));
  (void)loop.step(Time{0}, 1.0);
  CHECK(calls == 0);
}

TEST_CASE("a pruned block may read what nobody writes") {
  auto loop = make_loop<wants<Sample>, inputs<Force>>(Sampling{}, Tracking{});
  CHECK(loop.step(Time{0}, 1.0).get<Sample>() == 2);
}

TEST_CASE("each block is called once a tick with the time of the tick") {
  std::vector<Time> times;
  auto loop = make_loop<wants<Sample, Estimate>, inputs<Force>>(
      make_block<struct Clock, signals<Force>, signals<Sample>>([&times](Time now, double x) {
        times.push_back(now);
        return x;
      }),
      Estimation{});
  (void)loop.step(Time{3}, 1.0);
  (void)loop.step(Time{5}, 1.0);
  CHECK(times == std::vector<Time>{Time{3}, Time{5}});
}

TEST_CASE("Previous is the initial value on the first tick and then the last tick's") {
  // Arm and controller read from each other; the torque applied last tick breaks the cycle.
  auto loop = make_loop<wants<Torque, Motion>, inputs<>>(
      Tracking{}, make_block<struct Arm, signals<Previous<Torque>>, signals<Motion>>(
                      [](Time, double last_torque) { return last_torque + 1; }));
  CHECK(loop.step(Time{0}).get<Motion>() == 101);  // Torque::initial() is 100
  CHECK(loop.step(Time{1}).get<Motion>() == -100);
  CHECK(loop.step(Time{2}).get<Motion>() == 101);
}

TEST_CASE("a signal and its previous value can be read together, of an input too") {
  auto loop = make_loop<wants<Sample>, inputs<Motion>>(
      make_block<struct Difference, signals<Motion, Previous<Motion>>, signals<Sample>>(
          [](Time, double now, double last) { return now - last; }));
  CHECK(loop.step(Time{0}, 4.0).get<Sample>() == 5);  // Motion::initial() is -1
  CHECK(loop.step(Time{1}, 6.0).get<Sample>() == 2);
}

TEST_CASE("a skipped block is not called, its signal keeps its last value and its status is ok") {
  int calls = 0;
  auto loop =
      make_loop<wants<Torque>, inputs<Force>>(Tracking{}, make_block<struct Contact, signals<Force>, signals<Motion>>(
                                                              [&calls](Time, double force) {
                                                                ++calls;
                                                                return Reported{force, Status::stale};
                                                              },
                                                              [](Time, double force) { return force > 0; }));
  CHECK(loop.step(Time{0}, -3.0).get<Torque>() == 1);  // Motion::initial() is -1
  const auto pressed = loop.step(Time{1}, 3.0);
  CHECK(pressed.get<Torque>() == -3);
  CHECK(pressed.status == Status::stale);
  const auto released = loop.step(Time{2}, -5.0);
  CHECK(released.get<Torque>() == -3);
  CHECK(released.status == Status::ok);
  CHECK(calls == 1);
}

namespace {

struct DeviceState {
  double q;
  Status status;
};
struct Device {
  using value_type = DeviceState;
};

}  // namespace

TEST_CASE("the statuses of blocks and inputs are joined") {
  auto loop = make_loop<wants<Torque>, inputs<Device>>(
      make_block<struct Kinematics, signals<Device>, signals<Motion>>([](Time, const DeviceState& device) {
        return Reported{device.q, Status::singular};
      }),
      make_block<struct Limiter, signals<Motion>, signals<Torque>>([](Time, double motion) {
        return Reported{motion, Status::limited};
      }));
  CHECK(loop.step(Time{0}, {2.0, Status::disconnected}).status ==
        (Status::disconnected | Status::singular | Status::limited));
  CHECK(loop.step(Time{0}, {2.0, Status::ok}).status == (Status::singular | Status::limited));
}

TEST_CASE("a reader of TickStatus hears of every block that does not depend on it, wherever it was given") {
  Status heard = Status::ok;
  auto loop = make_loop<wants<Torque, Estimate>, inputs<Force>>(
      make_block<struct Safety, signals<Force, TickStatus>, signals<Torque>>(
          [&heard](Time, double force, Status so_far) {
            heard = so_far;
            return Reported{force, Status::fault};
          }),
      make_block<struct Estimator, signals<Force>, signals<Estimate>>([](Time, double force) {
        return Reported{force, Status::at_bound};
      }));
  CHECK(loop.step(Time{0}, 2.0).status == (Status::at_bound | Status::fault));
  CHECK(heard == Status::at_bound);
}

TEST_CASE("a block may write several signals, each with its status") {
  auto loop = make_loop<wants<Motion, Sample>, inputs<Force>>(
      make_block<struct Split, signals<Force>, signals<Sample, Motion>>([](Time, double force) {
        return std::tuple{force, Reported{-force, Status::singular}};
      }));
  const auto [motion, sample, status] = loop.step(Time{0}, 2.0);
  CHECK(motion == -2);
  CHECK(sample == 2);
  CHECK(status == Status::singular);
}

TEST_CASE("a signal whose value has a status of its own is handed on whole, and the status joined") {
  auto loop = make_loop<wants<Device>, inputs<Force>>(
      make_block<struct Reading, signals<Force>, signals<Device>>([](Time, double force) {
        return DeviceState{force, Status::stale};
      }));
  const auto result = loop.step(Time{0}, 2.0);
  CHECK(result.get<Device>().q == 2);
  CHECK(result.status == Status::stale);
}

TEST_CASE("blocks are reached by their type or tag, and keep their state") {
  auto loop = make_loop<wants<Torque>, inputs<Force>>(Sampling{}, KnownPrediction{},
                                                      make_block<struct Counter, signals<Motion>, signals<Torque>>(
                                                          [n = 0](Time, double x) mutable { return x + n++; }));
  loop.block<KnownPrediction>().k = 0;
  CHECK(loop.step(Time{0}, 5.0).get<Torque>() == 5);
  CHECK(loop.step(Time{1}, 5.0).get<Torque>() == 6);
  CHECK(loop.block<struct Counter>().function(Time{2}, 0.0) == 2);
  CHECK(std::as_const(loop).block<KnownPrediction>().k == 0);
}

TEST_CASE("blocks may be movable only, and values need no default constructor") {
  struct Sealed {
    explicit Sealed(double x) : value_of_it{x} {}
    double value_of_it;
  };
  struct Envelope {
    using value_type = Sealed;
  };
  auto loop = make_loop<wants<Envelope>, inputs<Force>>(make_block<struct Owner, signals<Force>, signals<Envelope>>(
      [factor = std::make_unique<double>(3)](Time, double force) { return Sealed(*factor * force); }));
  auto moved = std::move(loop);
  CHECK(moved.step(Time{0}, 2.0).get<Envelope>().value_of_it == 6);
}

TEST_CASE("an input that is wanted passes through") {
  auto loop = make_loop<wants<Force>, inputs<Force>>(Sampling{});
  static_assert(!decltype(loop)::has<Sampling>);
  CHECK(loop.step(Time{0}, 2.0).get<Force>() == 2);
}

TEST_CASE("step throws nothing where its blocks do not") {
  using Careful = decltype(make_loop<wants<Sample>, inputs<Force>>(Sampling{}));
  using Careless = decltype(make_loop<wants<Sample>, inputs<Force>>(
      make_block<struct Thrower, signals<Force>, signals<Sample>>([](Time, double x) { return x; })));
  static_assert(noexcept(std::declval<Careful&>().step(Time{}, 0.0)));
  static_assert(!noexcept(std::declval<Careless&>().step(Time{}, 0.0)));
}

namespace {

struct Point {
  using value_type = Eigen::Vector3d;
  static Eigen::Vector3d initial() { return Eigen::Vector3d::Zero(); }
};
struct Moved {
  using value_type = Eigen::Vector3d;
};

}  // namespace

TEST_CASE("a tick allocates nothing") {
  auto loop =
      make_loop<wants<Moved>, inputs<Point>>(make_block<struct Mover, signals<Point, Previous<Point>>, signals<Moved>>(
          [](Time, const Eigen::Vector3d& p, const Eigen::Vector3d& last) { return Eigen::Vector3d(p - last); }));
  Eigen::Vector3d moved;
  limpid::test::check_no_allocation([&] {
    for (int i = 0; i < 10; ++i) moved = loop.step(Time{i}, Eigen::Vector3d(i, 2 * i, 0)).get<Moved>();
  });
  CHECK(moved == Eigen::Vector3d(1, 2, 0));
}
