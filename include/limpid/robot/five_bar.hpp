// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/robot/five_bar_pose.hpp>
#include <limpid/robot/robot.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid {

/// A parallel device of two driven joints: Eom, Suh and Yi, section 4, where only its links' length is printed.
///
/// Base joint 1 is at (-base/2, 0), base joint 2 at (base/2, 0), the plane is x-y. Each carries a proximal link at the
/// angle q_i from the x axis and that a distal one; the distal links meet at the tip. Of the ways to assemble this it
/// is the one with the elbows outward and the tip to the left of the way from elbow 1 to elbow 2.
///
/// The joint limits are a box in which the loop closes everywhere, clear of both kinds of singularity; the constructor
/// checks that. The joints at which the loop closes at all are no box: work in another part of them needs limits of its
/// own, and beyond limits, where the loop may not close, a pose may be non-finite. The default box lies where the tip
/// is to the right of the middle; it holds the tip at (0.08, 0.22) m, 0.05 rad from its nearest side, which is less
/// than the default margin of a SafetyLimiter.
/// @realtime  at: no allocation, no throw; two sines and cosines, a square root
template <Real Scalar_ = double>
class FiveBar {
 public:
  using Scalar = Scalar_;
  static constexpr int joints = 2;
  static constexpr int parameters = 9;
  using Vector = Eigen::Matrix<Scalar, joints, 1>;
  using Parameters = Eigen::Matrix<Scalar, parameters, 1>;

  struct Settings {
    Scalar base = ratio(1, 10);              ///< between the base joints, m, >= 0
    Scalar proximal = ratio(1, 5);           ///< length of the links at the base, m, > 0
    Scalar distal = ratio(1, 5);             ///< length of the links at the tip, m, > 0
    Vector gravity = Vector::Zero();         ///< its acceleration in the plane, m/s^2; zero: the plane is horizontal
    Vector lower{ratio(3, 2), ratio(2, 5)};  ///< of q, rad; 0 <= q2 <= q1 <= pi
    Vector upper{ratio(198, 100), ratio(5, 4)};   ///< of q, rad
    Vector torque = Vector::Constant(Scalar(2));  ///< largest magnitude, N m; 5 N at the tip take 1 N m
    Vector static_friction = Vector::Zero();      ///< N m
  };

  /// A device of uniform slender rods, alike on both sides.
  struct Masses {
    Scalar proximal = ratio(4, 1000);     ///< of one link at the base, kg
    Scalar distal = ratio(4, 1000);       ///< of one link at the tip, kg
    Scalar tip = ratio(1, 1000);          ///< kg
    Scalar rotor = ratio(12, 100'000);    ///< inertia of one motor at its joint, kg m^2
    Scalar friction = ratio(11, 10'000);  ///< viscous, of one driven joint, N m s/rad
  };

  /// @throws std::invalid_argument  where a length, a limit or gravity cannot be, or the limits allow joints at which
  ///                                the loop is open or within a sine of 1/8 of a singularity
  explicit FiveBar(const Settings& settings = Settings{})
      : links_{settings.base, settings.proximal, settings.distal, settings.gravity},
        limits_{settings.lower, settings.upper, settings.torque, settings.static_friction} {
    expect(is_finite(links_.base) && links_.base >= Scalar(0), "FiveBar: base", "finite and >= 0", links_.base);
    expect(is_finite(links_.l1) && links_.l1 > Scalar(0), "FiveBar: proximal", "finite and > 0", links_.l1);
    expect(is_finite(links_.l2) && links_.l2 > Scalar(0), "FiveBar: distal", "finite and > 0", links_.l2);
    expect(is_finite(links_.g), "FiveBar: gravity", "finite", links_.g);
    expect((limits_.lower.array() < limits_.upper.array()).all(), "FiveBar: lower", "< upper", limits_.lower);
    expect(limits_.lower[1] >= Scalar(0) && limits_.upper[1] <= limits_.lower[0], "FiveBar: lower",
           "0 <= q2 <= q1 for all joints within the limits", limits_.lower);
    expect(limits_.upper[0] <= half_turn(), "FiveBar: upper", "q1 <= pi", limits_.upper);
    expect(is_finite(limits_.torque) && (limits_.torque.array() > Scalar(0)).all(), "FiveBar: torque", "finite and > 0",
           limits_.torque);
    expect(is_finite(limits_.static_friction) && (limits_.static_friction.array() >= Scalar(0)).all(),
           "FiveBar: static_friction", "finite and >= 0", limits_.static_friction);
    check_closed();
  }

  /// The device with its joints at q, rad.
  [[nodiscard]] FiveBarPose<Scalar> at(const Vector& q) const noexcept {
    using std::cos, std::sin;
    return {links_, Vector(cos(q[0]), cos(q[1])), Vector(sin(q[0]), sin(q[1]))};
  }

  [[nodiscard]] const JointLimits<joints, Scalar>& limits() const noexcept { return limits_; }

  [[nodiscard]] const Scalar& base() const noexcept { return links_.base; }    ///< m
  [[nodiscard]] const Scalar& proximal() const noexcept { return links_.l1; }  ///< l1, m
  [[nodiscard]] const Scalar& distal() const noexcept { return links_.l2; }    ///< l2, m
  [[nodiscard]] const Vector& gravity() const noexcept { return links_.g; }    ///< m/s^2

  /// theta as FiveBarPose orders it, of this device made of rods. Off line.
  /// @throws std::invalid_argument  where a mass, an inertia or the friction is negative or not finite
  [[nodiscard]] Parameters theta_of(const Masses& masses) const {
    check_mass(masses.proximal, "FiveBar: Masses: proximal");
    check_mass(masses.distal, "FiveBar: Masses: distal");
    check_mass(masses.tip, "FiveBar: Masses: tip");
    check_mass(masses.rotor, "FiveBar: Masses: rotor");
    check_mass(masses.friction, "FiveBar: Masses: friction");
    const Scalar &l1 = links_.l1, &l2 = links_.l2;
    const Scalar at_elbow = masses.distal / 2, at_tip = masses.distal / 2;
    const Scalar I = masses.rotor + masses.proximal * l1 * l1 / 3 + at_elbow * l1 * l1;
    const Scalar E = masses.distal * l2 * l2 / 3 - at_tip * l2 * l2;
    const Scalar s = masses.proximal * l1 / 2 + at_elbow * l1;
    Parameters theta;
    theta << I, I, E, E, masses.tip + 2 * at_tip, s, s, masses.friction, masses.friction;
    return theta;
  }

 private:
  [[nodiscard]] static Scalar ratio(int over, int under) noexcept { return Scalar(over) / Scalar(under); }
  [[nodiscard]] static Scalar half_turn() noexcept {
    using std::acos;
    return acos(Scalar(-1));
  }

  static void check_mass(const Scalar& value, const char* name) {
    expect(is_finite(value) && value >= Scalar(0), name, "finite and >= 0", value);
  }

  // For 0 <= q2 <= q1 <= pi the distance of the elbows rises with q1 and falls with q2, so that two corners decide
  // whether the loop closes, clear of where the distal links are in line. Whether a side is stretched or folded is
  // decided on a grid: between its nodes the sines change by less than the margin.
  void check_closed() const {
    constexpr int cells = 32;
    const Scalar margin = ratio(1, 8);
    for (int i = 0; i <= cells; ++i) {
      for (int j = 0; j <= cells; ++j) {
        const Vector share(ratio(i, cells), ratio(j, cells));
        const Vector q = limits_.lower + share.cwiseProduct(limits_.upper - limits_.lower);
        const auto sines = at(q).sines();
        expect(sines[0] >= margin && sines[1] <= -margin && sines[2] >= margin, "FiveBar: lower, upper",
               "joints at which the loop closes, elbows outward, clear of singularities", q);
      }
    }
  }

  typename FiveBarPose<Scalar>::Links links_;
  JointLimits<joints, Scalar> limits_;
};

}  // namespace limpid
