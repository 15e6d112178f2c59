// SPDX-License-Identifier: MIT
#include "omni_calibration_file.hpp"

#include "output_file.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;
using Vector = OmniCalibration::Vector;

constexpr auto vectors = std::to_array<std::pair<const char*, Vector OmniCalibration::*>>({
    {"full_scale", &OmniCalibration::full_scale},
    {"home", &OmniCalibration::home},
    {"counts_sign", &OmniCalibration::counts_sign},
    {"gimbal_slope", &OmniCalibration::gimbal_slope},
    {"gimbal_offset", &OmniCalibration::gimbal_offset},
});
constexpr const char* counts_per_turn = "counts_per_turn";

[[noreturn]] void refuse_field(const std::string& field, const std::string& expected, const std::string& got) {
  throw std::invalid_argument(field + ": expected " + expected + ", got " + got);
}

std::string names() {
  std::string all;
  for (const auto& [name, _] : vectors) all += std::string(name) + ", ";
  return all + "or " + counts_per_turn;
}

void read_vector(const std::string& name, const Json& json, Vector& vector) {
  bool fits = json.is_array() && json.size() == 3;
  if (fits) {
    for (const Json& entry : json) fits = fits && entry.is_number();
  }
  if (!fits) refuse_field(name, "3 numbers", json.dump());
  for (std::size_t i = 0; i < 3; ++i) vector[static_cast<Eigen::Index>(i)] = json[i].get<double>();
}

void read_field(const std::string& name, const Json& json, OmniCalibration& calibration) {
  for (const auto& [known, member] : vectors) {
    if (name == known) return read_vector(name, json, calibration.*member);
  }
  if (name != counts_per_turn) refuse_field(name, "a field " + names(), "one that is unknown");
  if (!json.is_number()) refuse_field(name, "a number", json.dump());
  calibration.counts_per_turn = json.get<double>();
}

// Of two fields of one name the parser would take the last.
Json parse(std::ifstream& file) {
  std::set<std::string> seen;
  const auto once = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth != 1 || event != Json::parse_event_t::key) return true;
    const auto name = parsed.get<std::string>();
    if (!seen.insert(name).second) refuse_field(name, "it once", "it twice");
    return true;
  };
  return Json::parse(file, once);
}

}  // namespace

OmniCalibration read_omni_calibration(const std::string& path) {
  std::ifstream file(path);
  try {
    if (!file || file.peek() == std::ifstream::traits_type::eof()) {
      throw std::invalid_argument("expected a file with a calibration, got none that can be read, or an empty one");
    }
    const Json json = parse(file);
    if (!json.is_object()) throw std::invalid_argument("expected an object {...}, got " + json.dump());
    OmniCalibration calibration;
    if (!json.contains("full_scale")) refuse_field("full_scale", "the torques at full scale, measured, N m", "none");
    for (const auto& [name, value] : json.items()) read_field(name, value, calibration);
    calibration.check();
    return calibration;
  } catch (const Json::exception& error) {
    throw std::invalid_argument(path + ": expected JSON, got: " + error.what());
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
}

void write_omni_calibration(const std::string& path, const OmniCalibration& calibration) {
  calibration.check();
  Json json = Json::object();
  for (const auto& [name, member] : vectors) {
    const Vector& vector = calibration.*member;
    json[name] = {vector[0], vector[1], vector[2]};
  }
  json[counts_per_turn] = calibration.counts_per_turn;
  write_file(path, json.dump(2) + '\n');
}

}  // namespace limpid::examples
