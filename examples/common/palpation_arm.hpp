// SPDX-License-Identifier: MIT
// The arm of a scene and what controls it, apart from the loops.
#pragma once

#include "scene.hpp"

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/robot/omni.hpp>

namespace limpid::examples {

/// The wall's origin in the base frame: where the tip starts, m.
[[nodiscard]] Eigen::Vector3d wall_of(const Scene& scene);

[[nodiscard]] SimulatedOmni<> make_device(const Scene& scene);

/// Gains (5.6), (5.7).
[[nodiscard]] SlotineLiAdaptive<Omni<>>::Settings controller_settings(const Scene& scene);

[[nodiscard]] SafetyLimiter<Omni<>> make_limiter(const Scene& scene);

}  // namespace limpid::examples
