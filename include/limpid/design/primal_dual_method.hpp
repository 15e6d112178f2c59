// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/sdp_problem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid::detail {

/// Where the method stands: x, slack S, multipliers Z and y.
template <typename Problem>
struct SdpPoint {
  typename Problem::Vector x;
  typename Problem::Blocks S, Z;
  typename Problem::RowVector y;
};

/// Primal-dual interior point method in the direction of Helmberg, Rendl, Vanderbei, Wolkowicz, Kojima, Shindoh, Hara
/// and Monteiro (HKM), with Mehrotra's predictor and corrector.
///
/// The step is that of S + dS = F_0 + F(x + dx) and of
///
///     Z + dZ = sigma mu S^-1 - sym(Z dS S^-1) - sym(dZ_a dS_a S^-1),    sym(A) = (A + A')/2
///
/// (a: of the predictor), with which <F_i, Z + dZ> + b_i = (C' y)_i becomes M dx + C' y = r, M_ij = <F_i, Z F_j S^-1>.
/// The start has to be inside the cones, S > 0, Z > 0; it need not satisfy the equations.
template <typename Problem>
class PrimalDualMethod {
 public:
  using Scalar = typename Problem::Scalar;
  using Vector = typename Problem::Vector;
  using RowVector = typename Problem::RowVector;
  using Blocks = typename Problem::Blocks;
  using Point = SdpPoint<Problem>;

  /// Works on `point`, which has to hold a start with S > 0 and Z > 0.
  PrimalDualMethod(const Problem& problem, Point& point)
      : p_{problem},
        at_{point},
        S_inverse_{p_.make()},
        Z_inverse_{p_.make()},
        dS_{p_.make()},
        dZ_{p_.make()},
        GS_{p_.make()},
        GZ_{p_.make()},
        missing_{p_.make()},
        target_{p_.make()},
        scratch_{p_.make()} {
    p_.for_each_group([&](const auto& group) {
      dimension_ += group.dimension();
      by_lanczos_ = by_lanczos_ && group.size() <= small_block;
    });
  }

  /// @param stop  called at each point: SdpStatus::optimal to go on, or the certificate that was reached
  template <typename Stop>
  SdpStatus run(const SdpSettings<Scalar>& settings, Stop&& stop) {
    if (!invert_all(at_.S, S_inverse_) || !invert_all(at_.Z, Z_inverse_)) return SdpStatus::stalled;
    Scalar least_mu = std::numeric_limits<Scalar>::infinity();
    int idle = 0;  // steps that brought mu no lower
    for (iterations_ = 0;; ++iterations_) {
      measure();
      if (const SdpStatus reached = stop(at_); reached != SdpStatus::optimal) return reached;
      if (gap_ <= settings.tolerance && residual_ <= Scalar{64} * settings.tolerance) return SdpStatus::optimal;
      if (iterations_ == settings.iterations) return SdpStatus::iteration_limit;
      if (mu_ > least_mu * Scalar{9} / Scalar{10} && ++idle == 4) return SdpStatus::stalled;
      least_mu = std::min(least_mu, mu_);
      if (!step()) return SdpStatus::stalled;
    }
  }

  [[nodiscard]] int iterations() const { return iterations_; }
  [[nodiscard]] const Scalar& gap() const { return gap_; }            ///< relative
  [[nodiscard]] const Scalar& residual() const { return residual_; }  ///< relative, the largest
  [[nodiscard]] const Scalar& primal_objective() const { return primal_objective_; }
  [[nodiscard]] const Scalar& dual_objective() const { return dual_objective_; }

 private:
  template <typename F, typename... B>
  void each(F&& f, B&... blocks) const {  // f(block of each argument ...)
    p_.for_each_group(
        [&f](const auto&, auto& first, auto&... others) {
          for (std::size_t k = 0; k < first.size(); ++k) f(first[k], others[k]...);
        },
        blocks...);
  }
  [[nodiscard]] Scalar inner(const Blocks& A, const Blocks& B) const {
    Scalar sum{0};
    each([&](const auto& a, const auto& b) { sum += inner_product_of(a, b); }, A, B);
    return sum;
  }
  [[nodiscard]] bool invert_all(const Blocks& A, Blocks& inverse) const {
    bool positive = true;
    each([&](const auto& a, auto& i) { positive = positive && invert(a, i); }, A, inverse);
    return positive;
  }
  void apply(const Vector& x, Blocks& S, bool with_constant) const {
    p_.for_each_group([&](const auto& group, auto& s) { group.apply(x, s, with_constant); }, S);
  }
  [[nodiscard]] Vector adjoint(const Blocks& W) const {
    Vector sum = Vector::Zero(p_.b.size());
    p_.for_each_group([&](const auto& group, const auto& w) { group.add_adjoint(w, sum); }, W);
    return sum;
  }

  // Residuals and gap at the point; missing_ = F_0 + F(x) - S.
  void measure() {
    using std::abs;
    using std::sqrt;
    mu_ = inner(at_.S, at_.Z) / Scalar(dimension_);
    residual_ = Scalar{0};
    if (!slack_exact_) {
      apply(at_.x, missing_, true);
      const Scalar size = Scalar{1} + inner(missing_, missing_);
      each([](auto& m, const auto& s) { add_scaled(m, Scalar{-1}, s); }, missing_, at_.S);
      residual_ = sqrt(inner(missing_, missing_) / size);
      slack_exact_ = residual_ == Scalar{0};
    }
    Vector rest = adjoint(at_.Z) + p_.b;
    primal_objective_ = p_.b.dot(at_.x);
    dual_objective_ = Scalar{0};
    p_.for_each_group([&](const auto& group, const auto& z) { dual_objective_ += group.constant_part(z); }, at_.Z);
    if (p_.d.size() != 0) {
      rest -= p_.C.transpose() * at_.y;
      dual_objective_ += p_.d.dot(at_.y);
      residual_ = std::max<Scalar>(residual_, (p_.C * at_.x - p_.d).norm() / (Scalar{1} + p_.d.norm()));
    }
    residual_ = std::max<Scalar>(residual_, rest.norm() / (Scalar{1} + p_.b.norm()));
    gap_ = mu_ * Scalar(dimension_) / (Scalar{1} + abs(primal_objective_) + abs(dual_objective_));
  }

  // One predictor and corrector. False where nothing moves any more.
  bool step() {
    if (!factorise()) return false;
    Vector constant_right = p_.b;  // what does not depend on sigma
    if (!slack_exact_) {           // sym(Z (F_0 + F(x) - S) S^-1)
      multiply_all(S_inverse_, missing_, GS_);
      each([](const auto& z, const auto& g, auto& s) { multiply_symmetrised(z, g, s); }, at_.Z, GS_, scratch_);
      constant_right -= adjoint(scratch_);
    }
    Vector dx;
    RowVector y_new;
    solve(constant_right, dx, y_new);
    each([](auto& t) { set_scaled_identity(t, Scalar{0}); }, target_);
    set_direction(dx);
    const int steps = by_lanczos_ ? 6 : 0;
    const Scalar sigma = centring(least_reach(at_.S, GS_, steps), least_reach(at_.Z, GZ_, steps));

    // GS_ = S^-1 dS_a: sym(dZ_a dS_a S^-1) = sym(dZ_a GS_')
    const Scalar sigma_mu = sigma * mu_;
    each(
        [&](const auto& dz, const auto& g, const auto& s, auto& t) {
          multiply_symmetrised(dz, g, t);
          scale_and_add(t, Scalar{-1}, sigma_mu, s);
        },
        dZ_, GS_, S_inverse_, target_);
    solve(Vector(constant_right + adjoint(target_)), dx, y_new);
    set_direction(dx);
    return move(dx, y_new);
  }

  // dS = F(dx) + missing, dZ = target - Z - sym(Z dS S^-1), and both seen from the point, S^-1 dS and Z^-1 dZ.
  void set_direction(const Vector& dx) {
    apply(dx, dS_, false);
    if (!slack_exact_) each([](auto& ds, const auto& m) { add_scaled(ds, Scalar{1}, m); }, dS_, missing_);
    multiply_all(S_inverse_, dS_, GS_);
    each(
        [](const auto& z, const auto& g, const auto& t, auto& dz) {
          multiply_symmetrised(z, g, dz);
          scale_and_add(dz, Scalar{-1}, Scalar{1}, t);
          add_scaled(dz, Scalar{-1}, z);
        },
        at_.Z, GS_, target_, dZ_);
    multiply_all(Z_inverse_, dZ_, GZ_);
  }
  void multiply_all(const Blocks& A, const Blocks& B, Blocks& C) const {
    each([](const auto& a, const auto& b, auto& c) { multiply(a, b, c); }, A, B, C);
  }

  // Mehrotra's sigma, from how far the predictor reaches.
  [[nodiscard]] Scalar centring(const Scalar& primal_reach, const Scalar& dual_reach) const {
    const Scalar primal = std::min<Scalar>(primal_reach, 1), dual = std::min<Scalar>(dual_reach, 1);
    const Scalar predicted = mu_ * Scalar(dimension_) + primal * inner(dS_, at_.Z) + dual * inner(at_.S, dZ_) +
                             primal * dual * inner(dS_, dZ_);
    const Scalar ratio = predicted / (mu_ * Scalar(dimension_));
    // From a lower bound of the reach the ratio comes out too large: the cube makes up for that.
    const Scalar power = by_lanczos_ ? Scalar(ratio * ratio) : Scalar(ratio * ratio * ratio);
    return std::clamp<Scalar>(power, Scalar{1} / Scalar{1'000'000}, Scalar{9} / Scalar{10});
  }
  // From G = A^-1 dA: a lower bound, or by some steps of Lanczos to a few per cent.
  [[nodiscard]] Scalar least_reach(const Blocks& A, const Blocks& G, int lanczos_steps) const {
    Scalar least{1'000'000};
    each([&](const auto& a, const auto& g) { least = std::min<Scalar>(least, reach_of(a, g, lanczos_steps)); }, A, G);
    return least;
  }

  // How far A + alpha dA stays positive definite, to a few per cent; `G` = A^-1 dA is overwritten.
  [[nodiscard]] Scalar reach(const Blocks& A, const Blocks& dA, Blocks& G) {
    Scalar alpha = least_reach(A, G, by_lanczos_ ? 12 : 0);
    const int refinements = by_lanczos_ ? 0 : 2;
    for (int refinement = 0; refinement < refinements && alpha < Scalar{1}; ++refinement) {
      const Scalar inside = alpha * Scalar{9} / Scalar{10};
      bool positive = true;
      each(
          [&](const auto& a, const auto& da, auto& g, auto& scratch) {
            g = a;
            add_scaled(g, inside, da);
            positive = positive && invert(g, scratch);
            if (positive) multiply(scratch, da, g);
          },
          A, dA, G, scratch_);
      if (!positive) break;
      alpha = inside + least_reach(A, G, 0);
    }
    return alpha;
  }

  // False where the step is too short to be one.
  bool move(const Vector& dx, const RowVector& y_new) {
    const Scalar primal_reach = reach(at_.S, dS_, GS_), dual_reach = reach(at_.Z, dZ_, GZ_);
    const Scalar fraction =
        std::min<Scalar>({primal_reach, dual_reach, 1}) * Scalar{8} / Scalar{100} + Scalar{9} / Scalar{10};
    Scalar primal = std::min<Scalar>(fraction * primal_reach, 1), dual = std::min<Scalar>(fraction * dual_reach, 1);
    if (!(std::max(primal, dual) > Scalar{1} / Scalar{10'000'000})) return false;

    const Vector x = at_.x;
    for (int attempt = 0;; ++attempt, primal *= Scalar{7} / Scalar{10}) {  // rounding may have spoilt the reach
      if (attempt == 12) return false;
      at_.x = x + primal * dx;
      scratch_ = at_.S;
      if (slack_exact_) {
        apply(at_.x, scratch_, true);
      } else {
        each([&](auto& s, const auto& ds) { add_scaled(s, primal, ds); }, scratch_, dS_);
      }
      if (invert_all(scratch_, S_inverse_)) break;
    }
    at_.S = scratch_;
    for (int attempt = 0;; ++attempt, dual *= Scalar{7} / Scalar{10}) {
      if (attempt == 12) return false;
      scratch_ = at_.Z;
      each([&](auto& z, const auto& dz) { add_scaled(z, dual, dz); }, scratch_, dZ_);
      if (invert_all(scratch_, Z_inverse_)) break;
    }
    at_.Z = scratch_;
    at_.y += dual * (y_new - at_.y);
    if (primal == Scalar{1} && !slack_exact_) {  // from here on S is F_0 + F(x) itself
      apply(at_.x, scratch_, true);
      if (invert_all(scratch_, GS_)) {
        at_.S = scratch_;
        S_inverse_ = GS_;
        slack_exact_ = true;
      }
    }
    return true;
  }

  // M_ij = <F_i, Z F_j S^-1>
  [[nodiscard]] bool factorise() {
    system_.clear(p_.b.size());
    p_.for_each_group([&](const auto& group, const auto& z, const auto& s) { group.add_schur(z, s, system_); }, at_.Z,
                      S_inverse_);
    return system_.factorise(p_.C);
  }
  void solve(const Vector& right, Vector& dx, RowVector& y) const {
    const int rounds = gap_ > Scalar{1} / Scalar{100} ? 1 : gap_ > Scalar{1} / Scalar{100'000} ? 2 : 3;
    system_.solve(right, p_.C, RowVector(p_.d - p_.C * at_.x), dx, y, rounds);
  }

  const Problem& p_;
  Point& at_;
  Blocks S_inverse_, Z_inverse_, dS_, dZ_, GS_, GZ_;
  Blocks missing_;  // F_0 + F(x) - S, where it is not zero
  Blocks target_;   // sigma mu S^-1 - sym(dZ_a dS_a S^-1), what Z + dZ + sym(Z dS S^-1) is to be
  Blocks scratch_;
  typename Problem::System system_;
  int dimension_ = 0, iterations_ = 0;
  bool by_lanczos_ = Problem::reach_by_lanczos;  // and all blocks are small: else some steps say too little
  bool slack_exact_ = false;                     // S = F_0 + F(x)
  Scalar mu_{0}, gap_{0}, residual_{0}, primal_objective_{0}, dual_objective_{0};
};

}  // namespace limpid::detail
