// SPDX-License-Identifier: MIT
#include "usb_calibrate.hpp"

#include "option_values.hpp"
#include "text_panel.hpp"
#include "usb_omni_options.hpp"

#include <limpid/loop/realtime/periodic_loop.hpp>
#include <limpid/loop/realtime/stop_on_signal.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <stdexcept>

namespace limpid::examples {

namespace {

using namespace std::chrono_literals;

enum class Phase { waiting, held, running };

struct TuningValues {
  Phase phase = Phase::waiting;
  bool calibrated = false;
  Eigen::Vector3d q = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  std::uint64_t missed = 0;
  Status status = Status::ok;
};

std::vector<std::string> lines_of(const TuningValues& values) {
  const auto row = [](const char* name, const Eigen::Vector3d& of, const char* unit) {
    std::array<char, 96> text{};
    (void)std::snprintf(text.data(), text.size(), "%-8s %8.4f %8.4f %8.4f %s", name, of[0], of[1], of[2], unit);
    return std::string(text.data());
  };
  const char* prompt = values.phase == Phase::running ? "the run: let the stylus go, Ctrl-C ends it"
                       : values.phase == Phase::held  ? "hold the stylus: it begins"
                       : values.calibrated            ? "draw the stylus out, and hold it"
                                                      : "dock the stylus";
  return {prompt, row("q", values.q, "rad"), row("torque", values.torque, "N m"),
          "missed   " + std::to_string(values.missed) + ", " + limpid::describe(values.status)};
}

// What a tick does: nothing until the stylus was docked and drawn out, and then the run.
class UsbTuning {
 public:
  UsbTuning(UsbOmni& omni, const TuningTask::Settings& settings, TextPanel<TuningValues>& panel)
      : omni_{omni}, task_(settings), panel_{panel} {}

  /// @return  whether to go on
  bool tick(const TickTime& at) noexcept {
    const DeviceState<3> seen = omni_.read(at.now);
    device_clock_ += std::chrono::microseconds(omni_.state().device_time - last_device_time_);  // which wraps
    last_device_time_ = omni_.state().device_time;
    if (omni_.docked() || !omni_.calibrated()) drawn_out_at_.reset();
    if (!omni_.docked() && omni_.calibrated() && !drawn_out_at_) drawn_out_at_ = at.now;
    const bool due = drawn_out_at_ && at.now - *drawn_out_at_ > holding;
    TuningValues shown{.phase = due             ? Phase::running
                                : drawn_out_at_ ? Phase::held
                                                : Phase::waiting,
                       .calibrated = omni_.calibrated(),
                       .q = seen.q,
                       .missed = missed_ += at.missed,
                       .status = seen.status};
    if (running_ && !due) return false;  // it was docked
    SafeTorque<3> torque;
    if (due) {
      running_ = true;
      const auto safe = task_.tick(at.now, seen, device_clock_);
      torque = safe.torque;
      shown.status |= safe.status;
    }
    shown.torque = torque.value();
    shown.status |= omni_.write(torque);
    status = shown.status;
    panel_.show(shown);
    too_fast = due && seen.qdot.cwiseAbs().maxCoeff() > fastest;
    return !task_.done() && !too_fast && !has(shown.status, Status::fault | Status::disconnected);
  }

  [[nodiscard]] const TuningTask& task() const noexcept { return task_; }

  Status status = Status::ok;  // of the last tick
  bool too_fast = false;

 private:
  static constexpr Duration holding = 2s;
  static constexpr double fastest = 4;  // rad/s; the sines have 0.74

  UsbOmni& omni_;
  TuningTask task_;
  TextPanel<TuningValues>& panel_;
  std::optional<Time> drawn_out_at_{};
  Time device_clock_{};
  std::uint32_t last_device_time_ = 0;  // us
  std::uint64_t missed_ = 0;
  bool running_ = false;
};

UsbOmniOptions device_of(const CalibrateOptions& options) {
  UsbOmniOptions device{.calibration = options.calibration};
  device.link.path = options.path;
  if (!options.id.empty()) {
    const auto identity = usb_identity_of(options.id);
    if (!identity) throw std::invalid_argument("--id: expected numbers as 1209:0001, got " + options.id);
    device.link.identities = {*identity};
  }
  set_watchdogs(device.link, options.watchdog);
  return device;
}

}  // namespace

CalibrationSection tune_on_usb(const CalibrateOptions& options) {
  std::cerr << "omni_calibrate: this was never run on hardware: keep a hand at the plug\n";
  TuningTask::Settings settings = options.run;
  settings.blend = 5s;
  settings.limiter.longest_gap = from_seconds(1e-3 * options.watchdog);
  std::stop_source stop;
  const StopOnSignal on_signal(stop);
  PeriodicLoop loop({.period = 1ms, .thread = {.priority = 80, .lock_memory = true}});
  std::optional<CalibrationSection> section;
  std::string ending;
  {
    UsbOmni omni(device_of(options).settings());
    TextPanel<TuningValues> panel(&lines_of, {.descriptor = STDERR_FILENO});  // results go to standard output
    UsbTuning tuning(omni, settings, panel);
    loop.run(stop.get_token(), [&](const TickTime& at) noexcept { return tuning.tick(at); });
    const auto& record = tuning.task().record();
    ending = tuning.too_fast ? "a joint turned too fast" : std::string(limpid::describe(omni.fault()));
    ending += "; status: " + limpid::describe(tuning.status);
    if (tuning.task().done()) section = tuning_section(evaluate_tuning(record), tuning.task().status(), false);
  }
  std::cerr << limpid::describe(loop.report());
  if (!section) throw std::runtime_error("expected the run to come to its end, got: " + ending);
  section->notes.emplace_back("on a device; the procedure was never run on hardware");
  return *section;
}

}  // namespace limpid::examples
