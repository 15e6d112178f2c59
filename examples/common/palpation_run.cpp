// SPDX-License-Identifier: MIT
// Apart from the loops, which cost a compiler enough without the plant, the arm and the hand.
#include "palpation_run.hpp"

#include "hand_sensor.hpp"
#include "palpation_live.hpp"
#include "palpation_operator.hpp"

namespace limpid::examples {

namespace {

// What is left of the status once the wait for the first sample is explained.
Status beyond_waiting(Status status) {
  return static_cast<Status>(static_cast<std::uint32_t>(status) & ~static_cast<std::uint32_t>(Status::no_sample));
}

}  // namespace

PalpationResult run(const Scene& scene, const LoopStep& step, const ProgressCallback& progress) {
  if (scene.live) return run_live(scene, step, progress);
  PalpationResult result;
  const Plant plant = make_plant(scene);
  const Eigen::Vector3d wall = wall_of(scene);
  const Omni<> arm;
  SimulatedOmni<> device = make_device(scene);
  HandSensor sensor(scene);
  PalpationOperator person(scene, wall[0]);
  const Duration::rep ticks = scene.duration / scene.tick;
  result.trace.reserve(static_cast<std::size_t>(ticks + 1));
  for (Duration::rep k = 0; k <= ticks; ++k) {
    const Time now = k * scene.tick;
    const double F_h = person.press(now, device);
    const Eigen::Vector3d hand{F_h, 0, 0};
    const auto [heard, sensed] = sensor.hear(now, hand);
    const Eigen::Vector3d on_arm = scene.playback ? Eigen::Vector3d(0, 0, 0) : heard;
    const ToolState<3> tool = plant(now, heard[0]);
    result.status |= beyond_waiting(sensed) | person.status() | device.advance(now, hand);
    const DeviceState<> measured = device.read(now);

    const auto [torque, motion, parameters, status, work] = step(now, heard, on_arm, tool, measured);

    result.tick.add(work);
    result.status |= beyond_waiting(status);
    result.status |= device.write(torque);

    const auto truth = device.true_state();
    const auto pose = arm.at(truth.q);
    const Eigen::Array3d tip = (pose.position() - wall).array();
    const Eigen::Array3d tip_velocity = (pose.jacobian() * truth.qdot).array();
    const Eigen::Array3d ep = motion.x - tool.x, ev = motion.v - tool.v, et = tip - tool.x, etv = tip_velocity - tool.v;
    (void)result.prediction.add(now, ep, ev);
    (void)result.total.add(now, et, etv);
    result.trace.push_back({in_seconds(now), scene.force.at(now), F_h, tool.x[0], motion.x[0], tip[0],
                            std::sqrt((ep * ep + ev * ev).sum()), std::sqrt((et * et + etv * etv).sum()), parameters,
                            torque.value()});
    if (progress && k % 256 == 0) progress(static_cast<double>(k) / static_cast<double>(ticks));
  }
  result.energy = person.energy();
  return result;
}

}  // namespace limpid::examples
