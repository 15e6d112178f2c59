// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace limpid::examples {

/// What `decouple` is asked to do: a force along x on the five-bar, and what then moves along y.
struct DecoupleOptions {
  double frequency = 5;          ///< of the operator's force, Hz
  std::string filter = "first";  ///< Q of the run: first, butterworth or q31; the table has all
  double cutoff = 50;            ///< of Q in the run, Hz
  double force = 0.03;           ///< amplitude, N
  std::string json{}, plot{};    ///< a file and a directory; empty: not written
};

/// Takes the options of `decouple` from a command line.
void add_decouple_options(CLI::App& app, DecoupleOptions& options);

/// Prints the table of the linear device and the runs of the simulated one, and writes what is asked for.
/// @returns exit code: 0; 2 where a run did not end
/// @throws std::invalid_argument  where the cut-off is beyond the filter's limit of stability
int run_decouple(const DecoupleOptions& options);

}  // namespace limpid::examples
