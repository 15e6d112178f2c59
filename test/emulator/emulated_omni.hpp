// SPDX-License-Identifier: MIT
#pragma once

#include "emulated_arm.hpp"
#include "emulated_usb_device.hpp"
#include "omni_board.hpp"
#include "omni_fault.hpp"

#include <limpid/core/time.hpp>

#include <optional>
#include <string>
#include <thread>

namespace limpid::emulator {

/// What is known of an EmulatedOmni at an instant. Times are those of steady_now().
struct OmniSnapshot {
  std::uint64_t frames = 0;           ///< made
  std::uint64_t frames_taken = 0;     ///< of which a waiting transfer took one at once
  std::uint64_t frames_replaced = 0;  ///< of which none came for one before it was too old
  std::uint32_t last_frame = 0;       ///< sequence of the last one that was not held back
  std::uint64_t commands = 0;         ///< valid ones
  std::uint64_t commands_invalid = 0;
  std::uint64_t commands_refused = 0;  ///< valid ones that wanted motors on while the board refused it
  std::uint64_t dac_out_of_range = 0;  ///< valid commands with a DAC above 4095
  std::uint64_t watchdog_trips = 0;
  std::uint64_t watchdog_trips_with_torque = 0;  ///< of which with motors on till then
  std::uint64_t pauses = 0;                      ///< how often the machine held the emulator up for more than 5 ms
  bool plugged = false;
  bool claimed = false;    ///< by a host
  bool motors_on = false;  ///< and with torque
  bool docked = false;
  std::uint16_t flags = 0;
  std::uint16_t boots = 0;
  std::uint16_t watchdog = 0;  ///< of the last valid command, ms
  OmniBoard::Dac last_dac{};   ///< of the last valid command
  EmulatedArm::Counts counts{};
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();          ///< of the motors at the joints now, N m
  Eigen::Vector3d largest_torque = Eigen::Vector3d::Zero();  ///< its largest magnitudes since the mark, N m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();           ///< of the operator now, N
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();             ///< m, base frame
  JointState<3> joints{};                                    ///< where the arm really is
  std::optional<Time> last_command{};                        ///< when the last valid command was taken
  std::optional<Time> motors_since{};                        ///< when motors first had torque
  std::optional<Time> motors_until{};                        ///< when they last ceased to have it
};

/// An Omni on its bridge board, live: a thread of its own moves the arm, takes commands and makes frames every
/// millisecond. A hand holds the arm still until motors first have torque, and then moves it with the force set.
/// Docked or not is a flag, which does not hold the arm. Thread-safe.
class EmulatedOmni {
 public:
  static constexpr std::uint8_t in = 0x81, out = 0x01;  // endpoints

  struct Settings {
    std::string path = "1-1";
    std::uint16_t vendor = 0x1209;
    std::uint16_t product = 0x0001;
    std::string serial = "EMULATED";
    unsigned mode = 0666;  ///< of its device node
    bool plugged = true;
    EmulatedArm::Settings arm{};
    Eigen::Vector3d gimbal = Eigen::Vector3d::Zero();  ///< device gimbal angles, rad
    bool docked = false;
    std::uint16_t boots = 1;
    std::uint32_t sequence = 0;  ///< of the frame before the first
    Duration uptime{};           ///< by the device's clock, at the start
  };

  EmulatedOmni(EmulatedBus& bus, const Settings& settings);
  ~EmulatedOmni();
  EmulatedOmni(const EmulatedOmni&) = delete;
  EmulatedOmni& operator=(const EmulatedOmni&) = delete;

  [[nodiscard]] OmniSnapshot snapshot() const;
  void mark();  ///< the largest torque counts from here

  void set_docked(bool docked);
  void set_pressed(bool first, bool second);
  void set_gimbal(const Eigen::Vector3d& gimbal);
  void set_force(EmulatedArm::Force force);  ///< its time still counts from when motors first had torque
  void let_go();                             ///< the hand no longer holds the arm still, motors or not

  /// @param frames  how many; without, until it is cleared
  void set(OmniFault fault, int frames = OmniFaults::always);
  void clear(OmniFault fault);
  void clear_faults();

  void unplug();
  /// At `path`, or where it was; powered up, with counts from zero where the arm is, or at `home`, as if it were docked
  /// for that moment.
  void plug(const std::optional<std::string>& path = std::nullopt, bool at_home = false);
  /// Loses power and has it again, too short for the bus to see.
  /// @param counted  whether the board knows that
  void reboot(bool counted = true);

 private:
  void run();
  void tick(Time when);
  void take_command(Usbfs& usbfs, Time when);
  void track_motors(Time when);
  void make_frame(Usbfs* usbfs);
  void deliver(Usbfs& usbfs, const Bytes& frame);
  void power_up(bool counted = true);
  [[nodiscard]] OmniFrame measured() const;
  [[nodiscard]] Bytes spoiled(Bytes frame) const;

  EmulatedUsbDevice device_;
  mutable std::mutex mutex_;
  bool stopping_ = false;
  EmulatedArm arm_;
  OmniBoard board_{};
  OmniFaults faults_{};
  Eigen::Vector3d home_;
  OmniSnapshot seen_{};  // what is counted, and what is set
  OmniFrame frame_{};    // the next: sequence, buttons, gimbal
  Bytes last_frame_{};
  Time clock_{};  // since power-up
  std::uint64_t ticks_ = 0;
  bool motors_were_on_ = false;
  std::thread thread_;
};

}  // namespace limpid::emulator
