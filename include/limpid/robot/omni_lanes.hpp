// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_math.hpp>
#include <limpid/core/quad.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

namespace limpid::detail {

/// The Omni's inverse kinematics (3.3)-(3.6), (3.13), (3.14) with its links side by side: by their own angles from the
/// horizontal, q2 and q2 + q3, both have the same equations with the other's angle. Lanes: joint 1, link 2, link 3, and
/// joint 3 by its angle from link 2.
///
/// Only for a tip that is reached clear of singularities; `OmniKinematics` knows of the others, and what to do at the
/// joints' limits.
/// @realtime  no allocation, no throw; one division of all lanes beside the arc tangents', two square roots
template <std::floating_point Scalar>
class OmniLanes {
  using Lane = Quad<Scalar>;
  using Array = typename Lane::Array;

 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  struct Motion {
    Vector q, qdot, qddot;  ///< rad, rad/s, rad/s^2; unset at first
    bool at_limits;         ///< whether q may be beyond the limits
  };

  /// Whether four lanes fill a register: else they are not worth their while.
  static constexpr bool pay = four_in_a_register;

  /// @param lower, upper  of the joints, rad
  /// @param elbow_sum     largest q2 + q3, rad
  /// @param least_r       of the tip from the vertical axis, m
  /// @param least_sine    of joint 3, without its sign
  OmniLanes(const Scalar& l2, const Scalar& l3, const Vector& lower, const Vector& upper, const Scalar& elbow_sum,
            const Scalar& least_r, const Scalar& least_sine) noexcept
      : links_{Scalar(0), l2, l3, Scalar(0)},
        twice_{Scalar(1), 2 * l2, 2 * l3, Scalar(1)},
        middle_{Scalar(0), l2 * l2 - l3 * l3, l3 * l3 - l2 * l2, Scalar(0)},
        rates_{Scalar(0), 2 * l3, -2 * l2, Scalar(0)},
        lower_{lower[0], lower[1], -std::numeric_limits<Scalar>::infinity(), lower[2]},
        upper_{upper[0], upper[1], elbow_sum, upper[2]},
        near_{(l2 - l3) * (l2 - l3)},
        far_{(l2 + l3) * (l2 + l3)},
        squares_{l2 * l2 + l3 * l3},
        per_twice_l2l3_{1 / (2 * l2 * l3)},
        least_r_{least_r},
        least_bend_{2 * l2 * l3 * least_sine} {}

  /// @param x, v, a  tip in the base frame, m, m/s, m/s^2
  /// @return         whether `motion` is the answer
  [[nodiscard, gnu::always_inline]] bool inverse(const Vector& x, const Vector& v, const Vector& a,
                                                 Motion& motion) const noexcept {
    using std::sqrt;
    const Scalar level = x[0] * x[0] + x[1] * x[1], square = level + x[2] * x[2];
    const Scalar r = sqrt(level), bend = sqrt((square - near_) * (far_ - square));  // (3.4), -2 l2 l3 sin q3
    if (!(r >= least_r_ && bend >= least_bend_)) [[unlikely]]
      return false;
    const Lane tip = Lane::of(x), all_r = Lane::all(r), z = spread<2>(tip), cosine = Lane::all(square - squares_);

    // (3.5), (3.6): cosines and sines, times r, 2 l2 square, 2 l3 square and 2 l2 l3
    const Lane middle = Lane::all(square) + Lane::of(middle_);
    const Lane side = Lane::all(bend) * Lane{{Scalar(0), Scalar(1), Scalar(-1), Scalar(-1)}};
    const Lane forward = joints_1_and_3(all_r * middle - z * side, tip, cosine);
    const Lane upward = joints_1_and_3(z * middle + all_r * side, shuffle<1, 0, 2, 3>(tip, tip), side);
    const Lane q{Lane::of(Array(limpid::arc_tangent(upward.array(), forward.array())))};
    const Lane per = Lane::all(Scalar(1)) / joints_1_and_3(Lane::all(square) * Lane::of(twice_), all_r, side);
    const Lane C = forward * per, S = upward * per, C_o = other(C), S_o = other(S);
    const Lane scale = joint_1(spread<3>(per) * Lane::of(rates_), per);
    const Lane c1 = spread<0>(C), s1 = spread<0>(S) * Lane{{Scalar(1), Scalar(-1), Scalar(1), Scalar(-1)}};

    // (3.13), then (3.14): what the arm's own motion takes off the acceleration lies along the links and around joint 1
    const Lane v_arm = into_arm(c1, s1, Lane::of(v)), v_out = spread<0>(v_arm);
    const Lane w = joint_1(C_o * v_out + S_o * spread<2>(v_arm), around(v_arm)) * scale;
    const Lane w1 = spread<0>(w), pull = Lane::of(links_) * w * w;
    const Lane a_arm = into_arm(c1, s1, Lane::of(a)), inward = spread<0>(a_arm) + all_r * w1 * w1;
    const Lane c3 = cosine * Lane::all(per_twice_l2l3_), coriolis = (v_out + v_out) * w1;
    const Lane along_links = C_o * inward + S_o * spread<2>(a_arm) + c3 * pull + other(pull);
    const Lane dw = joint_1(along_links, around(a_arm) - coriolis) * scale;

    const Scalar w3 = w.v[2] - w.v[1], dw3 = dw.v[2] - dw.v[1];
    motion.at_limits = are_beyond_limits(q);
    q.store(q.v[3], motion.q);
    w.store(w3, motion.qdot);
    dw.store(dw3, motion.qddot);
    return are_finite(dw.array()) && (w3 + dw3) * Scalar(0) == Scalar(0);  // else v or a is beyond any range
  }

 private:
  /// `links` with lane 0 of another.
  [[gnu::always_inline]] static Lane joint_1(const Lane& links, const Lane& of_1) noexcept {
    return shuffle<4, 1, 2, 3>(links, of_1);
  }
  /// `links` with lane 0 of one and lane 3 of another.
  [[gnu::always_inline]] static Lane joints_1_and_3(const Lane& links, const Lane& of_1, const Lane& of_3) noexcept {
    return shuffle<0, 1, 2, 7>(joint_1(links, of_1), of_3);
  }
  /// The other link's.
  [[gnu::always_inline]] static Lane other(const Lane& links) noexcept { return shuffle<0, 2, 1, 3>(links, links); }

  /// A vector of the base frame along r, around the axis, up, up; `s1` with the sign of lane 1 turned.
  [[gnu::always_inline]] static Lane into_arm(const Lane& c1, const Lane& s1, const Lane& v) noexcept {
    return shuffle<0, 1, 6, 7>(c1 * v + s1 * shuffle<1, 0, 2, 3>(v, v), v);
  }
  [[gnu::always_inline]] static Lane around(const Lane& in_arm) noexcept { return shuffle<1, 1, 2, 3>(in_arm, in_arm); }

  [[gnu::always_inline]] bool are_beyond_limits(const Lane& q) const noexcept {
    const Lane over = q - Lane::of(upper_), under = Lane::of(lower_) - q;
    const auto beyond = (over.v > Scalar(0)) | (under.v > Scalar(0));
    return any_lane(beyond);
  }

  Array links_, twice_, middle_, rates_, lower_, upper_;  // by lanes
  Scalar near_, far_, squares_, per_twice_l2l3_, least_r_, least_bend_;
};

/// What stands in their place for scalars that have no such registers.
struct NoOmniLanes {
  static constexpr bool pay = false;
  explicit NoOmniLanes(const auto&...) noexcept {}
};

template <Real Scalar>
struct OmniLanesOf : std::type_identity<NoOmniLanes> {};
template <>
struct OmniLanesOf<float> : std::type_identity<OmniLanes<float>> {};
template <>
struct OmniLanesOf<double> : std::type_identity<OmniLanes<double>> {};

}  // namespace limpid::detail
