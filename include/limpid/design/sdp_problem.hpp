// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/block_group.hpp>
#include <limpid/design/dynamic_group.hpp>
#include <limpid/design/lanczos_reach.hpp>
#include <limpid/design/schur_system.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace limpid {

/// How a semidefinite program's solution ended.
enum class SdpStatus {
  optimal,             ///< residuals and gap are below the tolerance
  primal_certificate,  ///< stopped: the x at hand proves what was asked
  dual_certificate,    ///< stopped: the Z at hand proves the contrary
  stalled,             ///< rounding left no step worth taking
  iteration_limit,
};

[[nodiscard]] constexpr std::string_view describe(SdpStatus status) noexcept {
  switch (status) {
    case SdpStatus::optimal:
      return "optimal";
    case SdpStatus::primal_certificate:
      return "primal certificate reached";
    case SdpStatus::dual_certificate:
      return "dual certificate reached";
    case SdpStatus::stalled:
      return "stalled: rounding leaves no step";
    default:
      return "iteration limit";
  }
}

template <Real Scalar = double>
struct SdpSettings {
  int iterations = 60;
  /// Of the gap relative to 1 + the objectives; 64 times as much of the residuals, relative to 1 + what they belong to.
  Scalar tolerance = Scalar{65536} * std::numeric_limits<Scalar>::epsilon();
};

namespace detail {

/// A semidefinite program of groups of blocks: max b'x with S = F_0 + F(x) >= 0 and C x = d.
///
/// Its dual: min <F_0, Z> + d'y with Z >= 0 and <F_i, Z> + b_i = (C'y)_i.
template <Real Scalar_, int variables, int rows, typename... Groups>
struct Sdp {
  using Scalar = Scalar_;
  using Vector = Eigen::Matrix<Scalar, variables, 1>;
  using RowVector = Eigen::Matrix<Scalar, rows, 1>;
  using System = SchurSystem<Scalar, variables, rows>;
  using Blocks = std::tuple<typename Groups::Blocks...>;
  static constexpr bool reach_by_lanczos = false;  ///< else by Laguerre's steps, which do several blocks at once

  std::tuple<Groups...> groups{};
  Vector b{};
  Eigen::Matrix<Scalar, rows, variables> C{};
  RowVector d{};

  /// f(group, its blocks in each argument ...)
  template <typename F, typename... B>
  void for_each_group(F&& f, B&... blocks) const {
    [&]<std::size_t... g>(std::index_sequence<g...>) { (visit<g>(f, blocks...), ...); }
    (std::index_sequence_for<Groups...>{});
  }
  [[nodiscard]] Blocks make() const {
    return std::apply([](const auto&... group) { return Blocks{group.make()...}; }, groups);
  }

 private:
  template <std::size_t g, typename F, typename... B>
  void visit(F& f, B&... blocks) const {
    f(std::get<g>(groups), std::get<g>(blocks)...);
  }
};

/// The same with as many blocks as wanted, each of its own size.
template <Real Scalar_>
struct DynamicSdp {
  using Scalar = Scalar_;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using RowVector = Vector;
  using System = SchurSystem<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Group = DynamicGroup<Scalar>;
  using Blocks = std::vector<typename Group::Blocks>;
  static constexpr bool reach_by_lanczos = true;  ///< where all blocks are small

  std::vector<Group> groups{};
  Vector b{};
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> C{};
  RowVector d{};

  template <typename F, typename... B>
  void for_each_group(F&& f, B&... blocks) const {
    for (std::size_t g = 0; g < groups.size(); ++g) f(groups[g], blocks[g]...);
  }
  [[nodiscard]] Blocks make() const {
    Blocks blocks;
    for (const Group& group : groups) blocks.push_back(group.make());
    return blocks;
  }
};

}  // namespace detail

}  // namespace limpid
