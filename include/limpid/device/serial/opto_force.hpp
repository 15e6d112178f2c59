// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/latest_value.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/force_calibration.hpp>
#include <limpid/device/force_sensor.hpp>
#include <limpid/device/opto_force_parser.hpp>
#include <limpid/device/opto_force_protocol.hpp>
#include <limpid/device/serial/byte_port.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <utility>

namespace limpid {

/// What the line to an OptoForce sensor does, or why it does not.
enum class OptoForceLink {
  opening,      ///< for the first time
  connected,    ///< the sensor has taken its configuration
  cannot_open,  ///< the port: no such device, or no right to it
  no_answer,    ///< to the configuration, three times
  refused,      ///< the configuration
  silent,       ///< no whole frame for `silence`
  hung_up,      ///< unplugged, or the port failed
};

[[nodiscard]] constexpr std::string_view describe(OptoForceLink link) noexcept {
  constexpr std::array<std::string_view, 7> names{"opening",
                                                  "connected",
                                                  "the port cannot be opened",
                                                  "the sensor does not answer",
                                                  "the sensor refuses its configuration",
                                                  "the sensor has fallen silent",
                                                  "the sensor is unplugged"};
  return names.at(static_cast<std::size_t>(link));
}

/// How an OptoForce sensor is run.
struct OptoForceSettings {
  OptoForceConfiguration configuration{};                ///< with `zero` also where it comes back: see ForceZero
  ForceCalibration<>::Settings calibration{};            ///< to be given
  Duration longest_age = std::chrono::milliseconds(20);  ///< beyond which a frame is stale, > the period
  Duration answer = std::chrono::milliseconds(500);      ///< that an answer to the configuration may take, > 0
  Duration silence = std::chrono::seconds(1);       ///< without a frame, then the line is opened anew; > longest_age
  Duration retry = std::chrono::milliseconds(250);  ///< between attempts to open, > 0
};

/// What became of the frames of an OptoForce sensor since the beginning.
struct OptoForceCounters {
  OptoForceParser::Counters bytes{};  ///< frames, lost ones, wrong checksums
  std::uint64_t errors = 0;           ///< frames that told an error
  std::uint64_t overloads = 0;        ///< frames that told an overload
  std::uint64_t connections = 0;
};

/// How the line to an OptoForce sensor is.
struct OptoForceReport {
  OptoForceLink link = OptoForceLink::opening;
  std::uint16_t status = 0;  ///< of the last frame, as sent
  OptoForceCounters counters{};
};

/// An OptoForce OMD sensor of three axes on a serial line. A thread of its own opens the port, configures the sensor,
/// takes its frames and, where the line breaks, tries anew for as long as the object lives; what it finds it leaves to
/// the loop by an exchange that waits for nobody.
///
/// A frame is stamped by `steady_now()` when its last byte has been read; `read` wants the time of that clock. Frames
/// from before the sensor took its configuration are not used, nor are those that tell an error: `fault`.
/// @realtime  read: no allocation, no throw, no call of the system; a copy of some 50 bytes
template <BytePort Port>
class OptoForce {
 public:
  using Scalar = double;
  using Settings = OptoForceSettings;
  using Report = OptoForceReport;

  /// @throws std::invalid_argument  where the settings cannot serve
  /// @throws std::system_error      where there is no thread to be had
  OptoForce(Port port, const Settings& settings)
      : settings_{checked(settings)},
        command_{encode(settings.configuration)},
        calibration_{settings.calibration},
        port_{std::move(port)},
        reader_{[this]() noexcept { keep_connected(); }} {}

  /// Ends the thread: within 0.1 s where the port's calls keep their time.
  ~OptoForce() {
    stop_.store(true, std::memory_order_relaxed);
    reader_.join();
  }

  OptoForce(const OptoForce&) = delete;
  OptoForce& operator=(const OptoForce&) = delete;
  OptoForce(OptoForce&&) = delete;
  OptoForce& operator=(OptoForce&&) = delete;

  /// The newest force, N, in the sensor's frame. By one thread, as `report`.
  [[nodiscard]] ForceReading<> read(Time now) noexcept {
    (void)latest_.take();
    const Seen& seen = latest_.value();
    if (!seen.any) return {.status = seen.status | Status::no_sample};
    stamp_ = std::max(stamp_, std::min(seen.stamp, now));
    const auto& [x, y, z] = seen.force;
    return {{x, y, z}, stamp_, seen.status | when(elapsed(now, stamp_) > settings_.longest_age, Status::stale)};
  }

  /// How the line was at the last `read`.
  [[nodiscard]] const Report& report() const noexcept { return latest_.value().report; }

 private:
  // What the reading thread has for the loop.
  struct Seen {
    std::array<double, 3> force{};  // N
    Time stamp = Time::min();
    bool any = false;
    Status status = Status::disconnected;
    Report report{};
  };

  static constexpr Duration patience = std::chrono::milliseconds(20);  // in a call that waits
  static constexpr int attempts = 3;

  static const Settings& checked(const Settings& settings) {
    settings.configuration.check();
    expect(settings.longest_age > settings.configuration.period, "OptoForce: longest_age", "> the period",
           settings.longest_age);
    expect(settings.answer > Duration::zero(), "OptoForce: answer", "> 0", settings.answer);
    expect(settings.silence > settings.longest_age, "OptoForce: silence", "> longest_age", settings.silence);
    expect(settings.retry > Duration::zero(), "OptoForce: retry", "> 0", settings.retry);
    return settings;
  }

  [[nodiscard]] bool stopping() const noexcept { return stop_.load(std::memory_order_relaxed); }

  void keep_connected() noexcept {
    while (!stopping()) {
      const OptoForceLink link = connect();
      set(link);
      if (link == OptoForceLink::connected) set(listen());
      port_.close();
      const Time until = later(steady_now(), settings_.retry);
      while (!stopping() && steady_now() < until) std::this_thread::sleep_for(patience);
    }
  }

  // Opens the port and configures the sensor; why that did not do, or `connected`.
  OptoForceLink connect() noexcept {
    parser_.reconnect();
    answer_.reset();
    if (!port_.open()) return OptoForceLink::cannot_open;
    for (int attempt = 0; attempt < attempts && !answer_ && !stopping(); ++attempt) {
      if (!port_.write(command_)) return OptoForceLink::hung_up;
      const Time until = later(steady_now(), settings_.answer);
      while (!answer_ && !stopping() && steady_now() < until) {
        if (!take_bytes()) return OptoForceLink::hung_up;
      }
    }
    if (!answer_) return OptoForceLink::no_answer;
    return *answer_ == 0 ? OptoForceLink::connected : OptoForceLink::refused;
  }

  // Takes frames until the line breaks; how it did.
  OptoForceLink listen() noexcept {
    last_frame_ = steady_now();
    while (!stopping()) {
      if (!take_bytes()) return OptoForceLink::hung_up;
      if (elapsed(steady_now(), last_frame_) > settings_.silence) return OptoForceLink::silent;
    }
    return OptoForceLink::hung_up;
  }

  // Whether the line still holds.
  bool take_bytes() noexcept {
    std::array<std::uint8_t, 256> bytes{};  // some 16 ms
    const PortRead got = port_.read(bytes, patience);
    const Time arrived = steady_now();
    parser_.take(
        std::span(bytes).first(std::min(got.bytes, bytes.size())),
        [this, arrived](const OptoForceFrame& frame) noexcept { take(frame, arrived); },
        [this](const OptoForceAnswer& answer) noexcept { answer_ = answer.error; });
    if (got.bytes > 0) publish();
    return got.open;
  }

  void take(const OptoForceFrame& frame, Time arrived) noexcept {
    if (seen_.report.link != OptoForceLink::connected) return;
    last_frame_ = arrived;
    const bool wrong = frame.errors() != 0, overloaded = frame.overloads() != 0;
    seen_.report.status = frame.status;
    seen_.report.counters.errors += wrong ? 1U : 0U;
    seen_.report.counters.overloads += overloaded ? 1U : 0U;
    seen_.status = when(wrong, Status::fault) | when(overloaded, Status::overload);
    if (wrong) return;
    const Eigen::Vector3d force = calibration_.force(frame.counts);
    seen_.force = {force[0], force[1], force[2]};
    seen_.stamp = arrived;
    seen_.any = true;
  }

  void set(OptoForceLink link) noexcept {
    seen_.report.link = link;
    seen_.report.counters.connections += link == OptoForceLink::connected ? 1U : 0U;
    seen_.status = Status::disconnected;  // until a frame has come
    publish();
  }

  void publish() noexcept {
    seen_.report.counters.bytes = parser_.counters();
    latest_.write(seen_);
  }

  Settings settings_;
  Time stamp_ = Time::min();  // of the last reading; the loop's
  LatestValue<Seen> latest_;
  std::atomic<bool> stop_{false};
  // the reading thread's
  std::array<std::uint8_t, 9> command_;
  ForceCalibration<> calibration_;
  Port port_;
  OptoForceParser parser_{};
  std::optional<std::uint8_t> answer_{};
  Time last_frame_{};
  Seen seen_{};
  std::thread reader_;  // last: it uses all of the above
};

}  // namespace limpid
