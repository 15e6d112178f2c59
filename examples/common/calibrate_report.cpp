// SPDX-License-Identifier: MIT
#include "calibrate_report.hpp"

#include <limpid/device/simulated_omni.hpp>
#include <limpid/robot/omni_device.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace limpid::examples {

namespace {

std::string joint(int i) { return "joint " + std::to_string(i + 1); }

std::string digits(double value) {
  if (!std::isfinite(value)) return "not reached";
  std::ostringstream text;
  text << std::setprecision(4) << value;
  return text.str();
}

std::optional<double> relative_error(const CalibrationFigure& figure) {
  if (!figure.truth || *figure.truth == 0 || !std::isfinite(figure.found)) return std::nullopt;
  return figure.found / *figure.truth - 1;
}

std::string percent(const std::optional<double>& error) {
  if (!error) return "";
  std::ostringstream text;
  text << std::showpos << std::fixed << std::setprecision(1) << 100 * *error << " %";
  return text.str();
}

}  // namespace

CalibrationSection ramp_section(const std::array<RampResult, 3>& joints) {
  const JointLimits<3> limits = Omni<>{}.limits();
  const Eigen::Vector3d gain = OmniDevice<>::torque(Eigen::Vector3d::Ones()), q0 = SimulatedOmni<>::start_pose();
  const Eigen::Vector3d weight = Omni<>{}.at(q0).tau_g(Omni<>::table_5_2());
  CalibrationSection section{.title = "torque ramps against a force sensor (5.2.4 to 5.2.6)"};
  const auto add = [&](const std::string& what, double RampResult::*field, const auto& truth, const std::string& unit) {
    for (int i = 0; i < 3; ++i) {
      section.figures.push_back(
          {joint(i) + ", " + what, joints.at(static_cast<std::size_t>(i)).*field, truth[i], unit});
    }
  };
  add("conversion", &RampResult::conversion, gain, "");
  add("torque limit", &RampResult::limit, limits.torque, "N m");
  add("static friction", &RampResult::friction, limits.static_friction, "N m");
  add("weight", &RampResult::offset, Eigen::Vector3d(-weight), "N m");
  return section;
}

CalibrationSection tuning_section(const TuningResult& result, Status status, bool truth) {
  static constexpr std::array units{"kg m^2", "kg m^2",    "kg m^2",    "kg m^2",   "kg m",
                                    "kg m",   "N m s/rad", "N m s/rad", "N m s/rad"};
  const Omni<>::Parameters theta = Omni<>::table_5_2();
  const Eigen::Vector3d friction = Omni<>{}.limits().static_friction;
  const auto known = [&](double value) { return truth ? std::optional<double>(value) : std::nullopt; };
  CalibrationSection section{.title = "the tuning run (5.2.7, 5.2.8)",
                             .notes = {"adaptation knows no friction and does not converge to the parameters: 5.2.8",
                                       "the fit's deviations are those of independent errors; theta1 to theta4 move "
                                       "little torque, and are off by more",
                                       "status of the run: " + limpid::describe(status)}};
  for (int i = 0; i < 3; ++i)
    section.figures.push_back({joint(i) + ", bound on the error", result.bound[i], {}, "rad"});
  for (int i = 0; i < Omni<>::parameters; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const std::string name = "theta" + std::to_string(i + 1);
    section.figures.push_back({name + ", adapted", result.adapted[i], known(theta[i]), units.at(k)});
    section.figures.push_back({name + ", fitted", result.fitted[i], known(theta[i]), units.at(k), result.deviation[i]});
  }
  for (int i = 0; i < 3; ++i) {
    section.figures.push_back({joint(i) + ", friction in motion", result.friction[i], known(friction[i]), "N m",
                               result.friction_deviation[i]});
  }
  section.figures.push_back({"torque without explanation, rms", result.residual, {}, "N m"});
  return section;
}

void print_sections(std::ostream& out, const std::vector<CalibrationSection>& sections) {
  for (const auto& [title, notes, figures] : sections) {
    out << title << '\n';
    for (const std::string& note : notes) out << "  " << note << '\n';
    out << std::left << std::setw(34) << "" << std::right << std::setw(12) << "found" << std::setw(12) << "truth"
        << std::setw(10) << "error" << '\n';
    for (const CalibrationFigure& figure : figures) {
      out << "  " << std::left << std::setw(32) << figure.name << std::right << std::setw(12) << digits(figure.found)
          << std::setw(12) << (figure.truth ? digits(*figure.truth) : "") << std::setw(10)
          << percent(relative_error(figure)) << "  " << figure.unit;
      if (figure.deviation) out << ", +- " << digits(*figure.deviation);
      out << '\n';
    }
  }
}

std::string as_json(const std::vector<CalibrationSection>& sections) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (const auto& [title, notes, figures] : sections) {
    Json list = Json::array();
    for (const CalibrationFigure& figure : figures) {
      Json entry{{"name", figure.name}, {"found", figure.found}, {"unit", figure.unit}};
      if (figure.truth) entry["truth"] = *figure.truth;
      if (const auto error = relative_error(figure)) entry["relative_error"] = *error;
      if (figure.deviation) entry["deviation"] = *figure.deviation;
      list.push_back(entry);
    }
    all.push_back({{"title", title}, {"notes", notes}, {"figures", list}});
  }
  return Json{{"sections", all}}.dump(2) + '\n';
}

}  // namespace limpid::examples
