// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

namespace limpid {

/// The solution of the equation of `LeastSquaresFlow` as a series: E(z, q) = (exp(l) - 1) / z, where l is the root of
///
///     q (exp(l) - exp(p l)) / (1 - p) + (1 - q) (exp(p l) - 1) / p = z
///
/// E = sum e_n(q) z^n with a polynomial e_n of degree n. With B = exp(p l), G = (exp(l) - B) / (1 - p) the equation
/// differentiates to l' = 1 / (q G + B), B' = p B l', G' = (G + B) l', from which the coefficients follow one by one.
/// Unlike Newton's iteration it has no division on the way from z to E.
/// @tparam Array  the lanes; a scalar of more digits than double's takes more terms than are worth their time
template <typename Array>
class InformationSeries {
 public:
  using Scalar = typename Array::Scalar;
  static constexpr bool exists = std::floating_point<Scalar> && std::numeric_limits<Scalar>::digits <= 53;

  /// @param p  alpha nu, in [0, 1)
  explicit InformationSeries(const Scalar& p) noexcept {
    if constexpr (exists) {
      Powers powers(p);
      for (std::size_t n = 0; n < terms; ++n) {
        for (std::size_t m = 0; m <= n; ++m)
          coefficients_[at(n, m)] = Array::Constant(Scalar(powers.coefficient(n, m)));
      }
      most_ = powers.longest();
    }
  }

  /// The largest z for which the first term left out is below half a rounding, whatever q.
  [[nodiscard]] const Scalar& most() const noexcept { return most_; }

  /// @param z  0 <= z <= most()
  /// @param q  0 < q <= 1
  /// @realtime  no allocation, no throw, no branch; 36 sums in double, eight products long
  [[nodiscard]] EIGEN_ALWAYS_INLINE Array operator()(const Array& z, const Array& q) const noexcept {
    const Array y = z * q;  // E = sum y^m (sum over k of e_(m + k, m) z^k): each inner sum is there when it is needed
    Array sum = coefficients_[at(terms - 1, terms - 1)];
    outer<terms - 1>(z, y, sum);
    return sum;
  }

 private:
  static constexpr std::size_t terms = std::numeric_limits<Scalar>::digits > 24 ? 8 : 4;
  static constexpr std::size_t at(std::size_t n, std::size_t m) { return n * (n + 1) / 2 + m; }

  template <std::size_t m>
  EIGEN_ALWAYS_INLINE void outer(const Array& z, const Array& y, Array& sum) const noexcept {
    if constexpr (m > 0) {
      Array inner = coefficients_[at(terms - 1, m - 1)];
      inward<terms - 1, m - 1>(z, inner);
      sum = inner + y * sum;
      outer<m - 1>(z, y, sum);
    }
  }
  template <std::size_t n, std::size_t m>
  EIGEN_ALWAYS_INLINE void inward(const Array& z, Array& inner) const noexcept {
    if constexpr (n > m) {
      inner = coefficients_[at(n - 1, m)] + z * inner;
      inward<n - 1, m>(z, inner);
    }
  }

  // The coefficients, by powers of z and q, of exp(l), B, G and l'; in long double, so that they are as exact as E.
  class Powers {
    using Row = std::array<long double, terms + 2>;
    using Series = std::array<Row, terms + 2>;

   public:
    explicit Powers(const Scalar& p) noexcept {
      exponential_[0][0] = B_[0][0] = 1;
      for (std::size_t n = 0; n <= terms; ++n) advance(n, static_cast<long double>(p));
    }

    [[nodiscard]] long double coefficient(std::size_t n, std::size_t m) const { return exponential_[n + 1][m]; }

    [[nodiscard]] Scalar longest() const noexcept {
      constexpr int grid = 64;
      long double largest = 0;
      for (int i = 0; i <= grid; ++i) {
        long double e = 0;
        for (std::size_t m = terms + 1; m-- > 0;) e = e * i / grid + coefficient(terms, m);
        largest = std::max(largest, std::abs(e));
      }
      const long double rounding = std::numeric_limits<Scalar>::epsilon() / 4;
      return Scalar(std::pow(rounding / (2 * largest), 1 / static_cast<long double>(terms)));  // 2: between the points
    }

   private:
    void advance(std::size_t n, long double p) noexcept {
      for (std::size_t m = 0; m <= n; ++m) denominator_[n][m] = B_[n][m] + (m > 0 ? G_[n][m - 1] : 0);
      for (std::size_t m = 0; m <= n; ++m) {  // l' = 1 / denominator
        long double rest = n == 0 && m == 0 ? 1 : 0;
        for (std::size_t k = 1; k <= n; ++k) rest -= product(denominator_[k], slope_[n - k], m);
        slope_[n][m] = rest;
      }
      const auto integral = [&](const Series& f, std::size_t m) {
        long double sum = 0;
        for (std::size_t k = 0; k <= n; ++k) sum += product(f[k], slope_[n - k], m);
        return sum / static_cast<long double>(n + 1);
      };
      for (std::size_t m = 0; m <= n + 1; ++m) {
        B_[n + 1][m] = p * integral(B_, m);
        G_[n + 1][m] = integral(G_, m) + integral(B_, m);
        exponential_[n + 1][m] = integral(exponential_, m);
      }
    }

    static long double product(const Row& a, const Row& b, std::size_t m) noexcept {
      long double sum = 0;
      for (std::size_t i = 0; i <= m; ++i) sum += a[i] * b[m - i];
      return sum;
    }

    Series exponential_{}, B_{}, G_{}, denominator_{}, slope_{};
  };

  std::array<Array, exists ? terms*(terms + 1) / 2 : 0> coefficients_{};
  Scalar most_{0};
};

}  // namespace limpid
