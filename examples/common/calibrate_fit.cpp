// SPDX-License-Identifier: MIT
// The least squares behind the tuning run.
#include "calibrate_tuning.hpp"

#include <limpid/core/expect.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace limpid::examples {

namespace {

constexpr std::size_t half = 60, stride = 10;     // samples of 1 ms: of a window, between two
constexpr int unknowns = Omni<>::parameters + 3;  // theta, and the friction of each joint
using Unknowns = Eigen::Matrix<double, unknowns, 1>;
using Information = Eigen::Matrix<double, unknowns, unknowns>;

// A window's q, q', q'' and torque in its middle, by cubics; s as unit of time makes the normal equations sound.
class Window {
 public:
  Window(const std::vector<TuningSample>& record, std::size_t middle) {
    const double t0 = record[middle].time, span = record[middle + half].time - t0;
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, 6> sums = Eigen::Matrix<double, 4, 6>::Zero();
    for (std::size_t i = middle - half; i <= middle + half; ++i) {
      const double s = (record[i].time - t0) / span;
      const Eigen::Vector4d powers(1, s, s * s, s * s * s);
      Eigen::Matrix<double, 1, 6> values;
      values << record[i].q.transpose(), (record[i - 1].torque + record[i].torque).transpose() / 2;
      information += powers * powers.transpose();
      sums += powers * values;
    }
    const Eigen::Matrix<double, 4, 6> cubic = information.ldlt().solve(sums);
    q = cubic.row(0).head<3>().transpose();
    qdot = cubic.row(1).head<3>().transpose() / span;
    qddot = 2 * cubic.row(2).head<3>().transpose() / (span * span);
    torque = cubic.row(0).tail<3>().transpose();
    reach = span;
  }

  // Whether the joint goes one way, and not slowly, all the time.
  [[nodiscard]] bool one_way(int joint) const {
    const double least = std::abs(qdot[joint]) - std::abs(qddot[joint]) * reach;
    return least > 0.1;  // rad/s: after a reversal a way of several bendings of Dahl's friction
  }

  Eigen::Vector3d q, qdot, qddot, torque;
  double reach;  // half of its length, s
};

struct Row {
  Unknowns phi;
  double torque;
};

std::vector<Row> rows_of(const std::vector<TuningSample>& record) {
  const Omni<> model;
  std::vector<Row> rows;
  for (std::size_t middle = half + 1; middle + half < record.size(); middle += stride) {
    const Window window(record, middle);
    const auto phi = model.at(window.q).regressor(window.qdot, window.qddot);
    for (int joint = 0; joint < 3; ++joint) {
      if (!window.one_way(joint)) continue;
      Row row{Unknowns::Zero(), window.torque[joint]};
      row.phi.head<Omni<>::parameters>() = phi.row(joint).transpose();
      row.phi[Omni<>::parameters + joint] = window.qdot[joint] > 0 ? 1 : -1;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

TuningResult evaluate_tuning(const std::vector<TuningSample>& record) {
  const double length = record.empty() ? 0 : record.back().time - record.front().time;
  expect(length >= 10, "evaluate_tuning: record", "10 s or more", length);
  TuningResult result{};
  double counted = 0;
  for (const TuningSample& sample : record) {
    if (sample.time >= length / 3) result.bound = result.bound.cwiseMax(sample.error.cwiseAbs());
    if (sample.time < 2 * length / 3) continue;
    result.adapted += sample.theta_hat;
    ++counted;
  }
  result.adapted /= counted;

  const std::vector<Row> rows = rows_of(record);
  Information information = Information::Zero();
  Unknowns sum = Unknowns::Zero();
  for (const Row& row : rows) {
    information += row.phi * row.phi.transpose();
    sum += row.phi * row.torque;
  }
  const Unknowns scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Information> factor(Information(scale.asDiagonal() * information * scale.asDiagonal()));
  expect(rows.size() > 10 * unknowns && factor.info() == Eigen::Success, "evaluate_tuning: record",
         "motion of all joints", rows.size());
  const Unknowns found = scale.cwiseProduct(factor.solve(scale.cwiseProduct(sum)));
  double squares = 0;
  for (const Row& row : rows) squares += std::pow(row.phi.dot(found) - row.torque, 2);
  const double variance = squares / static_cast<double>(rows.size() - unknowns);
  const Unknowns covariance = factor.solve(Information::Identity()).diagonal().cwiseProduct(scale).cwiseProduct(scale);
  const Unknowns deviation = (variance * covariance).cwiseSqrt();
  result.fitted = found.head<Omni<>::parameters>();
  result.deviation = deviation.head<Omni<>::parameters>();
  result.friction = found.tail<3>();
  result.friction_deviation = deviation.tail<3>();
  result.residual = std::sqrt(variance);
  return result;
}

}  // namespace limpid::examples
