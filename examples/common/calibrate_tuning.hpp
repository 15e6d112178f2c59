// SPDX-License-Identifier: MIT
#pragma once

#include "tuning_run.hpp"

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/haptic_device.hpp>

#include <chrono>
#include <vector>

namespace limpid::examples {

/// A tick of the tuning run.
struct TuningSample {
  double time;             ///< by the device's clock, s
  Eigen::Vector3d q;       ///< as measured, rad
  Eigen::Vector3d torque;  ///< that the arm has from this tick to the next, N m
  Eigen::Vector3d error;   ///< q - q_d, rad
  Omni<>::Parameters theta_hat;
};

/// The tuning run of 5.2.7 as a tick, for a loop of any kind: adaptive controller, SafetyLimiter, record.
class TuningTask {
 public:
  struct Settings {
    Omni<>::Parameters theta0 = Omni<>::table_5_2();  ///< theta_hat at the start
    Duration length = std::chrono::seconds(30);       ///< > 0
    Duration blend{};                                 ///< from rest where the arm is to the sines, >= 0
    SafetyLimiter<Omni<>>::Settings limiter{};
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit TuningTask(const Settings& settings);

  /// @param taken  when the state was taken, by the device's clock: what is recorded is by it, each state once
  /// @realtime     no allocation up to `length` at 1 kHz, no throw
  [[nodiscard]] SafetyLimiter<Omni<>>::Result tick(Time now, const DeviceState<3>& seen, Time taken) noexcept;

  /// Whether `length` is over and the torque has faded out, in 2 s.
  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] const std::vector<TuningSample>& record() const noexcept { return record_; }
  [[nodiscard]] Status status() const noexcept { return status_; }

 private:
  [[nodiscard]] DesiredJoints<3> wanted(double t) const noexcept;
  [[nodiscard]] SafetyLimiter<Omni<>>::Result fade(Time now, const DeviceState<3>& seen, double part) noexcept;

  Settings settings_;
  SlotineLiAdaptive<Omni<>> controller_;
  SafetyLimiter<Omni<>> limiter_;
  std::vector<TuningSample> record_;
  Eigen::Vector3d applied_ = Eigen::Vector3d::Zero();                                 // N m
  Eigen::Vector3d start_ = Eigen::Vector3d::Zero(), last_ = Eigen::Vector3d::Zero();  // rad; N m of the run's end
  Time begin_{}, first_taken_{}, last_taken_{};
  bool begun_ = false, done_ = false;
  Status status_ = Status::ok;
};

/// The run on the realistic simulated arm, whose parameters are Table 5.2.
[[nodiscard]] TuningTask simulate_tuning(const TuningTask::Settings& settings);

/// What the run tells of the arm, 5.2.8.
struct TuningResult {
  Eigen::Vector3d bound;         ///< largest error of each joint from a third of the run on, rad
  Omni<>::Parameters adapted;    ///< theta_hat, mean over the last third
  Omni<>::Parameters fitted;     ///< theta by least squares over the whole run
  Omni<>::Parameters deviation;  ///< its standard deviation, as far as the residuals are independent
  Eigen::Vector3d friction;      ///< Coulomb friction of the joints in motion by the same, N m
  Eigen::Vector3d friction_deviation;
  double residual;  ///< root mean square of the torque that the fit does not explain, N m
};

/// Adaptation's answer, and beside it the least squares in
///
///     tau = phi(q, q', q'') theta + f_c sign(q')
///
/// over the record: q, q' and q'' by a cubic through the angles of 120 ms, tau by the same cubic; joints that reverse
/// within them, where friction is anything up to f_c, are left out.
/// @throws std::invalid_argument  where the record is shorter than 10 s
[[nodiscard]] TuningResult evaluate_tuning(const std::vector<TuningSample>& record);

}  // namespace limpid::examples
