// SPDX-License-Identifier: MIT
#include <limpid/device/force_calibration_fit.hpp>

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

using limpid::CalibrationFit;
using limpid::CalibrationFitSettings;
using limpid::CalibrationLoad;
using limpid::CalibrationOutcome;
using limpid::fit_force_calibration;
using limpid::ForceCalibration;

namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
using Loads = std::vector<CalibrationLoad<>>;

// Table 5.5 with cross-talk up to what section 5.3.3 names: 85 % on z of a load along x.
Matrix sensor() {
  Matrix S;
  S << 1087.4, 60, 8, -75, -1089.1, -6, 102, 9, 120.5;
  return S;
}
const Vector offset{120, -340, 55};

// The weights of section 5.3.3: -5 to 5 N along x and y, -5 to 8 N along z, each twice.
std::vector<Vector> weights() {
  std::vector<Vector> forces;
  for (int twice = 0; twice < 2; ++twice) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int newtons = -5; newtons <= (axis == 2 ? 8 : 5); ++newtons) forces.push_back(newtons * Vector::Unit(axis));
    }
  }
  return forces;
}

template <typename Noise>
Loads hang(const std::vector<Vector>& forces, Noise&& noise) {
  Loads loads;
  for (const Vector& force : forces) loads.push_back({force, sensor() * force + offset + noise()});
  return loads;
}

Loads hang(const std::vector<Vector>& forces) {
  return hang(forces, [] { return Vector(0, 0, 0); });
}

}  // namespace

TEST_CASE("without noise matrix and offset are those of the sensor") {
  const CalibrationFit<> fit = fit_force_calibration(hang(weights()));
  REQUIRE(fit.is_fitted());
  // roundings of 5000 counts over forces of 5 N, and the condition of the sensor, 10
  CHECK((fit.counts_per_newton - sensor()).cwiseAbs().maxCoeff() < 1e-11);
  CHECK((fit.newtons_per_count * sensor() - Matrix::Identity()).cwiseAbs().maxCoeff() < 1e-13);
  CHECK((fit.offset - offset).norm() < 1e-11);
  CHECK(fit.residual_largest.maxCoeff() < 1e-13);
  CHECK(fit.reason.empty());
}

TEST_CASE("residual and deviations are those worked out by hand") {
  // One newton to each side of each axis; channel x errs by d on both of its own weights and by -d/2 on the others,
  // which is at right angles to all that is fitted: sensitivities s and offset stay, d is left.
  const Vector s(1000, -500, 100);
  const double d = 6;
  Loads loads;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      const Vector force = side * Vector::Unit(axis);
      loads.push_back({force, s.cwiseProduct(force) + offset + Vector(axis == 0 ? d : -d / 2, 0, 0)});
    }
  }
  const CalibrationFit<> fit = fit_force_calibration(loads);
  REQUIRE(fit.is_fitted());
  CHECK((fit.counts_per_newton - Matrix(s.asDiagonal())).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((fit.offset - offset).norm() < 1e-12);
  CHECK(fit.residual_largest[0] == doctest::Approx(d / 1000).epsilon(1e-12));
  CHECK(fit.residual_rms[0] == doctest::Approx(d / 1000 / std::sqrt(2)).epsilon(1e-12));  // of (2 + 4/4) d^2/6
  CHECK(fit.residual_largest.tail<2>().maxCoeff() < 1e-15);
  // variance 3 d^2/(6 - 4), F'F = 2 I: a sensitivity varies by sqrt(3)/2 d, and 1/s with it
  for (int j = 0; j < 3; ++j) {
    CHECK(fit.deviation(0, j) == doctest::Approx(std::sqrt(3) / 2 * d / 1000 / std::abs(s[j])).epsilon(1e-12));
  }
  CHECK(fit.deviation.bottomRows<2>().maxCoeff() < 1e-15);
  CHECK(fit.offset_deviation[0] == doctest::Approx(d / 2).epsilon(1e-12));  // sqrt(3/2 d^2/6)
  CHECK(fit.loads_condition == doctest::Approx(1).epsilon(1e-12));
  CHECK(fit.sensitivity_condition == doctest::Approx(10).epsilon(1e-12));
}

TEST_CASE("the deviations it tells are those that fits of many noisy sets have") {
  constexpr int sets = 4000;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const std::vector<Vector> forces = weights();
  const Matrix truth = sensor().inverse();
  Matrix square = Matrix::Zero(), told = Matrix::Zero(), sum = Matrix::Zero();
  Vector offset_square = Vector::Zero(), offset_told = Vector::Zero();
  for (int k = 0; k < sets; ++k) {
    const CalibrationFit<> fit = fit_force_calibration(hang(forces, [&] {
      const double shared = normal(random);
      return Vector(10 * normal(random) + 8 * shared, 6 * shared + 3 * normal(random), 4 * normal(random));
    }));
    REQUIRE(fit.is_fitted());
    const Matrix error = fit.newtons_per_count - truth;
    sum += error;
    square += error.cwiseAbs2();
    told += fit.deviation.cwiseAbs2();
    offset_square += (fit.offset - offset).cwiseAbs2();
    offset_told += fit.offset_deviation.cwiseAbs2();
  }
  // a variance of n sets is known to sqrt(2/n) = 2.2 %: five times that
  CHECK((square.cwiseQuotient(told) - Matrix::Ones()).cwiseAbs().maxCoeff() < 0.11);
  CHECK((offset_square.cwiseQuotient(offset_told) - Vector::Ones()).cwiseAbs().maxCoeff() < 0.11);
  // and the mean error is zero, to five of its deviations
  CHECK((sum.cwiseAbs().array() < 5 * square.array().sqrt()).all());
}

TEST_CASE("weights at a distance give the matrix of the flange") {
  CalibrationFitSettings<> settings;
  settings.lever_arm = 0.073;
  Loads loads = hang(weights());
  for (auto& load : loads) load.force /= 1 + 39.65 * 0.073;  // more counts than that force gives at the flange
  const CalibrationFit<> fit = fit_force_calibration(loads, settings);
  REQUIRE(fit.is_fitted());
  CHECK((fit.counts_per_newton - sensor()).cwiseAbs().maxCoeff() < 1e-11);
  ForceCalibration<>::Settings calibration;
  calibration.newtons_per_count = fit.newtons_per_count;
  calibration.offset = fit.offset;
  calibration.lever_arm = 0.073;
  for (const auto& load : loads)
    CHECK((ForceCalibration<>(calibration).force(load.counts) - load.force).norm() < 1e-12);
}

TEST_CASE("four loads or fewer are too few") {
  Loads loads = hang({Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1), Vector(0, 0, 0)});
  const CalibrationFit<> fit = fit_force_calibration(loads);
  CHECK(fit.outcome == CalibrationOutcome::too_few);
  CHECK(fit.reason == "expected 5 loads or more, got 4");
  CHECK(!fit.newtons_per_count.allFinite());
  CHECK(fit_force_calibration(Loads{}).outcome == CalibrationOutcome::too_few);
  loads.push_back({Vector(1, 1, 1), sensor() * Vector(1, 1, 1) + offset});
  CHECK(fit_force_calibration(loads).is_fitted());
}

TEST_CASE("loads that leave a direction out are told so") {
  const std::vector<std::vector<Vector>> sets{
      {Vector(1, 0, 0), Vector(2, 0, 0), Vector(0, 1, 0), Vector(0, 2, 0), Vector(1, 1, 0)},  // in a plane
      {Vector(1, 0, 1), Vector(2, 0, 0), Vector(0, 2, 0), Vector(0, 0, 2), Vector(1, 1, 0)},  // x + y + z = 2
      {Vector(1, 0, 0), Vector(2, 0, 0), Vector(3, 0, 0), Vector(4, 0, 0), Vector(5, 0, 0)},
      {Vector(1, 1, 1), Vector(1, 1, 1), Vector(1, 1, 1), Vector(1, 1, 1), Vector(1, 1, 1)},
  };
  for (const auto& forces : sets) {
    const CalibrationFit<> fit = fit_force_calibration(hang(forces));
    CHECK(fit.outcome == CalibrationOutcome::flat_loads);
    CHECK(fit.loads_condition > 1e10);
    CHECK(fit.reason.find("expected loads in three directions") == 0);
  }
}

TEST_CASE("nearly flat loads are refused by the condition that is asked for") {
  const Loads loads = hang(
      {Vector(1, 0, 0), Vector(-1, 0, 0), Vector(0, 1, 0), Vector(0, -1, 0), Vector(0, 0, 0.02), Vector(0, 0, -0.02)});
  CHECK(!fit_force_calibration(loads, {.largest_condition = 49.0}).is_fitted());
  CHECK(fit_force_calibration(loads, {.largest_condition = 51.0}).is_fitted());
}

TEST_CASE("a channel that does not answer is told so") {
  Loads loads = hang(weights());
  for (auto& load : loads) load.counts[2] = 55;
  const CalibrationFit<> fit = fit_force_calibration(loads);
  CHECK(fit.outcome == CalibrationOutcome::flat_counts);
  CHECK(fit.reason.find("expected counts that tell forces apart") == 0);
  CHECK(!fit.newtons_per_count.allFinite());
}

TEST_CASE("loads that are not finite are told so, and settings that cannot serve refused") {
  Loads loads = hang(weights());
  loads[7].counts[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(fit_force_calibration(loads).outcome == CalibrationOutcome::not_finite);
  CHECK_THROWS_AS((void)fit_force_calibration(hang(weights()), {.largest_condition = 1.0}), std::invalid_argument);
  CHECK_THROWS_AS((void)fit_force_calibration(hang(weights()), {.lever_arm = -1.0}), std::invalid_argument);
}

TEST_CASE_TEMPLATE("other scalars are fitted, too", Scalar, float, long double) {
  std::vector<CalibrationLoad<Scalar>> loads;
  for (const auto& load : hang(weights())) loads.push_back({load.force.cast<Scalar>(), load.counts.cast<Scalar>()});
  const CalibrationFit<Scalar> fit = fit_force_calibration<Scalar>(loads);
  REQUIRE(fit.is_fitted());
  const Matrix product = fit.newtons_per_count.template cast<double>() * sensor();
  // roundings of the scalar times the condition of the sensor, 10, and some; the double's own
  CHECK((product - Matrix::Identity()).cwiseAbs().maxCoeff() < 100 * std::numeric_limits<Scalar>::epsilon() + 1e-13);
}
