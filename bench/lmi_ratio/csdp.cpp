// SPDX-License-Identifier: MIT
#include "solvers.hpp"

#include <support/csdp_process.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <utility>
#include <vector>

#include <sys/resource.h>

#ifdef LIMPID_CSDP
extern "C" {
#include <declarations.h>
}
#endif

namespace limpid::bench {

namespace {

/// A place to work in, where CSDP is told to print nothing.
class Scratch : public test::ScratchFolder {
 public:
  Scratch() {
    std::ofstream(path() / "param.csdp")
        << "axtol=1.0e-8\natytol=1.0e-8\nobjtol=1.0e-8\npinftol=1.0e8\ndinftol=1.0e8\nmaxiter=100\nminstepfrac=0.90\n"
           "maxstepfrac=0.97\nminstepp=1.0e-8\nminstepd=1.0e-8\nusexzgap=1\ntweakgap=0\naffine=0\nprintlevel=0\n"
           "perturbobj=1\nfastmode=0\n";
  }
};

/// SDPA's sparse format: min c'x with sum x_i F_i - F_0 >= 0.
void write(const Data& data, const std::filesystem::path& file) {
  std::ofstream out(file);
  out.precision(17);
  out << data.coefficients.size() << '\n' << data.block_sizes.size() << '\n';
  for (const int size : data.block_sizes) out << size << ' ';
  out << '\n';
  for (const double b : data.objective) out << -b << ' ';
  out << '\n';
  const auto list = [&](std::size_t matrix, const Data::Entries& entries, double sign) {
    for (const auto& e : entries) {
      out << matrix << ' ' << e.block + 1 << ' ' << e.col + 1 << ' ' << e.row + 1 << ' ' << sign * e.value << '\n';
    }
  };
  list(0, data.constant, -1);
  for (std::size_t i = 0; i < data.coefficients.size(); ++i) list(i + 1, data.coefficients[i], 1);
}

/// Processor time of the processes that have ended.
double children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

#ifdef LIMPID_CSDP

template <typename T>
T* allocate(std::size_t count) {  // free_prob frees
  return static_cast<T*>(std::malloc(count * sizeof(T)));
}

// In CSDP's words: min a'y with sum y_i A_i - C >= 0.
struct CsdpProblem {
  int n = 0;
  blockmatrix C{};
  double* a = nullptr;
  constraintmatrix* constraints = nullptr;

  explicit CsdpProblem(const Data& data) {
    const std::size_t blocks = data.block_sizes.size(), variables = data.coefficients.size();
    C.nblocks = static_cast<int>(blocks);
    C.blocks = allocate<blockrec>(blocks + 1);
    for (std::size_t b = 0; b < blocks; ++b) {
      const auto size = static_cast<std::size_t>(data.block_sizes[b]);
      blockrec& block = C.blocks[b + 1];
      block.blocksize = data.block_sizes[b];
      block.blockcategory = MATRIX;
      block.data.mat = static_cast<double*>(std::calloc(size * size, sizeof(double)));
      n += data.block_sizes[b];
    }
    for (const auto& e : data.constant) {
      blockrec& block = C.blocks[e.block + 1];
      block.data.mat[e.row + e.col * block.blocksize] = -e.value;
      block.data.mat[e.col + e.row * block.blocksize] = -e.value;
    }
    a = allocate<double>(variables + 1);
    constraints = allocate<constraintmatrix>(variables + 1);
    for (std::size_t i = 0; i < variables; ++i) {
      a[i + 1] = -data.objective[static_cast<Eigen::Index>(i)];
      constraints[i + 1].blocks = nullptr;
      std::map<int, std::vector<SymmetricEntry<double>>> by_block;
      for (const auto& e : data.coefficients[i]) by_block[e.block].push_back(e);
      for (auto entry = by_block.rbegin(); entry != by_block.rend(); ++entry) {
        add(static_cast<int>(i) + 1, entry->first, data.block_sizes[static_cast<std::size_t>(entry->first)],
            entry->second);
      }
    }
  }

  void add(int constraint, int block, int size, const std::vector<SymmetricEntry<double>>& entries) const {
    auto* sparse = allocate<sparseblock>(1);
    sparse->blocknum = block + 1;
    sparse->blocksize = size;
    sparse->constraintnum = constraint;
    sparse->next = constraints[constraint].blocks;
    sparse->nextbyblock = nullptr;
    sparse->issparse = 0;
    sparse->numentries = static_cast<int>(entries.size());
    sparse->entries = allocate<double>(entries.size() + 1);
    sparse->iindices = allocate<int>(entries.size() + 1);
    sparse->jindices = allocate<int>(entries.size() + 1);
    for (std::size_t e = 0; e < entries.size(); ++e) {
      sparse->entries[e + 1] = entries[e].value;
      sparse->iindices[e + 1] = entries[e].col + 1;
      sparse->jindices[e + 1] = entries[e].row + 1;
    }
    constraints[constraint].blocks = sparse;
  }
};

#endif

}  // namespace

Solver csdp_library() {
  Solver solver;
  solver.name = "CSDP";
#ifdef LIMPID_CSDP
  solver.present = true;
  solver.how = "easy_sdp in process, without setting up its data";
  solver.solve = [](const Data& data) {
    static const Scratch scratch;
    static const auto home = std::filesystem::current_path();
    const int k = static_cast<int>(data.coefficients.size());
    CsdpProblem problem(data);
    blockmatrix X{}, Z{};
    double *y = nullptr, primal = 0, dual = 0;
    std::filesystem::current_path(scratch.path());
    initsoln(problem.n, k, problem.C, problem.a, problem.constraints, &X, &y, &Z);
    const double start = processor_seconds();
    easy_sdp(problem.n, k, problem.C, problem.a, problem.constraints, 0.0, &X, &y, &Z, &primal, &dual);
    const double time = processor_seconds() - start;
    std::filesystem::current_path(home);
    free_prob(problem.n, k, problem.C, problem.a, problem.constraints, X, y, Z);
    return std::pair(-dual, time);
  };
#endif
  return solver;
}

Solver csdp_process() {
  Solver solver;
  solver.name = "CSDP";
  solver.present = test::has_csdp();
  solver.how = "as a process, its processor time less that for a problem of one number";
  solver.solve = [](const Data& data) {
    static const Scratch scratch;
    const auto run = [&](const Data& problem) {
      write(problem, scratch.path() / "problem.dat-s");
      const std::string command = "cd '" + scratch.path().string() + "' && csdp problem.dat-s solution > log 2>&1";
      const double start = children_seconds();
      [[maybe_unused]] const int status = std::system(command.c_str());  // 3: less accurate than asked
      return children_seconds() - start;
    };
    Data trivial;  // max t with 1 - t >= 0
    trivial.block_sizes = {1};
    trivial.coefficients = {{{0, 0, 0, -1.0}}};
    trivial.constant = {{0, 0, 0, 1.0}};
    trivial.objective = Eigen::VectorXd::Ones(1);
    const double overhead = run(trivial), time = run(data);
    std::ifstream solution(scratch.path() / "solution");
    double t = 0;
    for (std::size_t i = 0; i < data.coefficients.size(); ++i) solution >> t;  // the last variable
    return std::pair(t, time - overhead);
  };
  return solver;
}

}  // namespace limpid::bench
