// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>
#include <limpid/design/bracketed_root.hpp>
#include <limpid/design/complex_matrix.hpp>
#include <limpid/design/state_space.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace limpid::detail {

template <Real Scalar>
struct GainPeak {
  Scalar value{0};
  Scalar frequency{0};  ///< rad/s; infinite for the limit
};

/// The largest singular value of a continuous system along the frequencies.
template <Real Scalar>
class GainCurve {
 public:
  using Matrix = ComplexMatrix<Scalar>;
  using Complex = std::complex<Scalar>;

  explicit GainCurve(const StateSpace<Scalar>& G) : G_{G} {}

  /// sigma and its slope
  [[nodiscard]] LargestSingular<Scalar> operator()(const Scalar& omega) const {
    const Matrix D = G_.D.template cast<Complex>();
    if (G_.order() == 0 || !is_finite(omega)) return largest_singular<Scalar>(D, Matrix::Zero(D.rows(), D.cols()));
    Matrix pencil = -G_.A.template cast<Complex>();
    pencil.diagonal().array() += Complex(Scalar{0}, omega);
    const Matrix X = solved<Scalar>(pencil, G_.B.template cast<Complex>()), Y = solved<Scalar>(pencil, X);
    // G = D + C X, G' = -i C Y
    return largest_singular<Scalar>(D + product<Scalar>(G_.C, X),
                                    product<Scalar>(G_.C, Y) * Complex(Scalar{0}, Scalar{-1}));
  }

  /// The highest of the values at zero, about the poles and at infinity, polished.
  [[nodiscard]] GainPeak<Scalar> sweep() const {
    const std::vector<Scalar> grid = frequencies();
    GainPeak<Scalar> best{(*this)(Scalar{0}).value, Scalar{0}};
    std::size_t at = 0;
    for (std::size_t i = 1; i < grid.size(); ++i) {
      const Scalar value = (*this)(grid[i]).value;
      if (!(value > best.value)) continue;
      best = {value, grid[i]};
      at = i;
    }
    const Scalar limit = (*this)(infinity_of<Scalar>()).value;
    if (limit >= best.value && limit > Scalar{0}) best = {limit, infinity_of<Scalar>()};
    if (!is_finite(best.frequency)) return best;
    const GainPeak<Scalar> polished = between(grid[at > 0 ? at - 1 : 0], grid[std::min(at + 1, grid.size() - 1)]);
    return polished.value >= best.value ? polished : best;
  }

  /// The highest of a few values from `first` to `last`, polished where the slope changes its sign about it.
  [[nodiscard]] GainPeak<Scalar> between(const Scalar& first, const Scalar& last) const {
    constexpr int parts = 8;
    const auto at = [&](int i) {
      return i == parts ? last : Scalar(first + (last - first) * Scalar(i) / Scalar(parts));
    };
    GainPeak<Scalar> best{(*this)(first).value, first};
    int index = 0;
    for (int i = 1; i <= parts; ++i) {
      const Scalar value = (*this)(at(i)).value;
      if (!(value > best.value)) continue;
      best = {value, at(i)};
      index = i;
    }
    const Scalar a = at(std::max(index - 1, 0)), b = at(std::min(index + 1, parts));
    const Scalar rising = (*this)(a).slope, falling = (*this)(b).slope;
    if (!(rising > Scalar{0}) || !(falling < Scalar{0})) return best;
    const Scalar omega = bracketed_root([&](const Scalar& frequency) -> Scalar { return (*this)(frequency).slope; }, a,
                                        rising, b, falling);
    const Scalar value = (*this)(omega).value;
    return value >= best.value * (Scalar{1} - rounding()) ? GainPeak<Scalar>{std::max<Scalar>(value, best.value), omega}
                                                          : best;
  }

 private:
  static Scalar rounding() { return Scalar(64) * std::numeric_limits<Scalar>::epsilon(); }

  // Zero, 24 a decade from a hundredth of the slowest pole to a hundred times the fastest one, and at the poles.
  [[nodiscard]] std::vector<Scalar> frequencies() const {
    using std::abs, std::exp, std::log, std::sqrt;
    constexpr int most = 2'000;
    std::vector<Scalar> grid{Scalar{0}};
    Scalar slowest = infinity_of<Scalar>(), fastest{0};
    for (const auto& p : eigenvalues_of<Scalar>(G_.A)) {
      const Scalar unit = largest_part(p);
      if (!(unit > Scalar{0}) || !is_finite(unit)) continue;
      const Scalar size = unit * sqrt(squared_size(Complex(p.real() / unit, p.imag() / unit)));
      slowest = std::min<Scalar>(slowest, size);
      fastest = std::max<Scalar>(fastest, size);
      grid.push_back(size);
      grid.push_back(abs(p.imag()));
    }
    if (!(fastest > Scalar{0})) return grid;
    const Scalar from = log(slowest) - log(Scalar(100)), to = log(fastest) + log(Scalar(100));
    const int count = static_cast<int>(std::min<Scalar>(Scalar(most), (to - from) * Scalar(10.5)));
    for (int i = 0; i <= count; ++i) grid.push_back(exp(from + (to - from) * Scalar(i) / Scalar(count)));
    std::sort(grid.begin(), grid.end());
    return grid;
  }

  StateSpace<Scalar> G_;
};

}  // namespace limpid::detail
