// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <limits>

namespace limpid {

enum class JointKind : std::uint8_t {
  revolute,   ///< q turns about z, rad
  prismatic,  ///< q slides along z, m
};

/// One row of a table of Denavit-Hartenberg parameters in the modified convention (Craig's; Khalil and Kleinfinger's):
/// frame i, at joint i with z along its axis, is reached from frame i - 1 by
///
///     turn alpha about x, move a along x, turn theta about z, move d along z
///
/// so that the link moved by joint i rests in frame i. A table in the standard convention has the same numbers a row
/// lower: its alpha_i and a_i are those of row i + 1 here, and its last a_N goes to the tip's offset.
template <Real Scalar = double>
struct DenavitHartenberg {
  Scalar alpha = Scalar(0);               ///< alpha_(i-1), rad
  Scalar a = Scalar(0);                   ///< a_(i-1), m
  Scalar d = Scalar(0);                   ///< d_i, m; a prismatic joint's q is added
  Scalar theta = Scalar(0);               ///< theta_i where q = 0, rad; a revolute joint's q is added
  JointKind joint = JointKind::revolute;  ///< what q_i moves
};

/// A frame seen from another: x there = p + R x here.
template <Real Scalar = double>
struct RigidTransform {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  Matrix R;
  Vector p;  ///< m

  [[nodiscard]] Vector operator*(const Vector& x) const noexcept { return p + R * x; }
};

/// A row of the table with what does not depend on q worked out.
template <Real Scalar = double>
class DenavitHartenbergRow {
 public:
  DenavitHartenbergRow() = default;

  explicit DenavitHartenbergRow(const DenavitHartenberg<Scalar>& row) noexcept
      : a_{row.a}, d_{row.d}, theta_{row.theta}, turns_{row.joint == JointKind::revolute ? Scalar(1) : Scalar(0)} {
    using std::cos, std::sin;
    c_alpha_ = exact_quarter(cos(row.alpha));
    s_alpha_ = exact_quarter(sin(row.alpha));
  }

  /// Frame i in frame i - 1.
  /// @realtime  no allocation, no throw; one sine and cosine
  [[nodiscard]] RigidTransform<Scalar> at(const Scalar& q) const noexcept {
    using std::cos, std::sin;
    const Scalar theta = theta_ + turns_ * q, d = d_ + (1 - turns_) * q;
    const Scalar c = cos(theta), s = sin(theta);
    RigidTransform<Scalar> frame;
    frame.R << c, -s, Scalar(0),                //
        s * c_alpha_, c * c_alpha_, -s_alpha_,  //
        s * s_alpha_, c * s_alpha_, c_alpha_;   //
    frame.p << a_, -d * s_alpha_, d * c_alpha_;
    return frame;
  }

  [[nodiscard]] const Scalar& turns() const noexcept { return turns_; }  ///< 1 for a revolute joint, else 0

 private:
  // Of a whole number of quarter turns, whose rounding would else couple what is decoupled.
  [[nodiscard]] static Scalar exact_quarter(const Scalar& value) noexcept {
    using std::abs;
    const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon();
    if (abs(value) < rounding) return Scalar(0);
    return 1 - abs(value) < rounding * rounding ? (value > Scalar(0) ? Scalar(1) : Scalar(-1)) : value;
  }

  Scalar a_{0}, d_{0}, theta_{0}, turns_{1};
  Scalar c_alpha_{1}, s_alpha_{0};
};

}  // namespace limpid
