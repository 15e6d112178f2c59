// SPDX-License-Identifier: MIT
#include "usb_omni_record.hpp"

#include <algorithm>
#include <cstdio>

namespace limpid::examples {

namespace {

std::array<double, 3> flat(const Eigen::Vector3d& vector) noexcept { return {vector[0], vector[1], vector[2]}; }

void append(std::string& line, const std::array<double, 3>& values) {
  for (const double value : values) {
    std::array<char, 32> text{};
    (void)std::snprintf(text.data(), text.size(), ",%.6f", value);
    line += text.data();
  }
}

// "stale, fault" would be two columns.
std::string status_word(std::uint32_t status) {
  std::string words = limpid::describe(static_cast<Status>(status));
  std::replace(words.begin(), words.end(), ',', '+');
  std::erase(words, ' ');
  return words;
}

}  // namespace

OmniRecord record_of(const DeviceState<3>& seen, const OmniBridge::State& state, bool calibrated, Time begin) noexcept {
  return {.time = in_seconds(seen.stamp - begin),
          .q = flat(seen.q),
          .qdot = flat(seen.qdot),
          .gimbal = flat(seen.gimbal),
          .buttons = (state.pressed[0] ? 1U : 0U) | (state.pressed[1] ? 2U : 0U),
          .counts = state.encoder,
          .docked = state.docked,
          .calibrated = calibrated,
          .sequence = state.sequence,
          .device_time = state.device_time,
          .status = static_cast<std::uint32_t>(seen.status)};
}

std::string omni_record_header() {
  return "time,q1,q2,q3,qdot1,qdot2,qdot3,yaw,pitch,roll,buttons,count1,count2,count3,docked,calibrated,sequence,"
         "device_us,status\n";
}

std::string csv_line(const OmniRecord& record) {
  std::array<char, 32> time{};
  (void)std::snprintf(time.data(), time.size(), "%.6f", record.time);
  std::string line = time.data();
  append(line, record.q);
  append(line, record.qdot);
  append(line, record.gimbal);
  line += ',' + std::to_string(record.buttons);
  for (const std::int16_t count : record.counts) line += ',' + std::to_string(count);
  line += record.docked ? ",1" : ",0";
  line += record.calibrated ? ",1" : ",0";
  line += ',' + std::to_string(record.sequence) + ',' + std::to_string(record.device_time);
  return line + ',' + status_word(record.status) + '\n';
}

}  // namespace limpid::examples
