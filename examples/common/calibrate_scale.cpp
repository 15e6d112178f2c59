// SPDX-License-Identifier: MIT
#include "calibrate_scale.hpp"

#include "number_list.hpp"

#include <limpid/core/expect.hpp>
#include <limpid/robot/omni_device.hpp>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace limpid::examples {

std::vector<MeasuredTorque> read_measured_torques(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(path + ": expected a file of measured torques, got none that can be read");
  std::vector<MeasuredTorque> measured;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const auto values = numbers_of(line, ",,");
    const bool joint = values && ((*values)[0] == 1 || (*values)[0] == 2 || (*values)[0] == 3);
    if (!joint || std::abs((*values)[1]) > 1) {
      throw std::invalid_argument(path + ":" + std::to_string(number) +
                                  ": expected joint,part,torque with a joint 1 to 3 and a part of [-1, 1], got " +
                                  line);
    }
    measured.push_back({static_cast<int>((*values)[0]) - 1, (*values)[1], (*values)[2]});
  }
  return measured;
}

Eigen::Vector3d full_scale_of(const std::vector<MeasuredTorque>& measured) {
  const Eigen::Vector3d gain = OmniDevice<>::torque(Eigen::Vector3d::Ones());
  Eigen::Vector3d scale;
  for (int joint = 0; joint < 3; ++joint) {
    const std::string who = "joint " + std::to_string(joint + 1);
    double count = 0, part = 0, torque = 0;
    for (const auto& each : measured) {
      if (each.joint != joint) continue;
      ++count;
      part += each.part;
      torque += each.torque;
    }
    double square = 0, product = 0;
    for (const auto& each : measured) {
      if (each.joint != joint) continue;
      square += std::pow(each.part - part / count, 2);
      product += (each.part - part / count) * (each.torque - torque / count);
    }
    expect(count >= 2 && square > 1e-6, who, "two measurements or more at different parts", count);
    const double slope = product / square;
    expect(slope * gain[joint] > 0, who,
           gain[joint] > 0 ? "torque that rises with the part"
                           : "torque that falls as the "
                             "part rises, (5.5)",
           slope);
    scale[joint] = slope / gain[joint];
  }
  return scale;
}

}  // namespace limpid::examples
