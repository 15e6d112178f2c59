// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/grid.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace limpid {

struct MapSettings {
  int threads = 0;  ///< that work at once, the caller's among them, at most 1024; 0: as many as the machine has
  /// Told the fraction of the cells that are done after each row, from one thread at a time; may be empty.
  std::function<void(double)> progress{};
};

/// What a test said of every cell of a grid.
template <typename Result, Real Scalar = double>
struct GridMap {
  Grid<Scalar> grid{};
  std::vector<Result> cells{};  ///< in the grid's order

  [[nodiscard]] decltype(auto) at(std::size_t row, std::size_t column) const {
    return cells[row * grid.columns() + column];
  }

  /// How many cells `holds` for.
  template <typename Predicate>
  [[nodiscard]] std::size_t count(Predicate holds) const {
    return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), holds));
  }
};

namespace detail {

// Hands out rows in order and keeps the exception of the first row that has one: whatever the number of threads, all
// rows before it are done.
class RowCounter {
 public:
  RowCounter(std::size_t rows, const std::function<void(double)>& progress) : rows_{rows}, progress_{progress} {}

  template <typename Work>
  void run(const Work& work) noexcept {
    for (std::size_t row = next_++; row < rows_; row = next_++) {
      try {
        work(row);
        report();
      } catch (...) {
        fail(row);
        return;
      }
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void report() {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    progress_(static_cast<double>(++done_) / static_cast<double>(rows_));
  }

  void fail(std::size_t row) noexcept {
    next_ = rows_;
    const std::lock_guard lock(mutex_);
    if (row >= failed_) return;
    failed_ = row;
    error_ = std::current_exception();
  }

  std::size_t rows_;
  const std::function<void(double)>& progress_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::size_t done_ = 0, failed_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
};

template <typename Work>
void run_rows(std::size_t rows, const MapSettings& settings, const Work& work) {
  RowCounter counter(rows, settings.progress);
  const auto available = settings.threads > 0 ? static_cast<std::size_t>(settings.threads)
                                              : std::max<std::size_t>(1, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> others;
    others.reserve(std::min(available, rows));
    try {
      for (std::size_t i = 1; i < std::min(available, rows); ++i) others.emplace_back([&] { counter.run(work); });
    } catch (const std::system_error&) {  // no more threads to be had: those there are do the work
    }
    counter.run(work);
  }
  counter.rethrow();
}

}  // namespace detail

/// Puts every cell of `grid` to `test`, rows in parallel.
///
/// `test(tissue)` says something of one tissue. `test(tissue, neighbour)` is given in `neighbour` what it said of the
/// cell before in the same row, null for a row's first, so that a certificate found there can be tried first. The
/// result does not depend on the number of threads. `test` is called from several threads at once. off line: allocates,
/// starts threads, waits without spinning
/// @tparam Result  what `test` returns; deduced where it takes the tissue alone. Default constructible
/// @throws std::invalid_argument  where the grid or a setting is refused; and what `test` or the progress throws, of
/// the
///                                first row in which it does
template <typename Result, Real Scalar, typename Test>
requires std::default_initializable<Result> && std::invocable < Test&, const Tissue<Scalar>
&, const Result* > [[nodiscard]] GridMap<Result, Scalar> map(const Grid<Scalar>& grid, Test&& test,
                                                             const MapSettings& settings = {}) {
  grid.check();
  expect(settings.threads >= 0 && settings.threads <= 1024, "MapSettings: threads", "0 to 1024", settings.threads);
  const std::size_t columns = grid.columns(), cells = grid.size();
  // No vector: vector<bool> cannot be filled in parallel.
  const std::unique_ptr<Result[]> results(new Result[cells]{});  // NOLINT(*-avoid-c-arrays)
  detail::run_rows(grid.rows(), settings, [&](std::size_t row) {
    Result* const first = results.get() + row * columns;
    for (std::size_t column = 0; column < columns; ++column) {
      first[column] = test(grid.at(row, column), column == 0 ? nullptr : first + column - 1);
    }
  });
  return {grid, {std::make_move_iterator(results.get()), std::make_move_iterator(results.get() + cells)}};
}

template <Real Scalar, typename Test, typename Result = std::invoke_result_t<Test&, const Tissue<Scalar>&>>
[[nodiscard]] GridMap<Result, Scalar> map(const Grid<Scalar>& grid, Test&& test, const MapSettings& settings = {}) {
  return map<Result>(
      grid, [&test](const Tissue<Scalar>& tissue, const Result*) { return test(tissue); }, settings);
}

}  // namespace limpid
