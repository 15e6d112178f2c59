// SPDX-License-Identifier: MIT
// The whole tick of three axes in all its forms: `tick ratio`, `tick instructions`,
// `tick latency [TICKS]`, `tick once FORM TICKS`.
#include "count_instructions.hpp"
#include "tick/form.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace {

using namespace limpid;
using namespace limpid::bench;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Time over that of the straightforward form: all run in turns, so that a busy machine slows all alike.
int print_ratios() {
  constexpr int ticks = 500, turns = 2000;
  std::vector<Form> forms = all_forms();
  std::vector<std::vector<double>> ns(forms.size()), ratio(forms.size());
  for (int turn = 0; turn < turns; ++turn) {
    for (std::size_t i = 0; i < forms.size(); ++i) {
      const auto start = std::chrono::steady_clock::now();
      forms[i].run(ticks);
      const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
      ns[i].push_back(took.count() / ticks);
    }
    for (std::size_t i = 0; i < forms.size(); ++i) ratio[i].push_back(ns[i].back() / ns[1].back());  // 1: the reference
  }
  std::printf("median of %d turns of %d ticks, a fresh sample on each; outputs equal to %.1g\n%-24s %8s %8s\n", turns,
              ticks, difference_from_straightforward(), "", "ns", "ratio");
  for (std::size_t i = 0; i < forms.size(); ++i) {
    std::printf("%-24s %8.0f %8.3f\n", forms[i].name().data(), median(ns[i]), median(ratio[i]));
  }
  return 0;
}

int print_latencies(long ticks) {
  std::printf("%ld ticks; ns, the clock's own cost included\n%-24s %8s %8s %8s %10s\n", ticks, "", "p50", "p99",
              "p99.9", "max");
  for (Form& form : all_forms()) {
    LatencyHistogram histogram;
    form.run(ticks, &histogram);
    const auto at = [&](double p) { return static_cast<long>(histogram.quantile(p).count()); };
    std::printf("%-24s %8ld %8ld %8ld %10ld\n", form.name().data(), at(0.5), at(0.99), at(0.999),
                static_cast<long>(histogram.max().count()));
  }
  return 0;
}

/// Of one tick: the difference of two runs of different length, less that of the empty form.
int print_instructions() {
  constexpr long few = 8, more = 24, settling = 2000;
  std::printf("%-24s instructions a tick\n", "");
  long empty = 0;
  for (Form& form : all_forms()) {
    form.run(settling);
    const long base = count_instructions([&] { form.run(few); });
    const long longer = count_instructions([&] { form.run(more); });
    if (base < 0 || longer < 0) {
      std::fprintf(stderr, "tick instructions: this system does not let a process be traced\n");
      return 1;
    }
    const long tick = (longer - base) / (more - few);
    if (form.name() == "empty") empty = tick;
    std::printf("%-24s %ld\n", form.name().data(), tick - empty);
  }
  return 0;
}

/// For a profiler.
int run_once(std::string_view name, long ticks) {
  for (Form& form : all_forms()) {
    if (form.name() != name) continue;
    form.run(ticks);
    return 0;
  }
  std::fprintf(stderr, "tick once: expected the name of a form, as `tick ratio` prints it, and a number of ticks\n");
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view command = argc > 1 ? argv[1] : "";
  if (command == "ratio" && argc == 2) return print_ratios();
  if (command == "instructions" && argc == 2) return print_instructions();
  const long ticks = argc > 2 ? std::atol(argv[argc - 1]) : 10'000'000;
  if (command == "latency" && argc <= 3 && ticks > 0) return print_latencies(ticks);
  if (command == "once" && argc == 4 && ticks > 0) return run_once(argv[2], ticks);
  std::fprintf(stderr, "tick: expected ratio, instructions, latency [TICKS] or once FORM TICKS\n");
  return 1;
}
