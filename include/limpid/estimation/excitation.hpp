// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/estimation/symmetric_eigenvalues.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace limpid {

/// Whether the regressor is persistently exciting, thesis (4.48) (a matrix: phi phi'), on each axis:
///
///     integral over the last T_1 seconds of phi phi' dt  >  beta I
///
/// Without it an estimate need not converge (Lemma 4). The window slides in `Bins` steps and never holds more than T_1,
/// so that an axis called excited is. phi is taken as held over each dt.
/// @tparam N     parameters of an axis
/// @tparam Bins  steps of the window
/// @realtime     update: no allocation, no throw; for each axis 2 N^2 flops and the eigenvalues of a matrix of order N
template <int N, int Axes = 1, Real Scalar = double, std::size_t Bins = 32>
class ExcitationMonitor {
  static_assert(Bins >= 2, "ExcitationMonitor: Bins is at least 2");

 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Regressor = Eigen::Array<Scalar, Axes, N>;
  using Gramian = Eigen::Matrix<Scalar, N, N>;

  struct Settings {
    Scalar window{1};  ///< T_1, s, > 0
    /// beta, in regressor^2 s, > 0. An eigenvalue of zero is computed as a rounding of the largest one: beta lies well
    /// above that.
    Scalar least = std::numeric_limits<Scalar>::quiet_NaN();
  };

  struct Output {
    Vector least;                         ///< smallest eigenvalue of the Gramian
    Eigen::Array<bool, Axes, 1> excited;  ///< whether it is above beta
    Status status;
  };

  /// @throws std::invalid_argument  where a setting is outside the range given at its field
  explicit ExcitationMonitor(const Settings& settings) : T_1_{settings.window}, beta_{settings.least} {
    expect(is_finite(T_1_) && T_1_ > Scalar{0}, "ExcitationMonitor: window", "finite and > 0", T_1_);
    expect(is_finite(beta_) && beta_ > Scalar{0}, "ExcitationMonitor: least", "finite and > 0", beta_);
    for (Bin& bin : bins_) bin.clear();
    closed_.clear();
  }

  /// Adds `dt` seconds of `phi`.
  /// @return status  not_finite or clock_backwards: nothing was added
  [[nodiscard]] Output update(const Scalar& dt, const Regressor& phi) noexcept {
    if (!is_finite(dt) || !is_finite(Regressor(phi * phi))) return say(Status::not_finite);
    if (!(dt > Scalar{0})) return say(Status::clock_backwards);
    const Scalar filled = newest().duration;
    if (filled * Scalar(Bins) >= T_1_ || (filled > Scalar{0} && filled + dt > T_1_)) open_bin();
    newest().add(phi, std::min(dt, T_1_));
    while (closed_.duration + newest().duration > T_1_ && count_ > 1) drop_oldest();
    return say(Status::ok);
  }

  /// The integral over the window, for an axis.
  [[nodiscard]] Gramian gramian(int axis) const noexcept {
    const auto i = static_cast<std::size_t>(axis);
    return closed_.gramian[i] + bins_[newest_].gramian[i];
  }

 private:
  struct Bin {
    std::array<Gramian, Axes> gramian;
    Scalar duration;

    void clear() noexcept {
      gramian.fill(Gramian::Zero());
      duration = Scalar{0};
    }
    void add(const Regressor& phi, const Scalar& dt) noexcept {
      for (int axis = 0; axis < Axes; ++axis) {
        const auto row = phi.row(axis).matrix();
        gramian[static_cast<std::size_t>(axis)] += dt * row.transpose() * row;
      }
      duration += dt;
    }
    void add(const Bin& other) noexcept {
      for (std::size_t axis = 0; axis < gramian.size(); ++axis) gramian[axis] += other.gramian[axis];
      duration += other.duration;
    }
  };

  Bin& newest() noexcept { return bins_[newest_]; }

  void open_bin() noexcept {
    if (count_ == Bins) --count_;  // the oldest gives its place
    newest_ = (newest_ + 1) % Bins;
    newest().clear();
    ++count_;
    sum_closed();
  }

  void drop_oldest() noexcept {
    --count_;
    sum_closed();
  }

  // Summed anew: taking the oldest off the sum would leave its rounding behind.
  void sum_closed() noexcept {
    closed_.clear();
    for (std::size_t i = 1; i < count_; ++i) closed_.add(bins_[(newest_ + Bins - i) % Bins]);
  }

  [[nodiscard]] Output say(Status status) const noexcept {
    Output output{Vector::Zero(), {}, status};
    for (int axis = 0; axis < Axes; ++axis)
      output.least[axis] = std::max(Scalar{0}, symmetric_eigenvalues<N, Scalar>(gramian(axis)).minCoeff());
    output.excited = output.least > beta_;
    return output;
  }

  Scalar T_1_, beta_;
  std::array<Bin, Bins> bins_;
  Bin closed_;  // sum of all bins but the newest
  std::size_t newest_ = 0, count_ = 1;
};

}  // namespace limpid
