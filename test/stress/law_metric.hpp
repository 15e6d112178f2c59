// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace limpid::stress {

/// The norm sqrt(e' Gamma^-1 e) of Gamma = U D U', in long double: V of Lemma 3 is its square.
template <int N>
class LawMetric {
 public:
  using Column = std::array<long double, N>;

  template <typename Factors>
  explicit LawMetric(const Factors& factors) {
    for (int i = 0; i < N; ++i) {
      D_[at(i)] = factors.D[i];
      for (int j = i + 1; j < N; ++j) U_[at(i)][at(j)] = factors.U(i, j);
    }
  }

  [[nodiscard]] long double norm(Column e) const {  // w = U^-1 e
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) e[at(i)] -= U_[at(i)][at(j)] * e[at(j)];
    }
    return of_w(e);
  }

  /// A bound on the norm of every e whose entries are no larger than these, and whatever the signs in U: what
  /// roundings of e and U can make of it.
  [[nodiscard]] long double bound(Column e) const {
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) e[at(i)] += std::abs(U_[at(i)][at(j)]) * e[at(j)];
    }
    return of_w(e);
  }

 private:
  static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] long double of_w(const Column& w) const {
    long double sum = 0;
    for (int i = 0; i < N; ++i) sum += w[at(i)] * w[at(i)] / D_[at(i)];
    return std::sqrt(sum);
  }

  Column D_{};
  std::array<Column, N> U_{};  // above its diagonal
};

}  // namespace limpid::stress
