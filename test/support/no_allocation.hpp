// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>

namespace limpid::test {

/// Calls of any operator new since the program began, on all threads; counted in main.cpp.
extern std::atomic<std::size_t> allocations;

/// Lets Eigen assert on its own malloc, which passes by operator new, for as long as it lives.
struct EigenWithoutMalloc {
#ifdef EIGEN_RUNTIME_NO_MALLOC  // set by CMake for all tests, since Eigen must see it first
  EigenWithoutMalloc() { Eigen::internal::set_is_malloc_allowed(false); }
  ~EigenWithoutMalloc() { Eigen::internal::set_is_malloc_allowed(true); }
#else
  EigenWithoutMalloc() {}
  ~EigenWithoutMalloc() {}
#endif
  EigenWithoutMalloc(const EigenWithoutMalloc&) = delete;
  EigenWithoutMalloc& operator=(const EigenWithoutMalloc&) = delete;
};

/// Checks that `hot()` asks for no memory. Keep doctest's macros out of it: they may allocate.
template <typename F>
void check_no_allocation(F&& hot) {
  const std::size_t before = allocations.load();
  {
    const EigenWithoutMalloc no_malloc;
    hot();
  }
  CHECK(allocations.load() - before == 0);
}

}  // namespace limpid::test
