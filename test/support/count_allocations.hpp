// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

// Counts every operator new of a program; for one of its sources.
namespace limpid::test {

extern std::atomic<std::size_t> allocations;
std::atomic<std::size_t> allocations = 0;

namespace {

void* counted(void* memory) {
  ++allocations;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace
}  // namespace limpid::test

// The array and nothrow forms of the standard library call these; inlined, they look mismatched to g++.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return limpid::test::counted(std::malloc(size == 0 ? 1 : size));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t align) {
  const auto alignment = static_cast<std::size_t>(align);
  return limpid::test::counted(std::aligned_alloc(alignment, (size / alignment + 1) * alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
