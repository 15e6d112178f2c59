// SPDX-License-Identifier: MIT
// One whole tick, three axes, a fresh sample on each: composed, written by hand, and straightforward.
#include "tick/differences.hpp"
#include "tick/form.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

namespace {

using namespace limpid::bench;

bool all_agree() {
  const auto differences = differences_from_straightforward();
  return std::all_of(differences.begin(), differences.end(), [](const FormDifference& of) { return of.agrees(); });
}

const bool registered = [] {
  for (Form& form : all_forms()) {
    benchmark::RegisterBenchmark(("tick_" + std::string(form.name())).c_str(), [form](benchmark::State& state) mutable {
      if (form.name() == "straightforward" && !all_agree()) state.SkipWithError("outputs differ");
      for (auto _ : state) form.run(1);
    });
  }
  return true;
}();

}  // namespace
