// SPDX-License-Identifier: MIT
#include "solvers.hpp"

#include <cstdio>
#include <iostream>

#include <fcntl.h>
#include <unistd.h>

#ifdef LIMPID_SDPA
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <sdpa_call.h>
#pragma GCC diagnostic pop
#endif

namespace limpid::bench {

#ifdef LIMPID_SDPA
namespace {

/// Sends what is printed nowhere for as long as it lives.
class Silence {
 public:
  Silence() {
    std::fflush(stdout);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
  }
  ~Silence() {
    std::fflush(stdout);
    std::cout.flush();
    dup2(stdout_, STDOUT_FILENO);
    close(stdout_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int stdout_ = dup(STDOUT_FILENO);
};

}  // namespace
#endif

Solver sdpa_library() {
  Solver solver;
  solver.name = "SDPA";
#ifdef LIMPID_SDPA
  solver.present = true;
  solver.how = "SDPA::solve in process, without setting up its data";
  solver.solve = [](const Data& data) {
    // min c'x with sum x_i F_i - F_0 >= 0
    SDPA problem;
    problem.setDisplay(nullptr);
    problem.setParameterType(SDPA::PARAMETER_DEFAULT);
    problem.setNumThreads(1);
    const int variables = static_cast<int>(data.coefficients.size());
    problem.inputConstraintNumber(variables);
    problem.inputBlockNumber(static_cast<int>(data.block_sizes.size()));
    for (std::size_t b = 0; b < data.block_sizes.size(); ++b) {
      problem.inputBlockSize(static_cast<int>(b) + 1, data.block_sizes[b]);
      problem.inputBlockType(static_cast<int>(b) + 1, SDPA::SDP);
    }
    problem.initializeUpperTriangleSpace();
    const auto list = [&](int matrix, const Data::Entries& entries, double sign) {
      for (const auto& e : entries) {
        problem.inputElement(matrix, e.block + 1, e.col + 1, e.row + 1, sign * e.value);
      }
    };
    list(0, data.constant, -1);
    for (int i = 0; i < variables; ++i) {
      problem.inputCVec(i + 1, -data.objective[i]);
      list(i + 1, data.coefficients[static_cast<std::size_t>(i)], 1);
    }
    problem.initializeUpperTriangle();
    problem.initializeSolve();
    const Silence silence;  // it remarks on being nearly done
    const double start = processor_seconds();
    problem.solve();
    const double time = processor_seconds() - start;
    const double t = -problem.getPrimalObj();
    problem.terminate();
    return std::pair(t, time);
  };
#endif
  return solver;
}

}  // namespace limpid::bench
