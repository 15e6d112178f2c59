// SPDX-License-Identifier: MIT
#include <limpid/control/fade.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/loop/realtime/environment_link.hpp>
#include <limpid/loop/realtime/periodic_loop.hpp>
#include <limpid/loop/realtime/shared_object.hpp>
#include <limpid/loop/realtime/slow_environment.hpp>

#include <doctest/doctest.h>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

using Exchange = EnvironmentExchange<1>;
using Shared = SharedObject<Exchange>;
using Force = Exchange::Vector;
using Tissue = KelvinVoigt<1>;

std::string own_name(const std::string& what) { return "/limpid-test-" + what + "-" + std::to_string(getpid()); }

// What `act` says when it is refused.
template <typename Act>
std::string refusal(Act act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A process that runs `act`, and ends with this one at the latest.
class Child {
 public:
  template <typename Act>
  explicit Child(Act act) : id_{fork()} {
    if (id_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    try {
      act();
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end(); }

  [[nodiscard]] pid_t id() const { return id_; }
  void signal(int number) const { kill(id_, number); }
  void end() {
    if (id_ <= 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
    id_ = 0;
  }

 private:
  pid_t id_;
};

const Tool<1> tool{.mass = 0.1, .damping = 0.1, .stiffness = 0};
constexpr double stiffness = 800, damping = 30;

void serve(const std::string& name) {
  Shared shared = Shared::use(name);
  SlowEnvironment slow(*shared, VirtualTool<Tissue>({.theta = {stiffness, damping}, .tool = tool}),
                       {.period = 16ms, .delay = 5ms});
  slow.serve(std::stop_token{});
}

// A press at 1 kHz by the true clock, whose force fades where the environment's samples are stale. What it asserts
// holds by the loop's own instants, however late these come.
struct Press {
  static constexpr Duration longest_age = 100ms, fade_out = 20ms, fade_in = 30ms, hold = 5ms;

  EnvironmentLink<Exchange> link;
  Fade<> fade{{.fade_out = fade_out, .fade_in = fade_in, .hold = hold}};
  double factor = 0;
  bool was_stale = false;
  int fresh = 0, torn = 0, too_long = 0, too_steep = 0;

  explicit Press(Exchange& exchange) : link{exchange, {.longest_age = longest_age}} {}

  static double force_at(Time time) { return 1 + std::sin(10 * std::fmod(in_seconds(time), 100.0)); }

  void tick(const TickTime& at) noexcept {
    (void)link.send(at.now, Force(force_at(at.now)));
    const auto& seen = link.read(at.now);
    was_stale = has(seen.status, Status::stale);
    const double last = factor;
    factor = fade.update(at.now, seen.status == Status::ok);
    if (seen.fresh) {
      ++fresh;
      torn += is_whole(seen) ? 0 : 1;
    }
    // the stated time: after the last sample was taken, longest_age until it is stale, and fade_out from there
    if (elapsed(at.now, seen.taken) > longest_age + fade_out && factor != 0) ++too_long;
    const double dt = in_seconds(at.dt), slack = 1e-12;  // of some roundings near 1
    if (at.index > 0 && last - factor > dt / in_seconds(fade_out) + slack) ++too_steep;
    if (at.index > 0 && factor - last > 1.5 * dt / in_seconds(fade_in) + slack) ++too_steep;
  }

  // Its numbers belong together: (3.29) holds for them, but for roundings at numbers below 1e3.
  static bool is_whole(const Held<ToolState<1>>& seen) {
    const double x = seen.value.x[0], v = seen.value.v[0], a = seen.value.a[0], F_e = seen.value.force[0];
    return std::abs(F_e - stiffness * x - damping * v) < 1e-12 &&
           std::abs(tool.mass * a + tool.damping * v + F_e - force_at(seen.taken)) < 1e-12;
  }

  // Until the factor is that, for 60 s on a machine that has no time for it. Whether it came to that.
  bool reaches(double wanted) {
    PeriodicLoop loop({.period = 1ms, .duration = 60s});
    loop.run(std::stop_token{}, [&](const TickTime& at) noexcept {
      tick(at);
      return factor != wanted;
    });
    return factor == wanted;
  }
};

}  // namespace

TEST_CASE("a slow environment in a process of its own is killed, stalled and replaced: the force fades and returns") {
  const std::string name = own_name("press");
  const Shared shared = Shared::make(name);
  Press press(*shared);
  CHECK(press.reaches(0));

  Child first([&] { serve(name); });
  REQUIRE(press.reaches(1));
  first.end();
  REQUIRE(press.reaches(0));
  CHECK(press.was_stale);

  const int before = press.fresh;
  Child second([&] { serve(name); });
  REQUIRE(press.reaches(1));
  CHECK(press.fresh > before);
  second.signal(SIGSTOP);
  REQUIRE(press.reaches(0));
  CHECK(press.was_stale);
  // who has only stopped may not be replaced
  CHECK(contains(refusal([&] { (void)Shared::use(name); }), "process " + std::to_string(second.id()) + " uses it"));
  second.signal(SIGCONT);
  REQUIRE(press.reaches(1));

  second.signal(SIGSTOP);
  REQUIRE(press.reaches(0));
  second.end();
  const Child third([&] { serve(name); });
  REQUIRE(press.reaches(1));

  CHECK(press.torn == 0);
  CHECK(press.too_long == 0);
  CHECK(press.too_steep == 0);
}

TEST_CASE("an object that nobody has made is refused") {
  CHECK(contains(refusal([] { (void)Shared::use("/limpid-test-none"); }),
                 "SharedObject /limpid-test-none: no process has made it"));
}

TEST_CASE("an object that was made for something else is refused, and it is said for what") {
  const std::string name = own_name("other");
  const Shared shared = Shared::make(name);
  CHECK(contains(refusal([&] { (void)SharedObject<EnvironmentExchange<3>>::use(name); }),
                 "expected environment exchange 1: 3 axes, scalars of 53 bits, 1024 forces, in "));
  // of the same size
  struct Other {
    alignas(Exchange) std::array<std::byte, sizeof(Exchange)> bytes;
    static std::string layout() { return "something else"; }
  };
  CHECK(contains(refusal([&] { (void)SharedObject<Other>::use(name); }),
                 "expected something else, got environment exchange 1: 1 axes, scalars of 53 bits"));
}

TEST_CASE("a name that a living process has is refused to another; after it was killed it is taken over") {
  const std::string name = own_name("maker");
  {
    const Shared shared = Shared::make(name);
    CHECK(contains(refusal([&] { (void)Shared::make(name); }), "another process has made it"));
  }
  CHECK(contains(refusal([&] { (void)Shared::use(name); }), "no process has made it"));
  Child child([&] {
    const Shared shared = Shared::make(name);
    pause();
  });
  while (!refusal([&] { (void)Shared::use(name); }).empty()) std::this_thread::yield();
  child.end();
  const Shared again = Shared::make(name);
  CHECK(again->forces.written() == 0);
}

TEST_CASE("a name that cannot be is refused in the system's words") {
  CHECK(contains(refusal([] { (void)Shared::make("/a/b"); }), "SharedObject /a/b: "));
}
