// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>

namespace limpid {

/// From the counts of a three-axis force sensor to its force, section 5.3.3:
///
///     F_meas = M (c - c0),   F = F_meas/(1 + a_m r) in each axis
///
/// M holds sensitivities and cross-talk. The print divides by a_m r, which cannot hold at r = 0, where the ratio that
/// its Fig. 5.12 shows is 1.
/// @realtime  force: no allocation, no throw; 18 flops
template <Real Scalar_ = double>
class ForceCalibration {
 public:
  using Scalar = Scalar_;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  struct Settings {
    /// M, N by count: row i gives the force along axis i
    Matrix newtons_per_count = Matrix::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    Vector offset = Vector::Zero();               ///< c0, counts without a load
    Vector lever_gain = Vector::Constant(a_m());  ///< a_m of each axis, 1/m; measured along x alone
    Scalar lever_arm = Scalar(0);                 ///< r, from the sensor's flange to where the force acts, m
  };

  /// @throws std::invalid_argument  where a setting is not finite or none of a sensor
  explicit ForceCalibration(const Settings& settings)
      : matrix_{lever(settings).cwiseInverse().asDiagonal() * settings.newtons_per_count}, offset_{settings.offset} {
    const Scalar most(65536);  // counts; what is finite for them has finite sums
    expect(is_finite(settings.newtons_per_count) && is_finite(Matrix(matrix_ * (Scalar(6) * most))),
           "ForceCalibration: newtons_per_count", "finite, also times all counts", settings.newtons_per_count);
    expect(is_finite(offset_) && (offset_.array().abs() <= most).all(), "ForceCalibration: offset",
           "counts of at most 65536 in magnitude", offset_);
  }

  /// N, in the sensor's frame. A non-finite argument gives a non-finite answer.
  [[nodiscard]] Vector force(const Vector& counts) const noexcept { return matrix_ * (counts - offset_); }
  [[nodiscard]] Vector force(const std::array<std::int16_t, 3>& counts) const noexcept {
    return force(Vector(Scalar(counts[0]), Scalar(counts[1]), Scalar(counts[2])));
  }

  /// a_m of section 5.3.3, 1/m.
  [[nodiscard]] static Scalar a_m() noexcept { return Scalar(3965) / Scalar(100); }

  /// 1 + a_m r of each axis.
  /// @throws std::invalid_argument  where one is not positive
  [[nodiscard]] static Vector lever(const Settings& settings) {
    expect(is_finite(settings.lever_arm) && settings.lever_arm >= Scalar(0), "ForceCalibration: lever_arm",
           "finite and >= 0", settings.lever_arm);
    const Vector ratio = Vector::Ones() + settings.lever_gain * settings.lever_arm;
    expect(is_finite(settings.lever_gain) && is_finite(ratio) && (ratio.array() > Scalar(0)).all(),
           "ForceCalibration: lever_gain", "finite, with 1 + a_m r > 0", settings.lever_gain);
    return ratio;
  }

  /// The maker's sensitivities of sensor FS012, without cross-talk. Table 5.4.
  [[nodiscard]] static Settings table_5_4() {
    return of_sensitivities({Scalar(95553) / 100, Scalar(96222) / 100, Scalar(16244) / 100});
  }
  /// Those measured with weights, axis by axis. Table 5.5.
  [[nodiscard]] static Settings table_5_5() {
    return of_sensitivities({Scalar(10874) / 10, Scalar(-10891) / 10, Scalar(1205) / 10});
  }

 private:
  static Settings of_sensitivities(const Vector& counts_per_newton) {
    Settings settings;
    settings.newtons_per_count = counts_per_newton.cwiseInverse().asDiagonal();
    return settings;
  }

  Matrix matrix_;  // M with the lever's ratio
  Vector offset_;
};

/// Cross-talk of a sensor whose axes are read each by its own sensitivity: of a force along one axis, the largest share
/// that another axis shows. Infinite where an axis does not feel its own force.
/// @param response  3 x 3, what axis i (row) shows of a force along j: counts/N, or N/N of a sensor that is calibrated
template <typename Derived>
[[nodiscard]] typename Derived::Scalar cross_talk(const Eigen::MatrixBase<Derived>& response) {
  using Scalar = typename Derived::Scalar;
  using std::abs;
  Scalar largest(0);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      if (i == j || response(i, j) == Scalar(0)) continue;
      if (response(i, i) == Scalar(0)) return std::numeric_limits<Scalar>::infinity();
      const Scalar share = abs(response(i, j) / response(i, i));
      if (!(share <= largest)) largest = share;
    }
  }
  return largest;
}

}  // namespace limpid
