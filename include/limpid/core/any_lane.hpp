// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace limpid::detail {

/// `n` float or double as the compiler's vector type.
template <std::floating_point Scalar, int n>
struct Packed {
  using Value [[gnu::vector_size(n * sizeof(Scalar))]] = Scalar;
};

/// Whether a comparison of vectors, 8 to 32 bytes, holds in any lane: by the processor's own test of sign bits where
/// it has one, else lane by lane.
template <typename Mask>
[[nodiscard, gnu::always_inline]] inline bool any_lane(const Mask& mask) noexcept {
  if constexpr (sizeof(Mask) == 32) {
#ifdef __AVX__
    Packed<double, 4>::Value signs;
    std::memcpy(&signs, &mask, sizeof signs);
    return __builtin_ia32_vtestzpd256(signs, signs) == 0;
#else
    using Half [[gnu::vector_size(16)]] = long long;
    Half low, high;
    std::memcpy(&low, &mask, sizeof low);
    std::memcpy(&high, static_cast<const char*>(static_cast<const void*>(&mask)) + sizeof low, sizeof high);
    const Half both = low | high;
    return any_lane(both);
#endif
  } else {
#ifdef __SSE2__
    if constexpr (sizeof(Mask) == 16) {
      Packed<float, 4>::Value signs;
      std::memcpy(&signs, &mask, sizeof signs);
      return __builtin_ia32_movmskps(signs) != 0;
    }
#endif
    bool any = false;
    for (std::size_t i = 0; i < sizeof(Mask) / sizeof(mask[0]); ++i) any = any || mask[i] != 0;
    return any;
  }
}

/// Whether the entries of an Array fill vectors of two or four.
template <typename Array>
inline constexpr bool in_packets = std::floating_point<typename Array::Scalar> &&
                                   sizeof(typename Array::Scalar) <= sizeof(double) &&
                                   (Array::SizeAtCompileTime == 2 ||
                                    (Array::SizeAtCompileTime > 0 && Array::SizeAtCompileTime % 4 == 0));

/// Whether a test holds anywhere in an array: it is given a mask to set and a vector, both by reference, as an ABI for
/// vectors by value depends on the processor.
template <typename Test, typename Array>
[[nodiscard, gnu::always_inline]] inline bool any_entry(Test test, const Array& array) noexcept {
  constexpr int size = Array::SizeAtCompileTime, n = size < 4 ? size : 4;
  using Value = typename Packed<typename Array::Scalar, n>::Value;
  using Mask = std::remove_cvref_t<decltype(std::declval<Value&>() == std::declval<Value&>())>;
  Mask any{};
#pragma GCC unroll 8
  for (int i = 0; i < size; i += n) {
    Value value;
    Mask here;
    std::memcpy(&value, array.data() + i, sizeof value);
    test(here, value);
    any |= here;
  }
  return any_lane(any);
}

/// Whether no entry is above `bound`, nor a NaN.
template <typename Array>
[[nodiscard, gnu::always_inline]] inline bool all_at_most(const Array& values,
                                                          const typename Array::Scalar& bound) noexcept {
  return !any_entry(
      [&](auto& mask, const auto& v) __attribute__((always_inline)) { mask = ~(v <= bound); }, values);
}

}  // namespace limpid::detail
