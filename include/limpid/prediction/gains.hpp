// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/prediction/held_tangents.hpp>

#include <Eigen/Core>

#include <concepts>
#include <string>

namespace limpid {

/// Row L = [L1 L2] that weighs the prediction error of (4.25), on each axis.
template <int Axes = 1, Real Scalar = double>
struct GainRow {
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  Vector L1 = Vector::Zero();  ///< of the position error, N/m
  Vector L2 = Vector::Zero();  ///< of the velocity error, N s/m

  GainRow() = default;
  GainRow(const Scalar& position, const Scalar& velocity) noexcept
      : L1{Vector::Constant(position)}, L2{Vector::Constant(velocity)} {}
  GainRow(const Vector& position, const Vector& velocity) noexcept : L1{position}, L2{velocity} {}

  /// L e, N.
  [[nodiscard]] Vector operator()(const Vector& x_error, const Vector& v_error) const noexcept {
    return L1 * x_error + L2 * v_error;
  }
};

namespace detail {

/// @throws std::invalid_argument  where an entry is not finite
template <int Axes, Real Scalar>
void check_row(const std::string& name, const GainRow<Axes, Scalar>& row) {
  expect(is_finite(row.L1), name + ".L1", "finite", row.L1);
  expect(is_finite(row.L2), name + ".L2", "finite", row.L2);
}

}  // namespace detail

/// The same L everywhere, designed by Theorem 2 or 3.
/// @realtime  no allocation, no throw
template <int Axes = 1, Real Scalar = double>
struct ConstantGain {
  static constexpr bool scheduled = false;

  GainRow<Axes, Scalar> L;

  ConstantGain() = default;  ///< no feedback
  /// Scalars (every axis alike) or one entry for each axis: L1 in N/m, L2 in N s/m.
  template <typename T>
  ConstantGain(const T& L1, const T& L2) noexcept : L{L1, L2} {}

  /// @throws std::invalid_argument  where an entry is not finite
  void check() const {
    expect(is_finite(L.L1), "ConstantGain: L1", "finite", L.L1);
    expect(is_finite(L.L2), "ConstantGain: L2", "finite", L.L2);
  }

  [[nodiscard]] const GainRow<Axes, Scalar>& row() const noexcept { return L; }
};

/// L(rho) = L0 + L1 rho1 + L2 rho2 of thesis section 4.4.1, with rho = (dF_e/dx, dF_e/dv) of the environment as
/// estimated.
///
/// rho is held inside the box, and its rate below the one, that the design was verified for: beyond them nothing is
/// known of stability.
/// @realtime  no allocation, no throw; some 20 flops an axis
template <int Axes = 1, Real Scalar = double>
class ScheduledGain {
 public:
  using Row = GainRow<Axes, Scalar>;
  using Rho = Tangents<Axes, Scalar>;
  static constexpr bool scheduled = true;

  struct Settings {
    Row L0{};     ///< N/m, N s/m
    Row L1{};     ///< by stiffness: 1, s
    Row L2{};     ///< by damping: 1/s, 1
    Rho lower{};  ///< of the design's box: N/m >= lower.stiffness, N s/m >= lower.damping
    Rho upper{};  ///< of the design's box
    /// Fastest change of rho in the design: N/(m s), N/m; > 0; infinite where it has no limit.
    Rho rate = Held::no_limit();
  };

  ScheduledGain() : ScheduledGain(Settings{}) {}  ///< no feedback
  explicit ScheduledGain(const Settings& settings) noexcept : s_{settings} {}

  /// @throws std::invalid_argument  where a gain is not finite, the box is empty, L(rho) not finite all over it, or a
  ///                                rate not positive
  void check() const {
    detail::check_row("ScheduledGain: L0", s_.L0);
    detail::check_row("ScheduledGain: L1", s_.L1);
    detail::check_row("ScheduledGain: L2", s_.L2);
    check_box("stiffness", s_.lower.stiffness, s_.upper.stiffness);
    check_box("damping", s_.lower.damping, s_.upper.damping);
    check_sum("L1", &Row::L1);
    check_sum("L2", &Row::L2);
    Held::check_rate("ScheduledGain", s_.rate);
  }

  /// Schedules by `rho`, `dt` seconds after the last time (the first time without limit of rate).
  /// @return  at_bound where the box or the rate held rho back; not_finite (dt or rho) or clock_backwards (dt < 0):
  ///          nothing changed
  Status update(const Scalar& dt, const Rho& rho) noexcept {
    const Status status = rho_.update(dt, rho, s_.lower, s_.upper, s_.rate);
    if (has(status, Status::not_finite | Status::clock_backwards)) return status;
    row_.L1 = s_.L0.L1 + s_.L1.L1 * rho_.stiffness() + s_.L2.L1 * rho_.damping();
    row_.L2 = s_.L0.L2 + s_.L1.L2 * rho_.stiffness() + s_.L2.L2 * rho_.damping();
    return status;
  }

  [[nodiscard]] const Row& row() const noexcept { return row_; }

 private:
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Held = detail::HeldTangents<Axes, Scalar>;

  static void check_box(const std::string& side, const Vector& lower, const Vector& upper) {
    expect(is_finite(lower), "ScheduledGain: lower " + side, "finite", lower);
    expect(is_finite(upper) && (lower <= upper).all(), "ScheduledGain: upper " + side, "finite and >= lower", upper);
  }

  void check_sum(const std::string& entry, Vector Row::*of) const {
    const Vector k = s_.lower.stiffness.abs().max(s_.upper.stiffness.abs());
    const Vector b = s_.lower.damping.abs().max(s_.upper.damping.abs());
    const Vector most = (s_.L0.*of).abs() + (s_.L1.*of).abs() * k + (s_.L2.*of).abs() * b;
    expect(is_finite(most), "ScheduledGain: L0, L1, L2", "a finite " + entry + " all over the box", most);
  }

  Settings s_;
  Row row_{};
  Held rho_{};
};

/// What a ModelPredictor asks of its gain: a row to apply and, where scheduled, an update by the tangent.
template <typename G, int axes, typename Scalar>
concept PredictorGain = Real<Scalar> && std::copyable<G> && requires(const G& gain) {
  { G::scheduled } -> std::convertible_to<bool>;
  { gain.row() } -> std::convertible_to<GainRow<axes, Scalar>>;
  gain.check();
} &&(!G::scheduled || requires(G & gain, const Scalar& dt, const Tangents<axes, Scalar>& rho) {
  { gain.update(dt, rho) } -> std::same_as<Status>;
});

}  // namespace limpid
