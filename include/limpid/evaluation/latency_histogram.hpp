// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/time.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace limpid {

/// Histogram of durations in bins that widen with them: each octave of nanoseconds has 64 equal bins, so that a bin is
/// 1 ns wide below 128 ns and at most 1/64 of its value above. Durations from 0 to 2^40 ns (18 minutes) have a bin;
/// shorter and longer ones are counted in the nearest. 18 kB.
/// @realtime  add: no allocation, no throw, no branch on the data; quantile and merge walk over the bins
class LatencyHistogram {
 public:
  void add(Duration duration) noexcept {
    const Duration::rep ns = std::clamp(duration.count(), Duration::rep{0}, longest);
    ++bins_[bin_of(static_cast<std::uint64_t>(ns))];
    ++count_;
    sum_ += ns;
    max_ = std::max(max_, duration);
  }

  /// Adds all that another one has counted.
  void merge(const LatencyHistogram& other) noexcept {
    std::transform(bins_.begin(), bins_.end(), other.bins_.begin(), bins_.begin(),
                   [](std::uint64_t a, std::uint64_t b) { return a + b; });
    count_ += other.count_;
    sum_ += other.sum_;
    max_ = std::max(max_, other.max_);
  }

  /// The shortest duration that at least the fraction p of all does not exceed, up to the width of its bin; 0 while
  /// nothing is counted.
  /// @param p  from 0 to 1; 0.999 for p99.9
  /// @throws std::invalid_argument  for any other p
  [[nodiscard]] Duration quantile(double p) const {
    expect(p >= 0 && p <= 1, "LatencyHistogram: quantile", "from 0 to 1", p);
    const double rank = std::max(1.0, std::ceil(p * static_cast<double>(count_)));
    std::uint64_t seen = 0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      seen += bins_[bin];
      if (static_cast<double>(seen) >= rank) return std::min(Duration{upper_end(bin)}, max_);
    }
    return max_;
  }

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] Duration max() const noexcept { return max_; }  ///< exact; 0 while nothing is counted
  /// Exact; 0 while nothing is counted.
  [[nodiscard]] std::chrono::duration<double, std::nano> mean() const noexcept {
    return std::chrono::duration<double, std::nano>(
        count_ == 0 ? 0.0 : static_cast<double>(sum_) / static_cast<double>(count_));
  }

 private:
  static constexpr int bits = 6;      // 64 bins an octave
  static constexpr int octaves = 40;  // up to 2^40 ns
  static constexpr std::size_t bins = static_cast<std::size_t>(octaves - bits + 1) << bits;
  static constexpr Duration::rep longest = (Duration::rep{1} << octaves) - 1;

  // Above 2^bits: the exponent counts octaves, the bits below the leading one count bins.
  static constexpr std::size_t bin_of(std::uint64_t ns) noexcept {
    const int shift = std::max(static_cast<int>(std::bit_width(ns)) - bits - 1, 0);
    return (static_cast<std::size_t>(shift) << bits) + static_cast<std::size_t>(ns >> shift);
  }
  static constexpr Duration::rep upper_end(std::size_t bin) noexcept {
    const std::size_t shift = std::max(bin >> bits, std::size_t{1}) - 1;
    const std::size_t leading = bin - (shift << bits);
    return static_cast<Duration::rep>(((leading + 1) << shift) - 1);
  }

  std::array<std::uint64_t, bins> bins_{};
  std::uint64_t count_ = 0;
  Duration::rep sum_ = 0;
  Duration max_{};
};

}  // namespace limpid
