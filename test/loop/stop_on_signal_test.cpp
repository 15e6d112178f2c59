// SPDX-License-Identifier: MIT
#include <limpid/loop/realtime/stop_on_signal.hpp>

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <stop_token>
#include <thread>

using limpid::StopOnSignal;

namespace {

volatile std::sig_atomic_t heard = 0;
void hear(int /*signal*/) { heard = heard + 1; }

void wait_for_stop(const std::stop_source& stop) {
  while (!stop.stop_requested()) std::this_thread::yield();
}

// Runs `act` in a process of its own. How that ends.
template <typename Act>
int status_after(Act act) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    act();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a signal requests a stop, and is told") {
  std::stop_source stop;
  const StopOnSignal on_signal(stop);
  CHECK(on_signal.signal() == 0);
  CHECK(!stop.stop_requested());
  std::raise(SIGTERM);
  wait_for_stop(stop);
  CHECK(on_signal.signal() == SIGTERM);
}

TEST_CASE("which signals it listens to can be set") {
  std::stop_source stop;
  const StopOnSignal on_signal(stop, {SIGUSR1, SIGUSR2});
  std::raise(SIGUSR2);
  wait_for_stop(stop);
  CHECK(on_signal.signal() == SIGUSR2);
}

TEST_CASE("the second signal does what it does by default, also the other one") {
  for (const int second : {SIGINT, SIGTERM}) {
    CAPTURE(second);
    const int status = status_after([second] {
      std::stop_source stop;
      const StopOnSignal on_signal(stop);
      std::raise(SIGINT);
      std::raise(second);
    });
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == second);
  }
}

TEST_CASE("the earlier handlers are back when it ends, whether a signal came or not") {
  const auto earlier = std::signal(SIGUSR1, hear);
  for (const bool comes : {false, true}) {
    CAPTURE(comes);
    heard = 0;
    {
      std::stop_source stop;
      const StopOnSignal on_signal(stop, {SIGUSR1});
      if (comes) std::raise(SIGUSR1);
    }
    CHECK(heard == 0);
    std::raise(SIGUSR1);
    CHECK(heard == 1);
  }
  std::signal(SIGUSR1, earlier);
}

TEST_CASE("a signal just before it ends is not lost") {
  std::stop_source stop;
  {
    const StopOnSignal on_signal(stop, {SIGUSR1});
    std::raise(SIGUSR1);
  }
  CHECK(stop.stop_requested());
}

TEST_CASE("a signal that cannot be handled, or a second one of its kind, is refused") {
  const std::stop_source stop;
  CHECK_THROWS_AS(StopOnSignal(stop, {SIGUSR1, SIGKILL}), std::invalid_argument);
  const StopOnSignal on_signal(stop);
  CHECK_THROWS_WITH_AS(StopOnSignal(stop, {SIGUSR1}), "StopOnSignal: expected no other one at that time, got another",
                       std::invalid_argument);
}
