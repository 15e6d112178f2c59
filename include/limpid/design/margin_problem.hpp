// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/primal_dual_method.hpp>
#include <limpid/design/small_matrix.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace limpid::detail {

template <Real Scalar>
struct NextScalar {
  using type = void;
};
template <>
struct NextScalar<float> {
  using type = double;
};
template <>
struct NextScalar<double> {
  using type = long double;
};

/// The scalar to solve again with where rounding left a question open; void where there is none.
template <Real Scalar>
using Wider = typename NextScalar<Scalar>::type;

/// Whether there is an x with F(x) = sum x_i F_i > 0, asked as
///
///     max t  with  F(x) >= t I,  tr F(x) = n;      its dual  min n lambda  with  <F_i, Z> = lambda tr F_i,  tr Z = 1
///
/// n being the order of F. t > 0 answers yes; lambda < 0 no, as Z + |lambda| I > 0 then annihilates every F_i. Both
/// have a strictly feasible start: any x with that trace and t low enough; Z = I/n, lambda = 1/n.
///
/// Of scalars that fill registers such problems are of fixed size, solved side by side and without allocation. Others
/// are asked seldom, where rounding left a question open, and share one solver of dynamic size.
///
/// The blocks are of `order` and of `small_order`; `width` of them fill the lanes of a pack, the first ones again where
/// the last pack has room. `packs` is Eigen::Dynamic where their number is known at run time only: then it allocates.
template <Real Scalar, int variables_, int order, int packs, int small_order, int small_packs, int width>
class MarginProblem {
 public:
  static constexpr bool dynamic = packs == Eigen::Dynamic;
  static constexpr int variables = variables_;
  static constexpr int unknowns = variables + 1;  // x and t
  using Vector = Eigen::Matrix<Scalar, variables, 1>;
  using BigMatrix = Square<Scalar, order>;
  using SmallMatrix = Square<Scalar, small_order>;
  template <int n, int count>
  using FixedGroup = BlockGroup<Scalar, n, width, count, unknowns>;
  using Problem = std::conditional_t<dynamic, DynamicSdp<Scalar>,
                                     Sdp<Scalar, unknowns, 1, FixedGroup<order, dynamic ? 1 : packs>,
                                         FixedGroup<small_order, dynamic ? 1 : small_packs>>>;

  /// @param big, small  number of blocks of each order, where it is dynamic
  explicit MarginProblem(std::size_t big = 0, std::size_t small = 0) : big_count_{big} {
    sdp_.b = Problem::Vector::Unit(unknowns, variables);
    sdp_.C.setZero(1, unknowns);
    if constexpr (dynamic) {
      for (std::size_t i = 0; i < big; ++i) sdp_.groups.emplace_back(order);
      for (std::size_t i = 0; i < small; ++i) sdp_.groups.emplace_back(small_order);
    }
    int n = 0;
    sdp_.for_each_group([&](const auto& group) { n += group.dimension(); });
    sdp_.d = Problem::RowVector::Constant(1, Scalar(n));
  }

  /// F_i of the next variable: what the blocks are where that one is 1 and all others 0; the lower triangles are read.
  void add_variable(std::span<const BigMatrix> big, std::span<const SmallMatrix> small) {
    Scalar trace{0};
    if constexpr (dynamic) {
      for (std::size_t i = 0; i < big.size(); ++i) add_to(sdp_.groups[i], big.subspan(i, 1), trace);
      for (std::size_t i = 0; i < small.size(); ++i) {
        add_to(sdp_.groups[big_count_ + i], small.subspan(i, 1), trace);
      }
    } else {
      add_to(std::get<0>(sdp_.groups), big, trace);
      add_to(std::get<1>(sdp_.groups), small, trace);
    }
    sdp_.C(0, added_++) = trace;
  }

  /// @param start  any x; only its direction counts
  /// @param stop   called with (x, lambda, whether yes and whether no is worth an attempt at a proof, Z) at each point;
  ///               SdpStatus::optimal to go on
  template <typename Stop>
  SdpStatus solve(const Vector& start, int most_iterations, Stop&& stop, int& iterations) {
    for_all([&](auto& group) { add_slack_variable(group); });
    SdpPoint<Problem> point{starting_x(start), sdp_.make(), sdp_.make(), Problem::RowVector::Ones(1) / sdp_.d[0]};
    sdp_.for_each_group(
        [&](const auto& group, auto& s, auto& z) {
          group.apply(point.x, s, true);
          for (auto& block : z) set_scaled_identity(block, Scalar{1} / sdp_.d[0]);
        },
        point.S, point.Z);
    SdpSettings<Scalar> settings;
    settings.iterations = most_iterations;
    PrimalDualMethod<Problem> method(sdp_, point);
    const SdpStatus status = method.run(settings, [&](const auto& at) -> SdpStatus {
      const Scalar &t = at.x[variables], &lambda = at.y[0], bound = lambda * sdp_.d[0];
      const Scalar open = bound - t, near = open / Scalar{2};
      const bool border = open < Scalar{1} / Scalar{1000};  // where neither may ever come near
      return stop(Vector(at.x.template head<variables>()), lambda, border || t > -near, border || bound < near, at.Z);
    });
    iterations += method.iterations();
    return status;
  }

  /// Z - lambda I of block number `i` out of `count`, summed over its repetitions: with those of all other blocks it
  /// annihilates every F_j.
  [[nodiscard]] static BigMatrix multiplier(const typename Problem::Blocks& Z, std::size_t i, std::size_t count,
                                            const Scalar& lambda) {
    if constexpr (dynamic) {
      return less_lambda<order>(Z[i][0], lambda);
    } else {
      return sum_of_repetitions<order>(std::get<0>(Z), i, count, lambda);
    }
  }
  /// The same of a small block, of `big_count` and `count`.
  [[nodiscard]] static SmallMatrix small_multiplier(const typename Problem::Blocks& Z, std::size_t i,
                                                    [[maybe_unused]] std::size_t big_count, std::size_t count,
                                                    const Scalar& lambda) {
    if constexpr (dynamic) {
      return less_lambda<small_order>(Z[big_count + i][0], lambda);
    } else {
      return sum_of_repetitions<small_order>(std::get<1>(Z), i, count, lambda);
    }
  }

 private:
  template <int n, typename Matrix>
  [[nodiscard]] static Square<Scalar, n> less_lambda(const Matrix& Z, const Scalar& lambda) {
    Square<Scalar, n> result;
    for (int r = 0; r < n; ++r) {
      for (int c = 0; c < n; ++c) result(r, c) = r == c ? Z(r, c) - lambda : Z(r, c);
    }
    return result;
  }
  template <int n, typename Blocks>
  [[nodiscard]] static Square<Scalar, n> sum_of_repetitions(const Blocks& blocks, std::size_t i, std::size_t count,
                                                            const Scalar& lambda) {
    Square<Scalar, n> sum{};
    for (; i < blocks.size() * width; i += count) {
      for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) sum(r, c) += lane(blocks[i / width](r, c), static_cast<int>(i % width));
        sum(r, r) -= lambda;
      }
    }
    return sum;
  }

  template <typename F>
  void for_all(F&& f) {
    if constexpr (dynamic) {
      for (auto& group : sdp_.groups) f(group);
    } else {
      f(std::get<0>(sdp_.groups));
      f(std::get<1>(sdp_.groups));
    }
  }

  template <typename Group, typename Matrix>
  void add_to(Group& group, std::span<const Matrix> blocks, Scalar& trace) {
    constexpr std::size_t count = std::tuple_size_v<typename Group::Blocks>;
    constexpr std::size_t lanes = Group::width;
    const int n = group.size();
    std::array<bool, std::tuple_size_v<decltype(Matrix::entries)>> used{};
    for (const Matrix& block : blocks) {
      for (std::size_t e = 0; e < used.size(); ++e) used[e] = used[e] || block.entries[e] != Scalar{0};
    }
    group.begin_variable(added_);
    for (int r = 0; r < n; ++r) {
      for (int c = 0; c <= r; ++c) {
        if (!used[static_cast<std::size_t>(r * n + c)]) continue;
        std::array<typename Group::E, count> values;
        std::size_t from = 0;  // begins again where a pack has room
        for (std::size_t k = 0; k < count; ++k) {
          for (std::size_t l = 0; l < lanes; ++l) {
            const Scalar& value = blocks[from](r, c);
            set_lane(values[k], static_cast<int>(l), value);
            if (r == c) trace += value;
            if (++from == blocks.size()) from = 0;
          }
        }
        group.add_entry(r, c, values);
      }
    }
    group.end_variable();
  }

  template <typename Group>
  void add_slack_variable(Group& group) {
    std::array<typename Group::E, std::tuple_size_v<typename Group::Blocks>> minus_one;
    for (auto& entry : minus_one) set_all_lanes(entry, Scalar{-1});
    group.begin_variable(variables);
    for (int r = 0; r < group.size(); ++r) group.add_entry(r, r, minus_one);
    group.end_variable();
  }

  // Along `start`, or where no positive multiple of it has the trace, along the traces; t below every eigenvalue.
  [[nodiscard]] typename Problem::Vector starting_x(const Vector& start) const {
    typename Problem::Vector x = Problem::Vector::Zero(unknowns);
    x.template head<variables>() = start;
    const Scalar n = sdp_.d[0], trace = sdp_.C.row(0).dot(x);
    if (trace > sdp_.C.norm() * start.norm() / Scalar{100}) {
      x *= n / trace;
    } else {
      x = sdp_.C.row(0).transpose() * (n / sdp_.C.squaredNorm());
    }
    // The eigenvalues of a block have this mean and deviation; none is further away than sqrt(order - 1) times that.
    typename Problem::Blocks F = sdp_.make();
    Scalar least{1};
    sdp_.for_each_group(
        [&](const auto& group, auto& f) {
          group.apply(x, f, true);
          for (const auto& block : f) least = std::min<Scalar>(least, eigenvalue_bound_by_moments(block));
        },
        F);
    x[variables] = least - (Scalar{1} - least) / Scalar{8};
    return x;
  }

  Problem sdp_{};
  std::size_t big_count_;
  int added_ = 0;
};

}  // namespace limpid::detail
