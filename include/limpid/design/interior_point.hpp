// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/design/primal_dual_method.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <utility>
#include <vector>

namespace limpid {

/// An entry of a symmetric block-diagonal matrix and, off the diagonal, its mirror image; row >= col. Entries at the
/// same place add up.
template <Real Scalar = double>
struct SymmetricEntry {
  int block = 0, row = 0, col = 0;
  Scalar value{0};
};

/// max b'x with F_0 + sum_i x_i F_i >= 0 and C x = d.
///
/// Its dual: min <F_0, Z> + d'y with Z >= 0 and <F_i, Z> + b_i = (C'y)_i.
template <Real Scalar = double>
struct SdpData {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Entries = std::vector<SymmetricEntry<Scalar>>;

  std::vector<int> block_sizes{};
  std::vector<Entries> coefficients{};  ///< F_i, one list for each variable
  Entries constant{};                   ///< F_0
  Vector objective{};                   ///< b
  Matrix equations{};                   ///< C, may be empty
  Vector right_hand_side{};             ///< d

  /// @throws std::invalid_argument  where sizes do not agree, a place is outside its block or a number is not finite
  void check() const {
    const auto variables = static_cast<Eigen::Index>(coefficients.size());
    expect(variables > 0, "SdpData: coefficients", "at least one variable", variables);
    expect(objective.size() == variables, "SdpData: objective", "one entry for each variable", objective.size());
    expect(is_finite(objective), "SdpData: objective", "finite", objective);
    expect(equations.rows() == right_hand_side.size(), "SdpData: equations", "as many rows as right hand sides",
           equations.rows());
    expect(equations.rows() == 0 || equations.cols() == variables, "SdpData: equations", "a column for each variable",
           equations.cols());
    expect(is_finite(equations) && is_finite(right_hand_side), "SdpData: equations", "finite", equations);
    for (const int size : block_sizes) expect(size > 0, "SdpData: block_sizes", "> 0", size);
    expect(!block_sizes.empty(), "SdpData: block_sizes", "at least one block", block_sizes.size());
    check(constant);
    for (const Entries& entries : coefficients) check(entries);
  }

 private:
  void check(const Entries& entries) const {
    for (const auto& [block, row, col, value] : entries) {
      expect(block >= 0 && block < static_cast<int>(block_sizes.size()), "SymmetricEntry: block", "a block", block);
      const int size = block_sizes[static_cast<std::size_t>(block)];
      expect(row < size && col >= 0 && row >= col, "SymmetricEntry: row, col", "0 <= col <= row < size", row);
      expect(is_finite(value), "SymmetricEntry: value", "finite", value);
    }
  }
};

/// What the method came to, certified or not: whoever needs proof checks x or Z.
template <Real Scalar = double>
struct SdpResult {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  SdpStatus status = SdpStatus::stalled;
  Vector x{};               ///< the variables
  std::vector<Matrix> S{};  ///< slack, close to F_0 + F(x), positive definite; by block
  std::vector<Matrix> Z{};  ///< multipliers, positive definite; by block
  Vector y{};               ///< of the equations
  Scalar value{0};          ///< b'x
  Scalar dual_value{0};     ///< <F_0, Z> + d'y
  Scalar gap{0};            ///< relative
  Scalar residual{0};       ///< relative, the largest of the three equations
  int iterations = 0;
};

namespace detail {

template <Real Scalar>
[[nodiscard]] DynamicSdp<Scalar> make_problem(const SdpData<Scalar>& data) {
  using Matrix = typename SdpData<Scalar>::Matrix;
  DynamicSdp<Scalar> problem;
  problem.b = data.objective;
  problem.C = data.equations;
  if (problem.C.rows() == 0) problem.C.resize(0, data.objective.size());
  problem.d = data.right_hand_side;
  for (const int size : data.block_sizes) problem.groups.emplace_back(size);
  for (const auto& e : data.constant) {
    problem.groups[static_cast<std::size_t>(e.block)].add_constant(e.row, e.col, e.value);
  }
  std::vector<Matrix> sums;  // entries at one place added, so that each is listed once
  for (const int size : data.block_sizes) sums.push_back(Matrix::Zero(size, size));
  for (std::size_t i = 0; i < data.coefficients.size(); ++i) {
    for (const auto& e : data.coefficients[i]) sums[static_cast<std::size_t>(e.block)](e.row, e.col) += e.value;
    for (auto& group : problem.groups) group.begin_variable(static_cast<int>(i));
    for (const auto& e : data.coefficients[i]) {
      Scalar& sum = sums[static_cast<std::size_t>(e.block)](e.row, e.col);
      if (sum != Scalar{0}) problem.groups[static_cast<std::size_t>(e.block)].add_entry(e.row, e.col, {sum});
      sum = Scalar{0};
    }
    for (auto& group : problem.groups) group.end_variable();
  }
  return problem;
}

}  // namespace detail

/// Solves a semidefinite program by `detail::PrimalDualMethod`, from multiples of the identity.
///
/// Off line: allocates. Hard data never throws: the status says how it ended.
/// @param stop  called with (x, S by block, Z by block, y) at each point; returns SdpStatus::optimal to go on, or the
///              certificate that was found. S is F_0 + F(x) only once the method has reached feasibility.
/// @throws std::invalid_argument  where `data.check()` does
template <Real Scalar, typename Stop>
[[nodiscard]] SdpResult<Scalar> solve_sdp(const SdpData<Scalar>& data, const SdpSettings<Scalar>& settings,
                                          Stop&& stop) {
  using Problem = detail::DynamicSdp<Scalar>;
  data.check();
  const Problem problem = detail::make_problem(data);

  detail::SdpPoint<Problem> point{Problem::Vector::Zero(data.objective.size()), problem.make(), problem.make(),
                                  Problem::Vector::Zero(data.right_hand_side.size())};
  if (data.right_hand_side.size() != 0) {
    // The smallest x that satisfies the equations: x = C' (C C')^-1 d
    typename SdpData<Scalar>::Matrix products = data.equations * data.equations.transpose();
    products.diagonal().array() += products.diagonal().maxCoeff() * std::numeric_limits<Scalar>::epsilon();
    point.x = data.equations.transpose() * products.llt().solve(data.right_hand_side);
  }
  Scalar largest{1};  // of S: such that F_0 + F(x) - S is not far beyond it
  problem.for_each_group(
      [&](const auto& group, auto& s) {
        group.apply(point.x, s, true);
        largest = std::max<Scalar>(largest, s[0].entries().cwiseAbs().rowwise().sum().maxCoeff());
      },
      point.S);
  const Scalar weight = std::max<Scalar>(Scalar{1}, data.objective.cwiseAbs().maxCoeff());
  problem.for_each_group(
      [&](const auto&, auto& s, auto& z) {
        detail::set_scaled_identity(s[0], Scalar{2} * largest);
        detail::set_scaled_identity(z[0], weight);
      },
      point.S, point.Z);

  detail::PrimalDualMethod<Problem> method(problem, point);
  SdpResult<Scalar> result;
  const auto unwrap = [](const auto& blocks) {
    std::vector<typename SdpResult<Scalar>::Matrix> matrices;
    for (const auto& block : blocks) matrices.push_back(block[0].matrix());
    return matrices;
  };
  result.status =
      method.run(settings, [&](const auto& at) -> SdpStatus { return stop(at.x, unwrap(at.S), unwrap(at.Z), at.y); });
  result.x = std::move(point.x);
  result.y = std::move(point.y);
  result.S = unwrap(point.S);
  result.Z = unwrap(point.Z);
  result.value = method.primal_objective();
  result.dual_value = method.dual_objective();
  result.gap = method.gap();
  result.residual = method.residual();
  result.iterations = method.iterations();
  return result;
}

template <Real Scalar>
[[nodiscard]] SdpResult<Scalar> solve_sdp(const SdpData<Scalar>& data, const SdpSettings<Scalar>& settings = {}) {
  return solve_sdp(data, settings, [](const auto&...) { return SdpStatus::optimal; });
}

}  // namespace limpid
