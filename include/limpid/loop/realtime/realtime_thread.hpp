// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace limpid {

/// What of a real-time thread the system has granted.
struct RealtimeGrants {
  bool fifo = false;                 ///< SCHED_FIFO at the priority asked for
  bool pinned = false;               ///< to the processor asked for
  bool memory_locked = false;        ///< no page of the process is taken from it
  std::vector<std::string> refused;  ///< a sentence for each thing asked for and not granted: why, what would permit it
};

/// Makes the thread that constructs it a real-time one, as far as that is asked for and permitted, and puts everything
/// back where it ends, on the same thread. What is not permitted is said, not thrown. It also lets the thread's timers
/// be exact to the nanosecond where it is not under SCHED_FIFO (they are late by 50 us by default), and touches 64 kB
/// of its stack, so that they are there. Linux.
///
/// Memory is locked for the whole process, as long as any of these asks for it, and stays locked where some of it was
/// before.
class RealtimeThread {
 public:
  struct Settings {
    int priority = 0;          ///< of SCHED_FIFO, 1 to 99; 0: the thread's scheduling stays as it is
    std::optional<int> cpu{};  ///< to run on, and no other, from 0; default: the thread's processors stay as they are
    bool lock_memory = false;  ///< mlockall: what is mapped, now and later, stays in memory

    /// @throws std::invalid_argument  where a field cannot serve
    void check() const {
      expect(priority >= 0 && priority <= 99, "RealtimeThread: priority", "0, or 1 to 99", priority);
      expect(!cpu || (*cpu >= 0 && *cpu < CPU_SETSIZE), "RealtimeThread: cpu",
             "from 0 to " + std::to_string(CPU_SETSIZE - 1), cpu.value_or(0));
    }
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit RealtimeThread(const Settings& settings) {
    settings.check();
    slack_ = prctl(PR_GET_TIMERSLACK);  // NOLINT(*-vararg)
    set_slack(1);
    if (settings.priority > 0) schedule(settings.priority);
    if (settings.cpu) pin(*settings.cpu);
    if (settings.lock_memory) lock_memory();
    touch_stack();
  }

  RealtimeThread(const RealtimeThread&) = delete;
  RealtimeThread& operator=(const RealtimeThread&) = delete;
  RealtimeThread(RealtimeThread&&) = delete;
  RealtimeThread& operator=(RealtimeThread&&) = delete;

  ~RealtimeThread() {
    if (grants_.memory_locked) unlock_memory();
    if (grants_.pinned) pthread_setaffinity_np(pthread_self(), sizeof earlier_cpus_, &earlier_cpus_);
    if (grants_.fifo) pthread_setschedparam(pthread_self(), earlier_policy_, &earlier_parameters_);
    if (slack_ > 0) set_slack(slack_);
  }

  [[nodiscard]] const RealtimeGrants& grants() const noexcept { return grants_; }

 private:
  static void set_slack(int ns) {
    prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(ns));  // NOLINT(*-vararg)
  }

  static std::string words(int error) { return std::system_category().message(error); }

  void schedule(int priority) {
    pthread_getschedparam(pthread_self(), &earlier_policy_, &earlier_parameters_);
    sched_param wanted{};
    wanted.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
    grants_.fifo = error == 0;
    if (grants_.fifo) return;
    const std::string number = std::to_string(priority);
    grants_.refused.push_back("SCHED_FIFO at priority " + number + ": " + words(error) +
                              "; permitted to a program with CAP_SYS_NICE, or to a user with `rtprio " + number +
                              "` or more in /etc/security/limits.conf");
  }

  void pin(int cpu) {
    CPU_ZERO(&earlier_cpus_);
    pthread_getaffinity_np(pthread_self(), sizeof earlier_cpus_, &earlier_cpus_);
    cpu_set_t wanted;
    CPU_ZERO(&wanted);
    CPU_SET(static_cast<std::size_t>(cpu), &wanted);
    const int error = pthread_setaffinity_np(pthread_self(), sizeof wanted, &wanted);
    grants_.pinned = error == 0;
    if (grants_.pinned) return;
    grants_.refused.push_back("processor " + std::to_string(cpu) + ": " + words(error) +
                              "; the machine must have it, and the process's cpuset must hold it");
  }

  // Of the process: how many have asked, and whether some of it was locked by others.
  struct Locked {
    std::mutex mutex;
    int wanted = 0;
    bool before = false;
  };
  static Locked& locked() {
    static Locked of_process;
    return of_process;
  }

  static bool any_locked() {
    std::ifstream status("/proc/self/status");
    for (std::string name; status >> name;) {
      long kilobytes = 0;
      if (name == "VmLck:") return (status >> kilobytes) && kilobytes > 0;
    }
    return false;
  }

  void lock_memory() {
    Locked& process = locked();
    const std::lock_guard guard(process.mutex);
    if (process.wanted == 0) process.before = any_locked();
    grants_.memory_locked = process.wanted > 0 || mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
    if (grants_.memory_locked) {
      ++process.wanted;
    } else {
      grants_.refused.push_back("mlockall: " + words(errno) +
                                "; permitted to a program with CAP_IPC_LOCK, or to a user with `memlock unlimited` in "
                                "/etc/security/limits.conf");
    }
  }

  static void unlock_memory() {
    Locked& process = locked();
    const std::lock_guard guard(process.mutex);
    if (--process.wanted == 0 && !process.before) munlockall();
  }

  // A volatile write to each page.
  [[gnu::noinline]] static void touch_stack() noexcept {
    constexpr std::size_t page = 4096;
    std::array<volatile unsigned char, 16 * page> stack;  // NOLINT(*-member-init): only touched
    for (std::size_t at = 0; at < stack.size(); at += page) stack[at] = 0;
  }

  RealtimeGrants grants_;
  int slack_ = 0;  // of timers, ns
  int earlier_policy_ = 0;
  sched_param earlier_parameters_{};
  cpu_set_t earlier_cpus_{};
};

}  // namespace limpid
