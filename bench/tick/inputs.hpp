// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/haptic_device.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace limpid::bench {

/// What a tick is given.
template <int Axes, typename Scalar = double>
struct TickInput {
  Eigen::Matrix<Scalar, 3, 1> F_h;
  ToolState<Axes, Scalar> tool;
  DeviceState<3, Scalar> device;

  template <typename To>
  [[nodiscard]] TickInput<Axes, To> cast() const {
    TickInput<Axes, To> to;
    to.F_h = F_h.template cast<To>();
    to.tool = {tool.x.template cast<To>(), tool.v.template cast<To>(), tool.a.template cast<To>(),
               tool.force.template cast<To>()};
    to.device.q = device.q.template cast<To>();
    to.device.qdot = device.qdot.template cast<To>();
    return to;
  }
};

/// How the tool moves along each axis, m: middle + amplitude sin(3 w t + axis), three times in 1.024 s.
struct Course {
  Eigen::Array3d middle{0, 0, 0}, amplitude{0, 0, 0};

  [[nodiscard]] bool moves() const { return (amplitude != 0).any(); }
};

/// Up to 0.4 N along each axis of the tissue of `tick_inputs`: of what the Omni's motors may give beside its weight,
/// nine tenths. So no tick is limited but the first few, until the torque has risen from zero.
inline const Course press{.amplitude = {3e-4, 3e-4, 3e-4}};

/// 1024 ticks of 1 ms, periodic: the true tool on its course, the force that it takes in this environment, and a device
/// that follows but for 2 mrad.
template <Environment Env>
[[nodiscard]] std::vector<TickInput<EnvironmentTraits<Env>::axes>> inputs_along(
    const Course& course, const Env& environment, const EnvironmentTheta<Env>& theta,
    const Tool<EnvironmentTraits<Env>::axes>& tool) {
  constexpr int axes = EnvironmentTraits<Env>::axes, ticks = 1024;
  constexpr double rate = 3 * 2 * 3.14159265358979 / 1.024;  // rad/s
  const Eigen::Vector3d home(0, 0.7853981633974483, -1.25), wall = Omni<>{}.at(home).position();
  const OmniKinematics<> kinematics{Omni<>{}};
  std::vector<TickInput<axes>> inputs;
  for (int i = 0; i < ticks; ++i) {
    const Eigen::Array3d angle = rate * 0.001 * i + Eigen::Array3d(0, 1, 2);
    const EnvironmentVector<Env> middle = course.middle.head<axes>(), amplitude = course.amplitude.head<axes>(),
                                 x = middle + amplitude * angle.head<axes>().sin(),
                                 v = amplitude * rate * angle.head<axes>().cos(),
                                 a = -amplitude * rate * rate * angle.head<axes>().sin();
    TickInput<axes> input;
    input.tool = {x, v, a, EnvironmentTraits<Env>::force(environment, theta, x, v)};
    input.F_h.setZero();
    input.F_h.template head<axes>() =
        input.tool.force + tool.mass * a + tool.damping * v + tool.stiffness * (x - tool.anchor);
    Eigen::Vector3d tip = wall, rates = Eigen::Vector3d::Zero();
    tip.head<axes>() += x.matrix();
    rates.head<axes>() = v.matrix();
    const auto joints = kinematics.inverse(tip, rates, Eigen::Vector3d::Zero(), home);
    const double off = course.moves() ? 0.002 : 0;  // rad
    input.device.q = joints.q + off * angle.cos().matrix();
    input.device.qdot = joints.qdot - off * rate * angle.sin().matrix();
    inputs.push_back(input);
  }
  return inputs;
}

}  // namespace limpid::bench
