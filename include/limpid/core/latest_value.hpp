// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace limpid {

/// The newest value that one thread has for another: neither ever waits for the other. Three places: the writer fills
/// one, the reader looks at another, and the third lies between them and is exchanged for theirs. What is not read
/// before the next one is written is lost; what is read is whole.
///
/// One thread writes and one reads. They may be processes, with the object in memory that they share, where T holds no
/// pointers; who is killed may be replaced, wherever it was: which place is whose is one word.
/// @realtime  write, take, value: no allocation where copying T makes none, no throw; one atomic exchange, repeated
/// when
///            the other side exchanges in that moment: by the writer once at most, by the reader once a write
template <typename T>
requires std::is_nothrow_copy_assignable_v<T>
class LatestValue {
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

 public:
  explicit LatestValue(const T& initial = T{}) noexcept(std::is_nothrow_copy_constructible_v<T>)
      : places_{Place{initial}, Place{initial}, Place{initial}} {}

  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;
  LatestValue(LatestValue&&) = delete;
  LatestValue& operator=(LatestValue&&) = delete;
  ~LatestValue() = default;

  /// By the writer.
  void write(const T& value) noexcept {
    std::uint32_t owners = owners_.load(std::memory_order_relaxed);
    places_[place(owners, writers)].value = value;
    while (!exchange(owners, swapped(owners, writers) | fresh)) {
    }
  }

  /// By the reader: takes what was written last, if anything was since the last call.
  /// @return  whether `value` is another one now
  [[nodiscard]] bool take() noexcept {
    std::uint32_t owners = owners_.load(std::memory_order_relaxed);
    if ((owners & fresh) == 0) return false;
    while (!exchange(owners, swapped(owners, readers) & ~fresh)) {
    }
    return true;
  }

  /// By the reader: what it took last, at first the initial value.
  [[nodiscard]] const T& value() const noexcept {
    return places_[place(owners_.load(std::memory_order_relaxed), readers)].value;
  }

 private:
  // Where in the word the indices of the three places stand, and whether the one between was written and not yet read.
  static constexpr std::uint32_t writers = 0, between = 2, readers = 4, fresh = 1U << 6;
  static constexpr std::uint32_t at_first = 0U << writers | 1U << between | 2U << readers;

  static constexpr std::uint32_t place(std::uint32_t owners, std::uint32_t whose) noexcept {
    return owners >> whose & 3U;
  }
  // The place of one side and the one between exchanged.
  static constexpr std::uint32_t swapped(std::uint32_t owners, std::uint32_t side) noexcept {
    const std::uint32_t differ = place(owners, side) ^ place(owners, between);
    return owners ^ (differ << side | differ << between);
  }
  // Release: what was done with the place that is given; acquire: with the one that is received.
  bool exchange(std::uint32_t& owners, std::uint32_t wanted) noexcept {
    return owners_.compare_exchange_weak(owners, wanted, std::memory_order_acq_rel, std::memory_order_relaxed);
  }

  static constexpr std::size_t line = 64;  // bytes of a cache line
  struct alignas(line) Place {
    T value;
  };

  std::array<Place, 3> places_;
  alignas(line) std::atomic<std::uint32_t> owners_{at_first};
};

}  // namespace limpid
