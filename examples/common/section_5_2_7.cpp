// SPDX-License-Identifier: MIT
// Section 5.2.7: the adaptive controller follows sines on the realistic arm.
#include "section.hpp"
#include "tuning_run.hpp"

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/device/simulated_omni.hpp>

#include <array>

namespace limpid::examples {

namespace {

using Joints = Eigen::Vector3d;

struct TrackingRun {
  Joints bound = Joints::Zero();  ///< largest error of each joint once the start has died away, rad
  std::array<Curve, 3> errors;
  Status status = Status::ok;
};

constexpr Duration settled = std::chrono::seconds{10};

TrackingRun track(double safety_factor) {
  constexpr Duration tick = std::chrono::milliseconds{1}, length = std::chrono::seconds{30};
  const Joints q0 = tuning_pose();
  SimulatedOmni<> arm({.q0 = tuning_reference(0, q0).q, .realism = Realism::realistic});
  SlotineLiAdaptive<Omni<>> controller = tuned_controller(Omni<>::table_5_2());
  SafetyLimiter<Omni<>> limiter({.safety_factor = safety_factor});
  TrackingRun run;
  Joints applied = Joints::Zero();
  for (Time now{0}; now <= length; now += tick) {
    run.status |= arm.advance(now, Joints::Zero());
    const DeviceState<> measured = arm.read(now);
    const DesiredJoints<3> wanted = tuning_reference(in_seconds(now), q0);
    const auto [tau, status] = controller.update(now, measured.joint_state(), wanted, Joints::Zero(), applied);
    const auto safe = limiter.limit(now, measured.joint_state(), tau, measured.status | status);
    applied = safe.torque.value();
    run.status |= safe.status | arm.write(safe.torque);
    const Joints error = arm.true_state().q - wanted.q;
    if (now >= settled) run.bound = run.bound.cwiseMax(error.cwiseAbs());
    for (std::size_t i = 0; i < 3; ++i) {
      run.errors[i].x.push_back(in_seconds(now));
      run.errors[i].y.push_back(error[static_cast<Eigen::Index>(i)]);
    }
  }
  return run;
}

void add_run(SectionReport& report, const std::string& name, const TrackingRun& run) {
  constexpr std::array<double, 3> printed{0.035, 0.042, 0.136};  // Fig. 5.6, hardware
  for (std::size_t i = 0; i < 3; ++i) {
    report.figures.push_back({"joint " + std::to_string(i + 1) + ", " + name, run.bound[static_cast<Eigen::Index>(i)],
                              printed[i], "rad", describe(run.status)});
  }
}

}  // namespace

// The printed bounds were measured on the device, whose friction beyond that of Table 5.1 nobody printed.
SectionReport section_5_2_7() {
  SectionReport report{.title = "5.2.7 adaptive controller tuning, realistic arm: bound on the joint error after 10 s"};
  TrackingRun run = track(1.3);
  add_run(report, "torques within Table 5.1 over 1.3", run);
  add_run(report, "torques within Table 5.1", track(1.0));
  Panel panel{"joint error", "time (s)", "rad", {}};
  for (std::size_t i = 0; i < 3; ++i) {
    run.errors[i].name = "joint " + std::to_string(i + 1);
    panel.curves.push_back(run.errors[i]);
  }
  report.charts.push_back({"fig_5_6", {"Fig. 5.6: joint errors of the tuned controller", {panel}}});
  return report;
}

}  // namespace limpid::examples
