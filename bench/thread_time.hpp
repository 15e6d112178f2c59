// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>

namespace limpid::bench {

/// Processor time of this thread, ns: what the wall clock loses to other processes does not count. Asking costs some
/// tenths of a microsecond, so ask around turns of 50 us or more.
[[nodiscard]] inline double thread_ns() noexcept {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

}  // namespace limpid::bench
