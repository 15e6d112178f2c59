// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/signal/sample.hpp>

#include <array>
#include <cstddef>

namespace limpid {

/// The last `Capacity` values of a signal and their instants; between two of them, the straight line.
/// @tparam T         +, - and * by its scalar, which is T::Scalar where there is one and else T itself; `is_finite(T)`
/// @tparam Capacity  entries kept: a power of two, so that an index wraps by a mask
/// @realtime         no allocation, no throw; `push` O(1), `at` twice log2 of the entry's age in entries
template <typename T, std::size_t Capacity = 512>
class History {
  static_assert(Capacity >= 2 && (Capacity & (Capacity - 1)) == 0, "History: Capacity is a power of two, at least 2");

 public:
  struct Entry {
    T value;
    Status status;
  };

  /// Adds a value; the oldest one leaves when the history is full.
  /// @return  `clock_backwards` (not after the newest) or `not_finite`: nothing was added
  [[nodiscard]] Status push(Time t, const T& value) noexcept {
    if (count_ > 0 && t <= time(count_ - 1)) return Status::clock_backwards;
    if (!is_finite(value)) return Status::not_finite;
    append(t, value);
    return Status::ok;
  }

  /// The same for a value that is known to be finite, at an instant known to be after the newest.
  void append(Time t, const T& value) noexcept {
    const std::size_t at = (first_ + count_) & mask;
    times_[at] = t;
    values_[at] = value;
    if (count_ < Capacity) {
      ++count_;
    } else {
      first_ = (first_ + 1) & mask;
    }
  }

  /// The value at `t`: the entry itself where there is one, else between its neighbours.
  /// @return status  `out_of_history`: before the oldest or after the newest, which is returned;
  ///                 `no_sample`: nothing is stored, zero is returned
  [[nodiscard]] Entry at(Time t) const noexcept {
    if (count_ == 0) return {zero<T>(), Status::no_sample};
    for (std::size_t age = 1; age <= 4 && age <= count_; ++age) {  // most often it is one of the last ticks
      if (time(count_ - age) == t) return {value(count_ - age), Status::ok};
    }
    const std::size_t i = first_not_before(t);
    if (i == count_) return {value(count_ - 1), Status::out_of_history};
    if (time(i) == t) return {value(i), Status::ok};
    if (i == 0) return {value(0), Status::out_of_history};
    const auto part = part_of_way<Scalar>(t, time(i - 1), time(i));
    return {T(value(i - 1) * (Scalar(1) - part) + value(i) * part), Status::ok};
  }

  [[nodiscard]] std::size_t size() const noexcept { return count_; }

  /// Entries in order, the oldest at 0.
  [[nodiscard]] const Time& time(std::size_t i) const noexcept { return times_[(first_ + i) & mask]; }
  [[nodiscard]] const T& value(std::size_t i) const noexcept { return values_[(first_ + i) & mask]; }

  /// Index of the first entry at or after `t`, `size()` where there is none. From the newest back in growing steps:
  /// what is asked for is mostly young.
  [[nodiscard]] std::size_t first_not_before(Time t) const noexcept {
    std::size_t low = count_, high = count_, back = 1;
    while (low > 0 && !(time(low - 1) < t)) {
      high = low - 1;
      low = high > back ? high - back : 0;
      back *= 2;
    }
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (time(middle) < t) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }

  void clear() noexcept { first_ = count_ = 0; }

  /// The last entry; zero at instant zero where nothing is stored.
  [[nodiscard]] Sample<T> newest() const noexcept {
    if (count_ == 0) return {};
    return {value(count_ - 1), time(count_ - 1), time(count_ - 1)};
  }

 private:
  static constexpr auto scalar_of() {
    if constexpr (requires { typename T::Scalar; }) {
      return typename T::Scalar{};
    } else {
      return T{};
    }
  }
  using Scalar = decltype(scalar_of());

  static constexpr std::size_t mask = Capacity - 1;

  std::array<Time, Capacity> times_{};  // apart from the values: a search touches few cache lines
  std::array<T, Capacity> values_{};
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace limpid
