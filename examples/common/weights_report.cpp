// SPDX-License-Identifier: MIT
#include "weights_report.hpp"

#include "words.hpp"

#include <limpid/device/force_calibration.hpp>

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;
using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

std::string row_of(const char* name, const Vector& values, const char* unit) {
  return words("  %-22s %11.5g %11.5g %11.5g  %s\n", name, values[0], values[1], values[2], unit);
}

std::string matrix_of(const Matrix& matrix) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::string("force along ") + "xyz"[i];
    text += row_of(name.c_str(), matrix.row(i), "");
  }
  return text;
}

Json as_json(const Vector& values) { return {values[0], values[1], values[2]}; }

Json as_json(const Matrix& matrix) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(as_json(Vector(matrix.row(i))));
  return rows;
}

// What is left of the cross-talk of a sensor that is known.
double cross_talk_left(const CalibrationFindings& found) {
  return cross_talk((found.fit.newtons_per_count * found.truth->counts_per_newton).eval());
}

std::string words_of_truth(const CalibrationFindings& found) {
  const SimulatedWeights& truth = *found.truth;
  const Matrix M = truth.counts_per_newton.inverse(), error = (found.fit.newtons_per_count - M).cwiseAbs();
  return "the simulated sensor's own matrix, N by 1000 counts\n" + matrix_of(1000 * M) +
         row_of("offset", truth.offset, "counts") +
         words("largest error of an entry: %.2g of its standard deviations\n",
               error.cwiseQuotient(found.fit.deviation).maxCoeff()) +
         words("cross-talk that the fitted matrix leaves: %.3g %% of a force\n", 100 * cross_talk_left(found));
}

}  // namespace

std::string words_of(const CalibrationFindings& found) {
  const CalibrationFit<>& fit = found.fit;
  std::string text = words("%zu loads, condition %.3g; of the sensitivities %.3g\n", found.loads, fit.loads_condition,
                           fit.sensitivity_condition);
  text += "matrix, N by 1000 counts\n" + matrix_of(1000 * fit.newtons_per_count);
  text += "standard deviations of its entries\n" + matrix_of(1000 * fit.deviation);
  text += row_of("offset", fit.offset, "counts") + row_of("its deviation", fit.offset_deviation, "counts");
  text += row_of("sensitivity", fit.counts_per_newton.diagonal(), "counts/N");
  text += row_of("residual, rms", fit.residual_rms, "N") + row_of("residual, largest", fit.residual_largest, "N");
  text += words("cross-talk that the matrix takes off: %.3g %% of a force\n", 100 * cross_talk(fit.counts_per_newton));
  return found.truth ? text + words_of_truth(found) : text;
}

Json as_json(const WeightsOptions& options, const CalibrationFindings& found) {
  const CalibrationFit<>& fit = found.fit;
  Json json{{"newtons_per_count", as_json(fit.newtons_per_count)},
            {"offset", as_json(fit.offset)},
            {"lever_gain", options.lever_gain},
            {"lever_arm", options.lever_arm},
            {"loads", found.loads},
            {"residual", {{"rms", as_json(fit.residual_rms)}, {"largest", as_json(fit.residual_largest)}}},
            {"deviation", as_json(fit.deviation)},
            {"offset_deviation", as_json(fit.offset_deviation)},
            {"counts_per_newton", as_json(fit.counts_per_newton)},
            {"cross_talk", cross_talk(fit.counts_per_newton)},
            {"loads_condition", fit.loads_condition},
            {"sensitivity_condition", fit.sensitivity_condition}};
  if (found.truth) {
    json["truth"] = {{"newtons_per_count", as_json(Matrix(found.truth->counts_per_newton.inverse()))},
                     {"offset", as_json(found.truth->offset)},
                     {"cross_talk_left", cross_talk_left(found)}};
  }
  return json;
}

}  // namespace limpid::examples
