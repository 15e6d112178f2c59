// SPDX-License-Identifier: MIT
#include "palpation_live.hpp"

#include "hand_sensor.hpp"
#include "live_device.hpp"
#include "live_tissue.hpp"
#include "loop_panel.hpp"
#include "text_panel.hpp"

#include <limpid/loop/realtime/periodic_loop.hpp>
#include <limpid/loop/realtime/stop_on_signal.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <utility>

#include <unistd.h>

namespace limpid::examples {

namespace {

PeriodicSettings settings_of(const Scene& scene) {
  return {.period = scene.tick,
          .origin = scene.device->grid(scene.tick),
          .thread = {.priority = scene.live->priority, .lock_memory = scene.live->lock_memory}};
}

// One tick after another; no exception leaves it.
class LiveTicks {
 public:
  LiveTicks(const Scene& scene, const LoopStep& step, LiveDevice& device, std::stop_source& stop)
      : scene_{scene},
        step_{step},
        device_{device},
        stop_{stop},
        plant_{make_plant(scene)},
        tissue_{scene},
        wall_{wall_of(scene)},
        sensor_(scene) {
    result_.trace.reserve(static_cast<std::size_t>(scene.duration / scene.tick + 2));
    if (::isatty(STDERR_FILENO) == 1)
      panel_.emplace([](const LoopValues& values) { return lines_of(values); },
                     TextPanelSettings{.descriptor = STDERR_FILENO});
  }

  // What the tissue throws ends the run, with motors off.
  Status tick(const TickTime& at) noexcept {
    try {
      return follow(at);
    } catch (const std::exception& error) {
      (void)device_.write({});
      failure_ = error.what();
      return Status::fault;
    }
  }

  PalpationResult result(const RealtimeReport& loop) {
    (void)device_.write({});
    if (!failure_.empty()) throw std::runtime_error(failure_);
    LiveReport& live = result_.live.emplace();
    live.loop = loop;
    live.samples = tissue_.samples();
    live.without_force = tissue_.faded();
    live.device = device_.report();
    panel_.reset();
    constexpr auto waiting = static_cast<std::uint32_t>(Status::no_sample);
    result_.status = static_cast<Status>(static_cast<std::uint32_t>(loop.status) & ~waiting);
    return std::move(result_);
  }

 private:
  Status follow(const TickTime& at) {
    if (!begin_ && !device_.settle(at.now)) return Status::ok;
    if (!begin_) begin_ = at.now;
    const Time now = at.now - *begin_;
    if (now > scene_.duration) {
      stop_.request_stop();
      return Status::ok;
    }
    const double F_h = scene_.force.at(now);
    const Eigen::Vector3d hand{F_h, 0, 0};
    const auto [heard, sensed] = sensor_.hear(now, hand);
    const Eigen::Vector3d on_arm = scene_.playback ? Eigen::Vector3d(0, 0, 0) : heard;
    const ToolState<3> tool = plant_(now, heard[0]);
    tissue_.exchange(now, heard[0]);
    const DeviceState<> measured = device_.read(at.now, hand);
    const LoopTick made = step_(now, heard, on_arm, tool, measured);
    const Status status = sensed | made.status | device_.write(made.torque);
    result_.tick.add(made.work);
    note(now, F_h, tool, made);
    if (panel_) show(at.missed);
    return status;
  }

  void show(std::uint64_t missed) noexcept {
    missed_ += missed;
    const TracePoint& last = result_.trace.back();
    panel_->show({.time = from_seconds(last.time),
                  .position = wall_ + Eigen::Vector3d(last.tip, 0, 0),
                  .force = {last.force, 0, 0},
                  .error = std::abs(last.tip - last.ideal),
                  .ticks = result_.trace.size(),
                  .missed = missed_,
                  .status = when(tissue_.factor() < 1, Status::stale)});
  }

  void note(Time now, double F_h, const ToolState<3>& tool, const LoopTick& made) {
    const JointState<3> joints = device_.joints();
    const auto pose = Omni<>{}.at(joints.q);
    const Eigen::Array3d tip = (pose.position() - wall_).array(),
                         tip_velocity = (pose.jacobian() * joints.qdot).array();
    const Eigen::Array3d ep = made.motion.x - tool.x, ev = made.motion.v - tool.v;
    const Eigen::Array3d et = tip - tool.x, etv = tip_velocity - tool.v;
    (void)result_.prediction.add(now, ep, ev);
    (void)result_.total.add(now, et, etv);
    if (result_.trace.size() == result_.trace.capacity()) return;
    result_.trace.push_back({in_seconds(now), F_h, F_h, tool.x[0], made.motion.x[0], tip[0],
                             std::sqrt((ep * ep + ev * ev).sum()), std::sqrt((et * et + etv * etv).sum()),
                             made.parameters, made.torque.value()});
  }

  const Scene& scene_;
  const LoopStep& step_;
  LiveDevice& device_;
  std::stop_source& stop_;
  Plant plant_;
  LiveTissue tissue_;
  Eigen::Vector3d wall_;
  HandSensor sensor_;
  std::optional<Time> begin_;
  std::uint64_t missed_ = 0;
  std::string failure_;
  PalpationResult result_;
  std::optional<TextPanel<LoopValues>> panel_;
};

}  // namespace

void prepare_live(Scene& scene) {
  std::stop_source stop;
  const StopOnSignal on_signal(stop);
  scene.remote = std::make_shared<RemoteTissue>();
  scene.device = make_live_device(scene);
  scene.device->prepare(stop.get_token());
  if (stop.stop_requested()) throw std::runtime_error("interrupted");
  scene.start = scene.device->joints().q;
}

PalpationResult run_live(const Scene& scene, const LoopStep& step, const ProgressCallback&) {
  std::stop_source stop;
  const StopOnSignal on_signal(stop);
  LiveTicks ticks(scene, step, *scene.device, stop);
  PeriodicLoop loop(settings_of(scene));
  const RealtimeReport& report =
      loop.run(stop.get_token(), [&](const TickTime& at) noexcept { return ticks.tick(at); });
  return ticks.result(report);
}

}  // namespace limpid::examples
