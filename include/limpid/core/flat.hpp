// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <concepts>
#include <utility>

namespace limpid {

namespace detail {

// With what g++'s sanitizers add to every access, inlining all takes it minutes a call.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool inlines_all = false;
#else
inline constexpr bool inlines_all = true;
#endif

// Not kept apart: where it is called once it becomes part of the caller, and what it returns is not built in memory.
template <typename F>
[[gnu::flatten]] inline decltype(auto) flattened(F&& f) noexcept(noexcept(f())) {
  return std::forward<F>(f)();
}

}  // namespace detail

/// Calls `f` with all that it calls inlined, but for functions marked noinline: compilers stop at a budget that depends
/// on the whole translation unit, and what they leave as calls among an expression's packets costs more than its sums.
/// A scalar that is a class, of many digits, has too much to inline and is called as it is, and so is any under a
/// sanitizer of g++.
/// @tparam Scalar  of what `f` computes
/// @realtime       one call
template <Real Scalar, typename F>
[[gnu::always_inline]] inline decltype(auto) flat(F&& f) noexcept(noexcept(f())) {
  if constexpr (std::floating_point<Scalar> && detail::inlines_all) {
    return detail::flattened(std::forward<F>(f));
  } else {
    return std::forward<F>(f)();
  }
}

}  // namespace limpid
