// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace limpid {

/// The last values that one thread has written for another, in order: neither ever waits for the other. Where the
/// reader is not called for more than `Capacity` writes, the oldest are lost, and it is told; what is read is whole.
///
/// One thread writes and one reads, and may be processes, with the object in memory that they share, where T holds no
/// pointers. Who is killed may be replaced, wherever it was. Where the reader stands is the reader's own affair: it
/// keeps the number of the value that comes next.
/// @tparam T         trivially copyable
/// @tparam Capacity  a power of two
/// @realtime  write, read: no allocation, no throw, no loop but over the words of one value
template <typename T, std::size_t Capacity>
requires std::is_trivially_copyable_v<T>
class RecentValues {
  static_assert(std::has_single_bit(Capacity));
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

 public:
  RecentValues() = default;
  RecentValues(const RecentValues&) = delete;
  RecentValues& operator=(const RecentValues&) = delete;
  RecentValues(RecentValues&&) = delete;
  RecentValues& operator=(RecentValues&&) = delete;
  ~RecentValues() = default;

  /// By the writer.
  void write(const T& value) noexcept {
    const std::uint64_t number = written_.load(std::memory_order_relaxed);
    std::array<std::uint64_t, words> of_value{};
    std::memcpy(of_value.data(), &value, sizeof(T));
    // Who sees one of these words sees that the place is being written anew.
    begun_.store(number + 1, std::memory_order_relaxed);
    Place& place = places_[number % Capacity];
    for (std::size_t i = 0; i < words; ++i) place[i].store(of_value[i], std::memory_order_release);
    written_.store(number + 1, std::memory_order_release);
  }

  /// How many have been written: the number of the one that comes next.
  [[nodiscard]] std::uint64_t written() const noexcept { return written_.load(std::memory_order_acquire); }

  /// By the reader: the value of a number from 0 on, below `written()`.
  /// @return  whether `value` is it; else it is lost, and `value` is not to be used
  [[nodiscard]] bool read(std::uint64_t number, T& value) const noexcept {
    const Place& place = places_[number % Capacity];
    std::array<std::uint64_t, words> of_value;  // NOLINT(*-member-init): filled at once
    for (std::size_t i = 0; i < words; ++i) of_value[i] = place[i].load(std::memory_order_acquire);
    std::memcpy(static_cast<void*>(&value), of_value.data(), sizeof(T));
    return begun_.load(std::memory_order_relaxed) <= number + Capacity;
  }

  /// The oldest that is still there, for a reader that has lost some.
  [[nodiscard]] std::uint64_t oldest() const noexcept {
    const std::uint64_t begun = begun_.load(std::memory_order_relaxed);
    return begun > Capacity ? begun - Capacity : 0;
  }

 private:
  static constexpr std::size_t words = (sizeof(T) + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
  using Place = std::array<std::atomic<std::uint64_t>, words>;

  static constexpr std::size_t line = 64;  // bytes of a cache line
  alignas(line) std::array<Place, Capacity> places_{};
  alignas(line) std::atomic<std::uint64_t> begun_ = 0;  // of the writer, and of the one below
  std::atomic<std::uint64_t> written_ = 0;
};

}  // namespace limpid
