// SPDX-License-Identifier: MIT
#pragma once

#include "corruption.hpp"
#include "trial.hpp"

#include <limpid/robot/omni_kinematics.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace limpid::stress {

/// OmniKinematics at any target.
template <typename Scalar>
class KinematicsStress {
 public:
  static std::vector<Choice> choices() {
    return {{"target", {"within reach", "near the edge of reach", "near the vertical axis", "anywhere"}},
            {"motion", {"slow", "absurd"}},
            corruption_choice()};
  }

  static Outcome play(const Trial& trial) {
    KinematicsStress kinematics(trial);
    return play_ticks(trial, kinematics.watch_, [&](bool seen, Random& random) { kinematics.tick(seen, random); });
  }

 private:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  explicit KinematicsStress(const Trial& trial)
      : target_{trial.choices[0]}, absurd_{trial.choices[1] == 1}, corruption_{trial.choices[2], 0.01} {}

  Vector target(Random& random) const {
    const Vector direction =
        Vector(Scalar(random.uniform(-1, 1)), Scalar(random.uniform(-1, 1)), Scalar(random.uniform(-1, 1) + 1e-3))
            .normalized();
    const double near = random.decades(-18, -2), far = random.decades(-37, 37), part = random.uniform(0.01, 0.264);
    if (target_ == 0) return direction * Scalar(part);
    if (target_ == 1) return direction * Scalar(0.265 + near);
    if (target_ == 2) return Vector(Scalar(near), Scalar(near * part), Scalar(part));
    return direction * Scalar(far);
  }

  Vector motion(Random& random) const {
    Vector v;
    for (auto& entry : v) entry = Scalar(absurd_ ? random.decades(-37, 37) : random.uniform(-1, 1));
    return v;
  }

  void tick(bool seen, Random& random) {
    Vector x = target(random), v = motion(random), a = motion(random), near = motion(random);
    for (auto* vector : {&x, &v, &a, &near}) (*vector)[1] = corruption_((*vector)[1], random);
    if (seen) judge(x, v, a, near);
  }

  void judge(const Vector& x, const Vector& v, const Vector& a, const Vector& near) {
    const auto answer = kinematics_.inverse(x, v, a, near);
    watch_.require("the answer is finite", is_finite(answer));
    if (has(answer.status, Status::not_finite)) return;
    const Omni<Scalar> arm;
    const auto limits = arm.limits();
    const Scalar rounding = 256 * std::numeric_limits<Scalar>::epsilon();
    const auto& q = answer.q;
    // Joint 1 over the axis is the caller's.
    const bool within = (q.array() <= limits.upper.array() + rounding).all() &&
                        (q.array() >= limits.lower.array() - rounding).all() &&
                        q[1] + q[2] <= arm.elbow_sum_limit() + rounding;
    watch_.require("the joints are within their limits", within);
    if (answer.status != Status::ok) return;
    const auto pose = arm.at(q);
    watch_.at_most("error of the tip, roundings of its reach", double((pose.position() - x).norm() / rounding * 256),
                   double(Scalar(64) * Scalar(0.265)));
    const Scalar size = v.norm();
    if (!(size > 0)) return;
    watch_.at_most("error of the velocity, roundings",
                   double((pose.jacobian() * answer.qdot - v).norm() / (size * rounding) * 256), 1e5);
  }

  int target_;
  bool absurd_;
  Corruption corruption_;
  OmniKinematics<Scalar> kinematics_{Omni<Scalar>{}};
  Watch watch_;
};

template <typename Scalar>
Scenario kinematics_scenario(const std::string& scalar, double share) {
  using Stress = KinematicsStress<Scalar>;
  return {"OmniKinematics<" + scalar + ">", Stress::choices(), &Stress::play, share};
}

inline std::vector<Scenario> kinematics_scenarios() {
  return {kinematics_scenario<double>("double", 3), kinematics_scenario<float>("float", 3)};
}

}  // namespace limpid::stress
