// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/gain_dual.hpp>
#include <limpid/design/gain_vertices.hpp>
#include <limpid/design/slow_mode.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>

namespace limpid::detail {

/// The 6 x 6 block of reduced_lmi.hpp at every point, in P, Q, R, X and, unless the gain is given, Y.
///
/// terms = 1: P and Y constant, Theorem 3 for all points at once. terms = 3: P and Y affine in rho at the vertices of a
/// box, with the four signs of the rates, Theorem 5; (4.51) is affine in rho and rho', so that these 16 blocks suffice.
template <Real Scalar, int points, int terms, bool gain_given>
class GainLmi {
 public:
  static constexpr int signs = terms == 1 ? 1 : 4;
  static constexpr bool dynamic = points == Eigen::Dynamic || !fills_lanes<Scalar>;
  static constexpr int width = dynamic || points == 1 ? 1 : 4;
  static constexpr int packs = dynamic ? Eigen::Dynamic : points * signs / width;
  static constexpr int positive = (terms == 1 ? 1 : points) + 2;  // P at the points, Q, R
  static constexpr int variables = 3 * terms + 6 + 4 + (gain_given ? 0 : 2 * terms);
  using Margin = MarginProblem<Scalar, variables, 6, packs, 2, (positive + width - 1) / width, width>;
  using Vector = typename Margin::Vector;
  using Variables = GainVariables<Scalar, terms>;
  using Multipliers = GainMultipliers<Scalar, points, signs>;
  using Rows = std::array<Row2<Scalar>, static_cast<std::size_t>(terms)>;

  explicit GainLmi(const GainCase<Scalar, points>& given) : case_{given}, ball_{given.scaled()}, s_{centres(ball_)} {}
  GainLmi(const GainCase<Scalar, points>& given, const AffineGain<Scalar>& gain) : GainLmi(given) {
    set_gain(gain);
    s_ = centres(ball_);
  }

  /// Whether the variables prove that gain, rounding accounted for.
  [[nodiscard, gnu::noinline]] bool proves_feasible(const Variables& candidate, const AffineGain<Scalar>& gain) {
    if (!gain_given) set_gain(gain);
    return proves_feasible(candidate);
  }
  [[nodiscard, gnu::noinline]] bool proves_feasible(const Variables& candidate) const {
    using B = Ball<Scalar>;
    if (!proves_positive(candidate.Q) || !proves_positive(candidate.R)) return false;
    for (const auto& P : candidate.P) {
      if (!is_symmetric(P)) return false;
    }
    const Matrix2<B> X = convert<B>(candidate.X), Q = convert<B>(candidate.Q), R = convert<B>(candidate.R);
    std::array<Matrix2<B>, static_cast<std::size_t>(terms)> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = convert<B>(candidate.P[i]);
    for (std::size_t k = 0; k < ball_.A.size(); ++k) {
      const LyapunovMatrices<B> m{combine<Matrix2<B>, terms>(parts, weights_at<terms>(k)), Q, R};
      if (!proves_positive(m.P)) return false;
      const Row2<B> Y = ball_.L[k] * transpose(X);
      Square<B, 6> F = block_with_gain(m, ball_.s, ball_.A[k], X, Y, {});
      const Matrix2<B> corner = get_block(F, 0, 0);
      for (int sign = 0; sign < signs; ++sign) {
        if constexpr (terms > 1) set_block(F, 0, 0, corner - rate_of(parts, ball_.rate_by_half, sign));
        if (!proves_positive(F)) return false;
      }
    }
    return true;
  }
  [[nodiscard]] bool proves_infeasible(const Multipliers& candidate) const {
    return gain_multipliers_prove<terms, gain_given>(ball_, candidate);
  }

  /// Until either is proved: the status says which. `gain` is rounded to Given first and proved as such.
  template <Real Given>
  SdpStatus solve(Variables& found, AffineGain<Given>& gain, Multipliers& multipliers, int& iterations) {
    const std::size_t vertices = ball_.A.size(), blocks = vertices * signs;
    Margin margin(blocks, positive);
    for (int i = 0; i < variables; ++i) add_variable(margin, i);
    return margin.solve(
        start(), 80,
        [&](const Vector& x, const Scalar& lambda, bool maybe_feasible, bool maybe_infeasible, const auto& Z) {
          if (maybe_feasible) {
            Rows Y;
            read(x, found, Y);
            if constexpr (gain_given) {
              if (proves_feasible(found)) return SdpStatus::primal_certificate;
            } else {
              gain = cast<Given>(case_.template gain_of<terms>(Y, found.X));
              if (proves_feasible(found, cast<Scalar>(gain))) return SdpStatus::primal_certificate;
            }
          }
          if (maybe_infeasible) {
            resize(multipliers.Z, vertices);
            for (std::size_t k = 0; k < blocks; ++k) {
              multipliers.Z[k / signs][k % signs] = Margin::multiplier(Z, k, blocks, lambda);
            }
            if constexpr (terms > 1) choose_free_part(Z, blocks, lambda, multipliers);
            if (proves_infeasible(multipliers)) return SdpStatus::dual_certificate;
            if constexpr (terms == 1) {
              by_mode_ = any_mode_proves(multipliers);
              if (by_mode_) return SdpStatus::dual_certificate;
            }
          }
          return SdpStatus::optimal;
        },
        iterations);
  }

  /// The proof of infeasibility is that of slow_mode.hpp, not the multipliers'.
  [[nodiscard]] bool by_mode() const { return by_mode_; }

 private:
  void set_gain(const AffineGain<Scalar>& gain) { case_.set_gain(gain, ball_); }

  template <Real To, Real From>
  [[nodiscard]] static AffineGain<To> cast(const AffineGain<From>& gain) {
    return {gain.L0.template cast<To>(), gain.L1.template cast<To>(), gain.L2.template cast<To>()};
  }

  // P'(rho) at one of the signs of the rates.
  template <typename S>
  [[nodiscard]] static Matrix2<S> rate_of(const std::array<Matrix2<S>, static_cast<std::size_t>(terms)>& P,
                                          const std::array<S, 2>& rate_by_half, int sign) {
    if constexpr (terms > 1) {
      const Matrix2<S> first = P[1] * rate_by_half[0], second = P[2] * rate_by_half[1];
      const Matrix2<S> sum = sign % 2 == 0 ? -first : first;
      return sign / 2 == 0 ? sum - second : sum + second;
    } else {
      return {};
    }
  }

  static void read(const Vector& x, Variables& v, Rows& Y) {
    int at = 0;
    const auto next = [&] {
      at += 3;
      return symmetric(x[at - 3], x[at - 2], x[at - 1]);
    };
    for (auto& P : v.P) P = next();
    v.Q = next();
    v.R = next();
    v.X = {x[at], x[at + 1], x[at + 2], x[at + 3]};
    at += 4;
    for (auto& row : Y) {
      row = {};
      if constexpr (!gain_given) {
        row = {x[at], x[at + 1]};
        at += 2;
      }
    }
  }

  // F_i: all blocks where variable i is 1 and the others are 0.
  void add_variable(Margin& margin, int i) const {
    Variables v;
    Rows rows;
    read(Vector::Unit(i), v, rows);
    PerTissue<Square<Scalar, 6>, points == Eigen::Dynamic ? Eigen::Dynamic : points * signs> big;
    std::array<Square<Scalar, 2>, static_cast<std::size_t>(terms == 1 ? 3 : positive)> small;
    resize(big, s_.A.size() * signs);
    for (std::size_t k = 0; k < s_.A.size(); ++k) {
      const auto weights = weights_at<terms>(k);
      const LyapunovMatrices<Scalar> m{combine<Matrix2<Scalar>, terms>(v.P, weights), v.Q, v.R};
      const Row2<Scalar> Y = gain_given ? s_.L[k] * transpose(v.X) : combine<Row2<Scalar>, terms>(rows, weights);
      if (terms > 1 || k == 0) small[k] = square(m.P);
      const Square<Scalar, 6> F = block_with_gain(m, s_.s, s_.A[k], v.X, Y, {});
      const Matrix2<Scalar> corner = get_block(F, 0, 0);
      for (std::size_t sign = 0; sign < signs; ++sign) {
        big[k * signs + sign] = F;
        if constexpr (terms > 1) {
          set_block(big[k * signs + sign], 0, 0, corner - rate_of(v.P, s_.rate_by_half, static_cast<int>(sign)));
        }
      }
    }
    small[small.size() - 2] = square(v.Q);
    small[small.size() - 1] = square(v.R);
    margin.add_variable(big, small);
  }

  [[nodiscard]] static Vector start() {
    Vector x = Vector::Zero();
    const auto set_identity = [&](int from) { x[from] = x[from + 2] = Scalar{1}; };
    set_identity(0);
    set_identity(3 * terms);
    set_identity(3 * terms + 3);
    x[3 * terms + 6] = x[3 * terms + 9] = Scalar{-1};  // X
    return x;
  }

  // D of gain_dual.hpp from the solver's multipliers of P > 0 at the vertices.
  template <typename Blocks>
  void choose_free_part(const Blocks& Z, std::size_t blocks, const Scalar& lambda, Multipliers& multipliers) const {
    multipliers.D = {};
    for (std::size_t k = 0; k < multipliers.Z.size(); ++k) {
      const auto weights = weights_at<terms>(k);
      Matrix2<Scalar> W = get_block(Margin::small_multiplier(Z, k, blocks, positive, lambda), 0, 0);
      for (const auto& z : multipliers.Z[k]) W = W - he(get_block(z, 4, 0));
      multipliers.D = multipliers.D + W * (Scalar(weights[1] * weights[2]) / Scalar{4});
    }
  }

  [[nodiscard]] bool any_mode_proves(const Multipliers& multipliers) const {
    for (std::size_t k = 0; k < multipliers.Z.size(); ++k) {
      if (mode_proves_infeasible(multipliers.Z[k][0], ball_.A[k], ball_.s)) return true;
    }
    return false;
  }

  bool by_mode_ = false;
  GainCase<Scalar, points> case_;
  GainVertices<Ball<Scalar>, points> ball_;
  GainVertices<Scalar, points> s_;
};

}  // namespace limpid::detail
