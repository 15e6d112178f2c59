// SPDX-License-Identifier: MIT
// The whole tick of three axes in all its forms: `tick ratio`, `tick instructions`, `tick latency [TICKS]`,
// `tick cold [TICKS]`, `tick once FORM TICKS`. Of the composed form some ratios are asked, and of all that they agree:
// 1 is returned where one is missed.
#include "count_instructions.hpp"
#include "other_work.hpp"
#include "thread_time.hpp"
#include "tick/differences.hpp"
#include "tick/form.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
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

/// What is asked of the composed form.
struct Bound {
  std::string_view of;
  double most;
};
constexpr Bound asked_ratios[] = {{"simd", 1.25}, {"straightforward", 1 / 4.5}, {"dynamic", 1 / 25.0}};
constexpr double asked_p999 = 2.5;  // p99.9 over the median

constexpr double turn_ns = 200e3;

std::size_t index_of(const std::vector<Form>& forms, std::string_view name) {
  const auto form = std::find_if(forms.begin(), forms.end(), [&](const Form& f) { return f.name() == name; });
  return static_cast<std::size_t>(form - forms.begin());
}

/// One line of what was asked and what is; true where it is met.
bool report(std::string_view what, double is, double most) {
  const bool met = is <= most;  // not where it is NaN
  std::printf("%-42.*s %10.3g, asked: at most %.3g%s\n", static_cast<int>(what.size()), what.data(), is, most,
              met ? "" : "; missed");
  return met;
}

/// Ticks in a turn of some `turn_ns`: turns of equal time are disturbed alike.
long ticks_of_a_turn(Form& form) {
  long ticks = 16;
  for (;;) {
    const double start = thread_ns();
    form.run(ticks);
    const double took = thread_ns() - start;
    if (took > turn_ns / 4) return std::max(1L, std::lround(static_cast<double>(ticks) * turn_ns / took));
    ticks *= 2;
  }
}

/// Of each form and turn, ns of processor time a tick; the forms take turns, so that a busy machine slows all alike.
std::vector<std::vector<double>> time_in_turns(std::vector<Form>& forms, int turns) {
  std::vector<long> ticks;
  for (Form& form : forms) {
    form.run(2000);
    ticks.push_back(ticks_of_a_turn(form));
  }
  std::vector<std::vector<double>> ns(forms.size());
  for (int turn = 0; turn < turns; ++turn) {
    for (std::size_t i = 0; i < forms.size(); ++i) {
      const double start = thread_ns();
      forms[i].run(ticks[i]);
      ns[i].push_back((thread_ns() - start) / static_cast<double>(ticks[i]));
    }
  }
  return ns;
}

double median_ratio(const std::vector<double>& ns, const std::vector<double>& reference) {
  std::vector<double> ratios;
  for (std::size_t turn = 0; turn < ns.size(); ++turn) ratios.push_back(ns[turn] / reference[turn]);
  return median(ratios);
}

/// With other work before each tick; the forms take turns, so that none finds its instructions in the nearest cache.
std::vector<LatencyHistogram> time_cold(std::vector<Form>& forms, long ticks) {
  OtherWork other_work;
  std::vector<LatencyHistogram> histograms(forms.size());
  for (Form& form : forms) form.run(2000);
  for (long tick = 0; tick < ticks; ++tick) {
    for (std::size_t i = 0; i < forms.size(); ++i) {
      other_work();
      forms[i].run(1, &histograms[i]);
    }
  }
  return histograms;
}

/// Whether all forms agree with the straightforward one.
bool print_differences() {
  bool agree = true;
  std::printf("%-24s %10s %10s %10s, from the straightforward form\n", "", "torque", "theta", "Gamma");
  for (const FormDifference& of : differences_from_straightforward()) {
    agree = agree && of.agrees();
    std::printf("%-24s %10.2g %10.2g %10.2g, at most %.0e and %.0e%s\n", of.form.data(), of.torque, of.theta, of.Gamma,
                of.most_torque, of.most_law, of.agrees() ? "" : "; missed");
  }
  return agree;
}

/// Time over that of the straightforward form; 1 where the composed form misses what is asked of it.
int print_ratios() {
  constexpr int turns = 2000, cold_ticks = 300;
  std::vector<Form> forms = all_forms();
  const auto ns = time_in_turns(forms, turns);
  std::printf("median of %d turns of %.0f us of processor time, a fresh sample on each tick\n%-24s %8s %8s\n", turns,
              turn_ns / 1e3, "", "ns", "ratio");
  for (std::size_t i = 0; i < forms.size(); ++i) {
    std::printf("%-24s %8.0f %8.3f\n", forms[i].name().data(), median(ns[i]),
                median_ratio(ns[i], ns[index_of(forms, "straightforward")]));
  }
  std::printf("\n");
  bool met = print_differences();
  for (const auto& [of, most] : asked_ratios) {
    const double is = median_ratio(ns[index_of(forms, "composed")], ns[index_of(forms, of)]);
    met = report("composed over " + std::string(of), is, most) && met;
  }
  std::vector<Form> pair{simd_form(), composed_form()};
  const auto cold = time_cold(pair, cold_ticks);
  const auto ns_cold = [&](std::size_t i) { return static_cast<double>(cold[i].quantile(0.5).count()); };
  std::printf("%-42s %10.3g, nothing asked (medians of %.0f and %.0f ns, the clock's own cost included)\n",
              "composed over simd, caches walked", ns_cold(1) / ns_cold(0), ns_cold(1), ns_cold(0));
  return met ? 0 : 1;
}

/// 1 where the composed form misses what is asked of it.
int print_latencies(long ticks) {
  std::printf("%ld ticks; ns, the clock's own cost included\n%-24s %8s %8s %8s %10s\n", ticks, "", "p50", "p99",
              "p99.9", "max");
  bool met = true;
  for (Form& form : all_forms()) {
    LatencyHistogram histogram;
    form.run(ticks, &histogram);
    const auto at = [&](double p) { return static_cast<long>(histogram.quantile(p).count()); };
    std::printf("%-24s %8ld %8ld %8ld %10ld\n", form.name().data(), at(0.5), at(0.99), at(0.999),
                static_cast<long>(histogram.max().count()));
    if (form.name() != "composed") continue;
    met = report("  composed, p99.9 over the median", static_cast<double>(at(0.999)) / static_cast<double>(at(0.5)),
                 asked_p999);
  }
  return met ? 0 : 1;
}

int print_cold(long ticks) {
  std::vector<Form> forms{straightforward_form(), simd_form(), composed_form()};
  const auto histograms = time_cold(forms, ticks);
  std::printf("%ld ticks, %zu MiB walked before each; ns, the clock's own cost included\n%-24s %8s %8s\n", ticks,
              OtherWork().mebibytes(), "", "p50", "p90");
  for (std::size_t i = 0; i < forms.size(); ++i) {
    std::printf("%-24s %8ld %8ld\n", forms[i].name().data(), static_cast<long>(histograms[i].quantile(0.5).count()),
                static_cast<long>(histograms[i].quantile(0.9).count()));
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
  const long ticks = argc > 2 ? std::atol(argv[argc - 1]) : command == "cold" ? 1000 : 10'000'000;
  if (command == "latency" && argc <= 3 && ticks > 0) return print_latencies(ticks);
  if (command == "cold" && argc <= 3 && ticks > 0) return print_cold(ticks);
  if (command == "once" && argc == 4 && ticks > 0) return run_once(argv[2], ticks);
  std::fprintf(stderr, "tick: expected ratio, instructions, latency [TICKS], cold [TICKS] or once FORM TICKS\n");
  return 1;
}
