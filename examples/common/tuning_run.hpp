// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/omni.hpp>

#include <Eigen/Core>

namespace limpid::examples {

/// The run by which section 5.2.7 tunes the adaptive controller.

/// Where its sines are about: (0, pi/4, -1.5) rad, which (5.4) allows.
[[nodiscard]] Eigen::Vector3d tuning_pose();

/// The sines about q(0), rad, t in s.
[[nodiscard]] DesiredJoints<3> tuning_reference(double t, const Eigen::Vector3d& q0);

/// With the gains (5.6) and (5.7).
/// @param theta0  theta_hat at the start
[[nodiscard]] SlotineLiAdaptive<Omni<>> tuned_controller(const Omni<>::Parameters& theta0);

}  // namespace limpid::examples
