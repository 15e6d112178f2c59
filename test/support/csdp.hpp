// SPDX-License-Identifier: MIT
#pragma once

#include "support/csdp_process.hpp"

#include <limpid/design/lmi_problem.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace limpid::test {

/// Writes max t with F(x) - t I >= 0 and 0.9 n <= tr F(x) <= n for CSDP, as min c'z with sum z_i G_i - G_0 >= 0.
inline void write_margin_problem(const LmiProblem<double>& problem, const std::filesystem::path& file) {
  constexpr int constant = LmiExpression<double>::constant;
  const int t = problem.unknowns + 1;  // variables count from 1
  std::ofstream out(file);
  out.precision(std::numeric_limits<double>::max_digits10);
  out << t << '\n' << problem.blocks.size() + 1 << '\n';
  int dimension = 0;
  for (const auto& block : problem.blocks) {
    out << block.size << ' ';
    dimension += block.size;
  }
  out << "-2\n";
  for (int i = 1; i < t; ++i) out << "0 ";
  out << "-1\n";
  std::vector<double> trace(static_cast<std::size_t>(t) + 1, 0.0);
  for (std::size_t j = 0; j < problem.blocks.size(); ++j) {
    for (const auto& term : problem.blocks[j].terms) {
      const bool is_constant = term.unknown == constant;
      const double value = is_constant ? -term.factor.centre() : term.factor.centre();
      out << term.unknown + 1 << ' ' << j + 1 << ' ' << term.column + 1 << ' ' << term.row + 1 << ' ' << value << '\n';
      if (term.row == term.column) trace[static_cast<std::size_t>(term.unknown + 1)] += value;
    }
    for (int i = 1; i <= problem.blocks[j].size; ++i) out << t << ' ' << j + 1 << ' ' << i << ' ' << i << " -1\n";
  }
  const auto last = problem.blocks.size() + 1;
  trace[0] = -trace[0];
  out << "0 " << last << " 1 1 " << trace[0] - dimension << '\n';        // n - tr F
  out << "0 " << last << " 2 2 " << 0.9 * dimension - trace[0] << '\n';  // tr F - 0.9 n
  for (int i = 1; i < t; ++i) {
    const double value = trace[static_cast<std::size_t>(i)];
    if (value == 0) continue;
    out << i << ' ' << last << " 1 1 " << -value << '\n' << i << ' ' << last << " 2 2 " << value << '\n';
  }
}

/// CSDP's t for each of the problems, in the scale of tr F = n; nothing where it failed.
class Csdp {
 public:
  [[nodiscard]] std::optional<double> margin(const LmiProblem<double>& problem) const {
    write_margin_problem(problem, folder_.path() / "problem.dat-s");
    return solve();
  }
  /// Runs CSDP on what was written last.
  [[nodiscard]] std::optional<double> solve() const {
    const std::string command =
        "cd '" + folder_.path().string() + "' && OMP_NUM_THREADS=1 csdp problem.dat-s > log 2>&1";
    const int status = std::system(command.c_str());
    (void)status;  // it says by its log how it went
    std::ifstream log(folder_.path() / "log");
    std::optional<double> value;
    for (std::string line; std::getline(log, line);) {
      if (line.rfind("Primal objective value:", 0) == 0) value = -std::strtod(line.c_str() + 23, nullptr);
    }
    return value;
  }

 private:
  ScratchFolder folder_{};
};

}  // namespace limpid::test
