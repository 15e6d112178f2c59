// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace limpid::detail {

/// Integrals of N functions at once over an interval, by Gauss and Legendre's rule of 16 points and halving.
template <Real Scalar, std::size_t N>
class GaussQuadrature {
 public:
  using Values = std::array<Scalar, N>;

  struct Result {
    Values value{};
    Scalar error{0};  ///< of the first: the difference that the last halving of each part made, and rounding
  };

  GaussQuadrature() { set_rule(); }

  /// f(x) -> Values. A part is halved until the first function's integral changes by no more than `tolerance`.
  template <typename Function>
  [[nodiscard]] Result integrate(const Function& f, const Scalar& a, const Scalar& b, const Scalar& tolerance) const {
    Result result;
    add(f, a, b, rule(f, a, b), tolerance, most_halvings, result);
    return result;
  }

 private:
  static constexpr int points = 16;
  static constexpr int most_halvings = 24;

  template <typename Function>
  void add(const Function& f, const Scalar& a, const Scalar& b, const Values& whole, const Scalar& tolerance, int left,
           Result& result) const {
    using std::abs;
    const Scalar middle = (a + b) / Scalar{2};
    const Values first = rule(f, a, middle), second = rule(f, middle, b);
    const Scalar sum = first[0] + second[0], change = abs(sum - whole[0]);
    const Scalar rounding = Scalar(8) * std::numeric_limits<Scalar>::epsilon() * (abs(first[0]) + abs(second[0]));
    if (change > tolerance && change > rounding && left > 0) {
      add(f, a, middle, first, tolerance, left - 1, result);
      add(f, middle, b, second, tolerance, left - 1, result);
      return;
    }
    for (std::size_t k = 0; k < N; ++k) result.value[k] += first[k] + second[k];
    result.error += change + rounding;
  }

  template <typename Function>
  [[nodiscard]] Values rule(const Function& f, const Scalar& a, const Scalar& b) const {
    const Scalar centre = (a + b) / Scalar{2}, radius = (b - a) / Scalar{2};
    Values sum{};
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Values right = f(centre + radius * nodes_[i]), left = f(centre - radius * nodes_[i]);
      for (std::size_t k = 0; k < N; ++k) sum[k] += weights_[i] * radius * (right[k] + left[k]);
    }
    return sum;
  }

  // Roots of the Legendre polynomial above zero, by Newton's method from Tricomi's approximation.
  void set_rule() {
    using std::abs, std::acos, std::cos;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      Scalar x = cos(acos(Scalar{-1}) * (Scalar(4 * static_cast<int>(i) + 3) / Scalar(4 * points + 2)));
      Scalar slope{1};
      for (int step = 0; step < 12; ++step) {
        Scalar p{1}, before{0};
        for (int n = 1; n <= points; ++n) {
          const Scalar next = (Scalar(2 * n - 1) * x * p - Scalar(n - 1) * before) / Scalar(n);
          before = p;
          p = next;
        }
        slope = Scalar(points) * (x * p - before) / (x * x - Scalar{1});
        const Scalar change = p / slope;
        x -= change;
        if (abs(change) <= std::numeric_limits<Scalar>::epsilon()) break;
      }
      nodes_[i] = x;
      weights_[i] = Scalar{2} / ((Scalar{1} - x * x) * slope * slope);
    }
  }

  std::array<Scalar, points / 2> nodes_{}, weights_{};
};

}  // namespace limpid::detail
