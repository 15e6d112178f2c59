// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_problem.hpp>
#include <limpid/design/verified_cholesky.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace limpid {
namespace detail {

/// A sum of products, with what its rounding and the radii of its factors may come to.
template <Real Scalar>
struct BoundedSum {
  Scalar value{0}, size{0}, radius{0};
  int terms = 0;

  void add(const Ball<Scalar>& factor, const Scalar& weight, const Scalar& weight_radius = Scalar{0}) {
    using std::abs;
    const Scalar product = factor.centre() * weight;
    value += product;
    size += abs(product);
    radius += factor.radius() * (abs(weight) + weight_radius) + abs(factor.centre()) * weight_radius;
    ++terms;
  }
  void add(const Ball<Scalar>& a, const Ball<Scalar>& b, const Scalar& weight) {
    using std::abs;
    add(a, weight * b.centre());
    radius += abs(weight) * (abs(a.centre()) + a.radius()) * b.radius();
    size += abs(weight * a.centre() * b.centre());  // for the second product's rounding
  }
  /// At least |value - exact|: each term is rounded in its product and in all later sums.
  [[nodiscard]] Scalar error() const {
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon(), n = Scalar(terms + 8);
    return (size * n * epsilon + radius + std::numeric_limits<Scalar>::min() * Scalar{16} * n) *
           (Scalar{1} + Scalar{8} * n * epsilon);
  }
};

/// At least the exact value of a sum of n products of numbers >= 0 that came out as `value`.
template <Real Scalar>
[[nodiscard]] Scalar rounded_up(const Scalar& value, int n) {
  return value * (Scalar{1} + Scalar(4 * n + 16) * std::numeric_limits<Scalar>::epsilon()) +
         std::numeric_limits<Scalar>::min() * Scalar(16 + n);
}

/// The power of two nearest below 1/size; 1 where size is not a number > 0.
template <Real Scalar>
[[nodiscard]] Scalar inverse_power_of_two(const Scalar& size) {
  using std::frexp, std::ldexp;
  if (!(size > Scalar{0}) || !is_finite(size)) return Scalar{1};
  int exponent = 0;
  (void)frexp(size, &exponent);
  return ldexp(Scalar{1}, -exponent);
}

template <Real Scalar>
struct EvaluatedBlock {
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> F;
  Scalar error;  // in the Frobenius norm
};

/// D (F_j(x) - t I) D, for x within `radii`; D of powers of two, so that the diagonal is about 1: what is positive
/// definite stays so, and rounding no longer depends on units.
template <Real Scalar>
[[nodiscard]] EvaluatedBlock<Scalar> evaluate(const typename LmiProblem<Scalar>::Block& block,
                                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x,
                                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& radii, const Scalar& t) {
  using std::sqrt;
  const int n = block.size;
  EvaluatedBlock<Scalar> evaluated{Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>::Zero(n, n), Scalar{0}};
  std::vector<BoundedSum<Scalar>> entries(static_cast<std::size_t>(n * n));
  for (const auto& term : block.terms) {
    auto& entry = entries[static_cast<std::size_t>(term.row * n + term.column)];
    if (term.unknown == LmiExpression<Scalar>::constant) {
      entry.add(term.factor, Scalar{1});
    } else {
      entry.add(term.factor, x[term.unknown], radii[term.unknown]);
    }
  }
  std::vector<Scalar> D;
  for (int i = 0; i < n; ++i) {
    auto& entry = entries[static_cast<std::size_t>(i * n + i)];
    entry.add(Ball<Scalar>(t), Scalar{-1});
    D.push_back(inverse_power_of_two<Scalar>(sqrt(entry.value)));
  }
  Scalar squares{0};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      const auto& entry = entries[static_cast<std::size_t>(i * n + j)];
      if (entry.terms == 0) continue;
      const Scalar scale = D[static_cast<std::size_t>(i)] * D[static_cast<std::size_t>(j)];
      evaluated.F(i, j) = evaluated.F(j, i) = entry.value * scale;
      const Scalar error = rounded_up<Scalar>(entry.error() * scale, 1);
      squares += error * error * (i == j ? Scalar{1} : Scalar{2});
    }
  }
  evaluated.error = rounded_up<Scalar>(sqrt(rounded_up(squares, n * n)), 1);
  return evaluated;
}

/// How far, entry by entry, the nearest point with c'x = d is from x: it is x - c (c'x - d) / c'c.
/// @return  not finite where there is none
template <Real Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, Eigen::Dynamic, 1> distance_to_plane(
    const LmiProblem<Scalar>& problem, const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x) {
  using std::abs;
  BoundedSum<Scalar> residual;
  Scalar squares{0};
  for (const auto& term : problem.equation) {
    const bool constant = term.unknown == LmiExpression<Scalar>::constant;
    residual.add(term.factor, constant ? Scalar{1} : x[term.unknown]);
    if (!constant) squares += term.factor.least_magnitude() * term.factor.least_magnitude();
  }
  const int n = static_cast<int>(problem.equation.size());
  const Scalar step = rounded_up(rounded_up(abs(residual.value) + residual.error(), n) / squares, n);
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> distance = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>::Zero(x.size());
  for (const auto& term : problem.equation) {
    if (term.unknown != LmiExpression<Scalar>::constant) {
      distance[term.unknown] = rounded_up<Scalar>(step * term.factor.magnitude(), 2);
    }
  }
  return distance;
}

}  // namespace detail

/// Whether a solution with F_j(x) > t I for all j is proved to exist: x, or what is nearest to it on the equation's
/// plane. Uses nothing of a solver, and bounds every rounding: of the data as formed (the radii of their balls) and its
/// own.
///
/// Off line: allocates.
template <Real Scalar>
[[nodiscard]] bool certifies_feasible(const LmiProblem<Scalar>& problem,
                                      const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x, const Scalar& t) {
  if (x.size() != problem.unknowns || !is_finite(x) || !is_finite(t)) return false;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> radii = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>::Zero(x.size());
  if (problem.has_equation) radii = detail::distance_to_plane(problem, x);
  if (!is_finite(radii)) return false;
  for (const auto& block : problem.blocks) {
    const auto [F, error] = detail::evaluate<Scalar>(block, x, radii, t);
    if (!verified_positive_definite(F, error)) return false;
  }
  return true;
}

}  // namespace limpid
