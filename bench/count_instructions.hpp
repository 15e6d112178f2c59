// SPDX-License-Identifier: MIT
#pragma once

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace limpid::bench {

/// Instructions that `work` takes, counted one by one in a child of this process: exact, whatever else the machine
/// does, and of all instruction sets that it has. Some microseconds for each. -1 where the system does not let a
/// process be traced.
template <typename Work>
[[nodiscard]] long count_instructions(Work&& work) {
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    std::raise(SIGSTOP);
    work();
    std::raise(SIGSTOP);
    _exit(0);
  }
  if (child < 0) return -1;
  int state = 0;
  long count = 0;
  waitpid(child, &state, 0);
  if (WIFSTOPPED(state)) {
    do {
      ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
      waitpid(child, &state, 0);
      ++count;
    } while (WIFSTOPPED(state) && WSTOPSIG(state) == SIGTRAP);
  }
  const bool counted = WIFSTOPPED(state) && WSTOPSIG(state) == SIGSTOP;
  kill(child, SIGKILL);
  waitpid(child, &state, 0);
  return counted ? count : -1;
}

}  // namespace limpid::bench
