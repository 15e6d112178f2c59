// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

namespace limpid::bench {

/// What a millisecond of other work does to the caches before a tick: a call walks 64 MiB of memory.
class OtherWork {
 public:
  void operator()() {
    for (std::size_t line = 0; line < memory_.size(); line += 64) ++memory_[line];
    benchmark::DoNotOptimize(memory_.data());
  }

  [[nodiscard]] std::size_t mebibytes() const { return memory_.size() >> 20; }

 private:
  std::vector<unsigned char> memory_ = std::vector<unsigned char>(std::size_t{64} << 20);
};

}  // namespace limpid::bench
