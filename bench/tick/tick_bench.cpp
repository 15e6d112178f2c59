// SPDX-License-Identifier: MIT
// One whole tick, three axes, a fresh sample on each: composed, written by hand, and straightforward.
#include "tick/form.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace limpid::bench;

const bool registered = [] {
  for (Form& form : all_forms()) {
    benchmark::RegisterBenchmark(("tick_" + std::string(form.name())).c_str(), [form](benchmark::State& state) mutable {
      const bool reference = form.name() == "straightforward";
      const double difference = reference ? difference_from_straightforward() : 0;
      if (!(difference < 1e-12)) state.SkipWithError("outputs differ");
      for (auto _ : state) form.run(1);
      if (reference) state.counters["difference"] = difference;
    });
  }
  return true;
}();

}  // namespace
