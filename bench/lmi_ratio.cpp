// SPDX-License-Identifier: MIT
// How many times faster the theorems are decided, with their certificates, than by CSDP and SDPA on the same data in
// the same run; a ratio counts only where the verdicts are equal.
#include "lmi_ratio/problems.hpp"
#include "lmi_ratio/solvers.hpp"

#include <design/palpation.hpp>
#include <limpid/design/printed_theorem5.hpp>
#include <limpid/design/printed_theorems.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/design/theorem5.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

using namespace limpid;
using namespace limpid::bench;
using limpid::test::design_at;
using limpid::test::rates;

/// Median over runs, after some that warm up.
template <typename F>
double median_seconds(int runs, F&& run) {
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) times.push_back(run());
  std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
  return times[static_cast<std::size_t>(runs) / 2];
}

/// Seconds of one call, from the median of batches.
template <typename F>
double time_of(F&& call) {
  const double once = processor_seconds();
  call();
  const int batch = std::clamp(static_cast<int>(2e-3 / (processor_seconds() - once)), 1, 1000);
  return median_seconds(15,
                        [&] {
                          const double start = processor_seconds();
                          for (int i = 0; i < batch; ++i) call();
                          return processor_seconds() - start;
                        }) /
         batch;
}

struct Case {
  std::string name;
  std::function<Verdict()> decide;
  Data reduced, printed;
  std::function<Verdict()> decide_printed;  ///< the general Lmi on the printed problem
};

/// The smaller the margin's threshold the more a solver of 1e-8 may err: between them nothing is claimed.
std::string verdict_of(double margin) { return margin > 1e-6 ? "feasible" : "infeasible"; }

bool all_equal = true;

std::string compare(const Solver& solver, const Data& data, Verdict ours, double our_time) {
  double margin = 0;
  const double time = median_seconds(9, [&] {
    const auto [t, seconds] = solver.solve(data);
    margin = t;
    return seconds;
  });
  const bool equal = verdict_of(margin) == describe(ours);
  all_equal = all_equal && equal;
  char text[64];
  std::snprintf(text, sizeof text, "%9.1f us %6.0f x%s", time * 1e6, time / our_time, equal ? "" : " DIFFERS");
  return text;
}

void run(const Case& c, const std::vector<Solver>& solvers) {
  const Verdict verdict = c.decide();
  const double ours = time_of(c.decide);
  std::printf("%-46s %-10s %8.1f us |", c.name.c_str(), std::string(describe(verdict)).c_str(), ours * 1e6);
  for (const Solver& solver : solvers) {
    std::printf(" %s reduced %s, printed %s |", solver.name.c_str(), compare(solver, c.reduced, verdict, ours).c_str(),
                compare(solver, c.printed, verdict, ours).c_str());
  }
  std::printf("\n");
  if (!c.decide_printed) return;
  const Verdict general = c.decide_printed();
  all_equal = all_equal && general == verdict;
  const double general_time = time_of(c.decide_printed);
  std::printf("%-46s %-10s %8.1f us |", "  general Lmi on the printed problem", std::string(describe(general)).c_str(),
              general_time * 1e6);
  for (const Solver& solver : solvers) {
    std::printf(" %s %s |", solver.name.c_str(), compare(solver, c.printed, general, general_time).c_str());
  }
  std::printf("\n");
}

Case theorem3_case(const std::string& name, double T_d, const Tissue<double>& tissue,
                   const std::optional<Gain<double>>& L) {
  const auto design = design_at(T_d);
  const std::vector<Tissue<double>> tissues{tissue};
  const auto printed = std::make_shared<PrintedTheorem<double>>(
      printed_theorem3<double>(design, std::span<const Tissue<double>>(tissues), L));
  Case c;
  c.name = "Theorem 3, " + name;
  if (L) {
    c.decide = [=] { return verify_theorem3(design, tissue, *L).verdict; };
    c.reduced = reduced_theorem3(design, tissue, *L);
  } else {
    c.decide = [=] { return design_theorem3(design, tissue).verdict; };
    c.reduced = reduced_theorem3(design, tissue);
  }
  c.printed = data_of(printed->lmi.problem());
  c.decide_printed = [=] { return printed->lmi.solve().verdict; };
  return c;
}

Case theorem5_case(const std::string& name, double T_d, double size) {
  const auto design = design_at(T_d, 0);
  const TissueBox<double> box{{1100 - 900 * size, 30 - 10 * size}, {1100 + 900 * size, 30 + 10 * size}};
  const auto printed = std::make_shared<PrintedTheorem5<double>>(printed_theorem5<double>(design, box, rates));
  Case c;
  c.name = "Theorem 5, " + name;
  c.decide = [=] { return design_theorem5(design, box, rates).verdict; };
  c.reduced = reduced_theorem5(design, box, rates);
  c.printed = data_of(printed->at_centre.lmi.problem());
  c.decide_printed = [=] { return printed->at_centre.lmi.solve().verdict; };
  return c;
}

/// All 399 cells of Table 6.4's map, each from nothing or trying its neighbour's certificate first.
void map(double T_d, const Gain<double>& L) {
  const auto design = design_at(T_d);
  int feasible = 0, infeasible = 0;
  const auto sweep = [&](bool neighbours) {
    feasible = infeasible = 0;
    Theorem3Certificate<double, 1> last;
    for (int damping = 20; damping <= 40; ++damping) {
      for (int column = 0; column < 19; ++column) {  // there and back, so that each cell has a neighbour
        const int stiffness = 200 + 100 * (damping % 2 == 0 ? column : 18 - column);
        const auto result = verify_theorem3(design, Tissue<double>{double(stiffness), double(damping)}, L,
                                            neighbours ? &last : nullptr);
        last = result.certificate;
        feasible += result.verdict == Verdict::feasible;
        infeasible += result.verdict == Verdict::infeasible;
      }
    }
  };
  const double cold = time_of([&] { sweep(false); }), warm = time_of([&] { sweep(true); });
  std::printf(
      "map of 399 cells, T_d = %.3f: %d feasible, %d infeasible, %d undecided; %.2f ms, with neighbours' "
      "certificates %.2f ms\n",
      T_d, feasible, infeasible, 399 - feasible - infeasible, cold * 1e3, warm * 1e3);
}

}  // namespace

int main(int, char** arguments) {
  if (!std::getenv("OPENBLAS_NUM_THREADS")) {  // one core for all: read when a program begins, and so it begins again
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    setenv("OMP_NUM_THREADS", "1", 1);
    execv("/proc/self/exe", arguments);
  }
  std::vector<Solver> solvers;
  for (const Solver& solver : {csdp_library(), sdpa_library()}) {
    if (solver.present) solvers.push_back(solver);
  }
  if (const Solver process = csdp_process(); !csdp_library().present && process.present) solvers.push_back(process);
  if (!csdp_library().present)
    std::printf("CSDP's library is absent (LIMPID_CSDP): %s\n",
                csdp_process().present ? "its program is run instead" : "skipped");
  if (!sdpa_library().present) std::printf("SDPA's library is absent: skipped\n");
  for (const Solver& solver : solvers) std::printf("%s: %s\n", solver.name.c_str(), solver.how.c_str());
  std::printf(
      "each a median of processor time; ratio: theirs by ours; reduced and printed: the same inequality as it is "
      "solved here "
      "and as the thesis prints it, both in scaled coordinates\n\n");

  const Gain<double> fast{-441.3, -12.12}, slow{-195.1, -4.89};
  run(theorem3_case("L given, T_d .016, (1100, 30)", .016, {1100, 30}, fast), solvers);
  run(theorem3_case("L given, T_d .1, (1100, 30)", .1, {1100, 30}, slow), solvers);
  run(theorem3_case("L given, near the border, T_d .1, (202, 23)", .1, {202, 23}, slow), solvers);
  run(theorem3_case("L given, near the border, T_d .1, (200, 23)", .1, {200, 23}, slow), solvers);
  run(theorem3_case("L given, T_d .1, (200, 40)", .1, {200, 40}, slow), solvers);
  run(theorem3_case("L free, T_d .016, (1100, 30)", .016, {1100, 30}, std::nullopt), solvers);
  run(theorem3_case("L free, T_d .1, (1100, 30)", .1, {1100, 30}, std::nullopt), solvers);
  run(theorem3_case("L free, near the border, T_d .1, (200, 31)", .1, {200, 31}, std::nullopt), solvers);
  run(theorem5_case("whole box, T_d .016", .016, 1), solvers);
  run(theorem5_case("whole box, T_d .032", .032, 1), solvers);
  run(theorem5_case("whole box, T_d .1", .1, 1), solvers);
  run(theorem5_case("box of .92, T_d .1", .1, .92), solvers);
  run(theorem5_case("box of .935, T_d .1", .1, .935), solvers);
  std::printf("\n");
  map(.016, fast);
  map(.032, {-203.3, -5.15});
  map(.1, slow);
  if (!all_equal) std::printf("\nverdicts differ\n");
  return all_equal ? 0 : 1;
}
