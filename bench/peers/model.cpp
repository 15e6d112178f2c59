// SPDX-License-Identifier: MIT
#include "peers/model.hpp"

#include <cmath>
#include <random>

namespace limpid::bench {

namespace {

using Eigen::Vector3d;

const double quarter = std::acos(0.0);
const Vector3d down(0, 0, -9.81);

Body rod_along_x(double mass, double length) {
  const double across = mass * length * length / 12;
  return {mass, Vector3d(length / 2, 0, 0), Vector3d(0, across, across).asDiagonal()};
}

Body box(double mass, const Vector3d& centre, const Vector3d& sides) {
  const Vector3d squares = sides.cwiseAbs2();
  return {mass, centre, (mass / 12 * (Vector3d::Constant(squares.sum()) - squares)).asDiagonal()};
}

}  // namespace

ArmModel omni_model() {
  constexpr double l2 = 0.135, l3 = 0.130, I1 = 3.7e-3;  // Table 5.2
  return {.name = "Omni",
          .rows = {{.alpha = 0}, {.alpha = quarter}, {.a = l2}},
          .bodies = {{1.0, Vector3d::Zero(), Vector3d(I1 / 2, I1 / 2, I1).asDiagonal()},
                     rod_along_x(0.21, l2),
                     rod_along_x(0.17, l3)},
          .tip = Vector3d(l3, 0, 0),
          .gravity = down,
          .lower = Eigen::VectorXd{{-0.9, 0.1, -1.9}},  // within its limits, (5.4) among them
          .upper = Eigen::VectorXd{{0.9, 0.8, -0.7}}};
}

ArmModel puma_model() {
  return {.name = "PUMA 560, a chain of six joints",
          .rows = {{.alpha = 0},
                   {.alpha = -quarter, .d = 0.2435},
                   {.a = 0.4318, .d = -0.0934},
                   {.alpha = quarter, .a = -0.0203, .d = 0.4331},
                   {.alpha = -quarter},
                   {.alpha = quarter}},
          .bodies = {box(10, Vector3d(0, 0, 0.1), Vector3d(0.3, 0.3, 0.6)),
                     box(17, Vector3d(0.07, 0.006, 0.02), Vector3d(0.5, 0.2, 0.15)),
                     box(5, Vector3d(0, -0.1, 0.01), Vector3d(0.12, 0.4, 0.12)),
                     box(0.8, Vector3d(0, 0, 0.05), Vector3d(0.1, 0.1, 0.2)),
                     box(0.35, Vector3d(0, 0.01, 0), Vector3d(0.05, 0.06, 0.05)),
                     box(0.1, Vector3d(0, 0, 0.03), Vector3d(0.05, 0.05, 0.04))},
          .tip = Vector3d(0, 0, 0.1),
          .gravity = down,
          .lower = Eigen::VectorXd::Constant(6, -1.5),
          .upper = Eigen::VectorXd::Constant(6, 1.5)};
}

std::vector<Motion> random_motions(const ArmModel& model, unsigned seed, int count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> within_one(-1, 1);
  const auto vector = [&] {
    return Eigen::VectorXd::NullaryExpr(model.lower.size(), [&](Eigen::Index) { return within_one(random); }).eval();
  };
  std::vector<Motion> motions;
  for (int i = 0; i < count; ++i) {
    Motion motion;
    motion.q = (model.lower + model.upper + (model.upper - model.lower).cwiseProduct(vector())) / 2;
    motion.qdot = 2 * vector();
    motion.qddot = 20 * vector();
    motion.near = motion.q + 0.01 * vector();
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace limpid::bench
