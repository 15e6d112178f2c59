// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/interior_point.hpp>
#include <limpid/design/lmi_problem.hpp>
#include <limpid/design/reduced_lmi.hpp>
#include <limpid/design/theorem5.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

/// The theorems' inequalities as data for any solver: max t with F(x) - t I >= 0 and tr F(x) <= n, n the order of F.
/// Where F(x) > 0 has no solution the largest t is 0.
namespace limpid::bench {

using Data = SdpData<double>;

/// Adds t and the trace to blocks that depend linearly on the variables.
inline Data with_margin(Data data) {
  const auto variables = static_cast<Eigen::Index>(data.coefficients.size());
  const int trace_block = static_cast<int>(data.block_sizes.size());
  int n = 0;
  for (const int size : data.block_sizes) n += size;
  for (auto& entries : data.coefficients) {
    double trace = 0;
    for (const auto& e : entries) trace += e.row == e.col ? e.value : 0;
    entries.push_back({trace_block, 0, 0, -trace});
  }
  data.coefficients.emplace_back();
  for (int block = 0; block < trace_block; ++block) {
    for (int i = 0; i < data.block_sizes[static_cast<std::size_t>(block)]; ++i) {
      data.coefficients.back().push_back({block, i, i, -1.0});
    }
  }
  data.block_sizes.push_back(1);
  data.constant.push_back({trace_block, 0, 0, static_cast<double>(n)});
  data.objective = Eigen::VectorXd::Unit(variables + 1, variables);
  return data;
}

/// Of an Lmi without constants: the theorems as printed.
inline Data data_of(const LmiProblem<double>& problem) {
  Data data;
  data.coefficients.resize(static_cast<std::size_t>(problem.unknowns));
  for (const auto& block : problem.blocks) {
    const int number = static_cast<int>(data.block_sizes.size());
    data.block_sizes.push_back(block.size);
    for (const auto& term : block.terms) {
      data.coefficients[static_cast<std::size_t>(term.unknown)].push_back(
          {number, static_cast<int>(term.row), static_cast<int>(term.column), term.factor.centre()});
    }
  }
  return with_margin(data);
}

template <int n>
void add_block(Data::Entries& entries, int& number, const detail::Square<double, n>& F) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (F(i, j) != 0) entries.push_back({number, i, j, F(i, j)});
    }
  }
  ++number;
}

/// The two blocks of reduced_lmi.hpp for L fixed.
inline Data reduced_theorem3(const PredictorDesign<double>& design, const Tissue<double>& tissue,
                             const Gain<double>& L) {
  const double d = detail::time_scale(design, tissue);
  const auto s = detail::scale_design<double>(design, d);
  const auto A = detail::scale_dynamics<double>(design, tissue, d);
  const auto row = detail::scale_gain<double>(design, L, d);
  Data data;
  data.block_sizes = {4, 4, 2, 2, 2};
  for (int i = 0; i < 9; ++i) {
    std::array<double, 9> x{};
    x[static_cast<std::size_t>(i)] = 1;
    const detail::LyapunovMatrices<double> m{detail::symmetric(x[0], x[1], x[2]), detail::symmetric(x[3], x[4], x[5]),
                                             detail::symmetric(x[6], x[7], x[8])};
    Data::Entries entries;
    int block = 0;
    add_block(entries, block, detail::block_of_multiplier(m, s));
    add_block(entries, block, detail::block_of_dynamics(m, s, A, row));
    for (const auto* matrix : {&m.P, &m.Q, &m.R}) add_block(entries, block, detail::square(*matrix));
    data.coefficients.push_back(entries);
  }
  return with_margin(data);
}

/// The 6 x 6 blocks for L free: at one tissue (terms = 1), or Theorem 5's at the vertices of a box (terms = 3).
template <int points, int terms>
Data reduced_gain(const detail::GainCase<double, points>& given) {
  constexpr int variables = 5 * terms + 10;
  const auto v = detail::centres(given.scaled());
  Data data;
  for (int i = 0; i < variables; ++i) {
    std::array<double, static_cast<std::size_t>(variables)> x{};
    x[static_cast<std::size_t>(i)] = 1;
    std::size_t at = 0;
    const auto next = [&] { return at += 3, detail::symmetric(x[at - 3], x[at - 2], x[at - 1]); };
    std::array<detail::Matrix2<double>, static_cast<std::size_t>(terms)> P;
    std::array<detail::Row2<double>, static_cast<std::size_t>(terms)> Y;
    for (auto& part : P) part = next();
    const auto Q = next(), R = next();
    const detail::Matrix2<double> X{x[at], x[at + 1], x[at + 2], x[at + 3]};
    at += 4;
    for (auto& part : Y) part = {x[at], x[at + 1]}, at += 2;

    Data::Entries entries;
    int block = 0;
    for (std::size_t k = 0; k < v.A.size(); ++k) {
      const auto weights = detail::weights_at<terms>(k);
      const detail::LyapunovMatrices<double> m{detail::combine<detail::Matrix2<double>, terms>(P, weights), Q, R};
      const auto row = detail::combine<detail::Row2<double>, terms>(Y, weights);
      for (int sign = 0; sign < (terms == 1 ? 1 : 4); ++sign) {
        detail::Matrix2<double> rate{};
        if constexpr (terms > 1) {
          rate = P[1] * (sign % 2 == 0 ? -v.rate_by_half[0] : v.rate_by_half[0]) +
                 P[2] * (sign / 2 == 0 ? -v.rate_by_half[1] : v.rate_by_half[1]);
        }
        add_block(entries, block, detail::block_with_gain(m, v.s, v.A[k], X, row, rate));
      }
      add_block(entries, block, detail::square(m.P));
    }
    add_block(entries, block, detail::square(Q));
    add_block(entries, block, detail::square(R));
    data.coefficients.push_back(entries);
  }
  for (int k = 0; k < points; ++k) {
    for (int sign = 0; sign < (terms == 1 ? 1 : 4); ++sign) data.block_sizes.push_back(6);
    data.block_sizes.push_back(2);
  }
  data.block_sizes.insert(data.block_sizes.end(), {2, 2});
  return with_margin(data);
}

inline Data reduced_theorem3(const PredictorDesign<double>& design, const Tissue<double>& tissue) {
  detail::GainCase<double, 1> given;
  given.design = design;
  given.tissues[0] = tissue;
  given.box = {tissue, tissue};
  given.d = detail::time_scale(design, tissue);
  return reduced_gain<1, 1>(given);
}

inline Data reduced_theorem5(const PredictorDesign<double>& design, const TissueBox<double>& box,
                             const TissueRates<double>& rates) {
  return reduced_gain<4, 3>(detail::scheduled_case(design, box, rates));
}

}  // namespace limpid::bench
