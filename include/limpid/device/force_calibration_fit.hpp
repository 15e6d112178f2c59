// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/device/force_calibration.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <cstddef>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <type_traits>

namespace limpid {

/// One weight on the sensor.
template <Real Scalar = double>
struct CalibrationLoad {
  Eigen::Matrix<Scalar, 3, 1> force = Eigen::Matrix<Scalar, 3, 1>::Zero();   ///< known, N, in the sensor's frame
  Eigen::Matrix<Scalar, 3, 1> counts = Eigen::Matrix<Scalar, 3, 1>::Zero();  ///< what it gave, a mean where it can be
};

/// How the weights were hung, and what is accepted of them.
template <Real Scalar = double>
struct CalibrationFitSettings {
  /// where the weights acted, as in ForceCalibration; the fitted matrix is for r = 0
  Eigen::Matrix<Scalar, 3, 1> lever_gain = Eigen::Matrix<Scalar, 3, 1>::Constant(ForceCalibration<Scalar>::a_m());
  Scalar lever_arm = Scalar(0);  ///< r, m
  /// of the loads about their mean, and of the sensitivities: largest singular value over the smallest, > 1
  Scalar largest_condition = Scalar(100);
};

enum class CalibrationOutcome {
  fitted,
  not_finite,   ///< a load or a count
  too_few,      ///< loads: less than five, four of which any matrix and offset fit
  flat_loads,   ///< which leave a direction out: the force along it cannot be told
  flat_counts,  ///< which are the same for different forces: the sensor, or an axis of it, does not answer
};

/// A calibration and how good it is. Where it is not fitted, numbers are NaN beyond what was found out.
template <Real Scalar = double>
struct CalibrationFit {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  static constexpr Scalar unknown = std::numeric_limits<Scalar>::quiet_NaN();

  CalibrationOutcome outcome = CalibrationOutcome::fitted;
  std::string reason{};  ///< why it is not fitted

  Matrix newtons_per_count = Matrix::Constant(unknown);  ///< M
  Vector offset = Vector::Constant(unknown);             ///< c0, counts
  Matrix counts_per_newton = Matrix::Constant(unknown);  ///< M^-1, what was fitted: row i is what channel i shows

  Vector residual_rms = Vector::Constant(unknown);      ///< F(c) less the load, over all loads, N
  Vector residual_largest = Vector::Constant(unknown);  ///< in magnitude, N

  Matrix deviation = Matrix::Constant(unknown);         ///< standard deviations of M's entries, N by count
  Vector offset_deviation = Vector::Constant(unknown);  ///< of c0's, counts

  Scalar loads_condition = unknown;        ///< largest singular value over the smallest
  Scalar sensitivity_condition = unknown;  ///< the same of M^-1

  [[nodiscard]] bool is_fitted() const noexcept { return outcome == CalibrationOutcome::fitted; }
};

namespace detail {

// Loads as F_meas and their counts, a row each, about their means.
template <Real Scalar>
struct CentredLoads {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, 3>;

  CentredLoads(std::span<const CalibrationLoad<Scalar>> loads, const Vector& lever)
      : F(static_cast<Eigen::Index>(loads.size()), 3), C(F.rows(), 3) {
    for (Eigen::Index k = 0; k < F.rows(); ++k) {
      F.row(k) = loads[static_cast<std::size_t>(k)].force.cwiseProduct(lever);
      C.row(k) = loads[static_cast<std::size_t>(k)].counts;
    }
    F_mean = F.colwise().mean();
    C_mean = C.colwise().mean();
    F.rowwise() -= F_mean.transpose();
    C.rowwise() -= C_mean.transpose();
  }

  Rows F, C;
  Vector F_mean, C_mean;
};

template <Real Scalar>
[[nodiscard]] Scalar condition(const Eigen::Matrix<Scalar, 3, 3>& matrix) {
  const Eigen::Matrix<Scalar, 3, 1> sizes = Eigen::JacobiSVD<Eigen::Matrix<Scalar, 3, 3>>(matrix).singularValues();
  return sizes[2] > Scalar(0) ? Scalar(sizes[0] / sizes[2]) : std::numeric_limits<Scalar>::infinity();
}

template <Real Scalar, typename Actual>
CalibrationFit<Scalar> not_fitted(CalibrationFit<Scalar> fit, CalibrationOutcome outcome, const char* expected,
                                  const Actual& actual) {
  std::ostringstream text;
  text << "expected " << expected << ", got " << actual;
  fit.outcome = outcome;
  fit.reason = text.str();
  return fit;
}

// Residuals and standard deviations of what was fitted; R of F = Q R.
template <Real Scalar>
void judge(CalibrationFit<Scalar>& fit, const CentredLoads<Scalar>& loads, const Eigen::Matrix<Scalar, 3, 3>& R,
           const Eigen::Matrix<Scalar, 3, 1>& lever) {
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Rows = typename CentredLoads<Scalar>::Rows;
  const Matrix &M = fit.newtons_per_count, &S = fit.counts_per_newton;
  const auto n = static_cast<Scalar>(loads.F.rows());
  const Rows left = loads.C - loads.F * S.transpose();  // counts
  const Rows newtons = left * M.transpose() * lever.cwiseInverse().asDiagonal();
  fit.residual_rms = (newtons.colwise().squaredNorm() / n).cwiseSqrt();
  fit.residual_largest = newtons.cwiseAbs().colwise().maxCoeff();

  const Matrix noise = left.transpose() * left / (n - Scalar(4));  // covariance of the channels, counts^2
  const Matrix R_inverse = R.inverse(), G = R_inverse * R_inverse.transpose();
  // dM = -M dS M, and cov(dS_ij, dS_kl) = noise_ik G_jl
  const Eigen::Matrix<Scalar, 3, 1> across = (M * noise * M.transpose()).diagonal();
  const Eigen::Matrix<Scalar, 3, 1> along = (M.transpose() * G * M).diagonal();
  fit.deviation = (across * along.transpose()).cwiseSqrt();
  const Scalar of_mean = Scalar(1) / n + loads.F_mean.dot(G * loads.F_mean);
  fit.offset_deviation = (noise.diagonal() * of_mean).cwiseSqrt();
}

}  // namespace detail

/// Matrix and offset from weights in known directions, by least squares on c = S F_meas + c0, M = S^-1: the loads are
/// known, it is the counts that are noisy. Deviations are those of noise that is the same for all loads, channels may
/// share it, to its first order in M.
/// @throws std::invalid_argument  where the settings cannot serve
template <Real Scalar = double>
[[nodiscard]] CalibrationFit<Scalar> fit_force_calibration(
    std::type_identity_t<std::span<const CalibrationLoad<Scalar>>> loads,
    const CalibrationFitSettings<Scalar>& settings = CalibrationFitSettings<Scalar>{}) {
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  expect(settings.largest_condition > Scalar(1), "CalibrationFitSettings: largest_condition", "> 1",
         settings.largest_condition);
  typename ForceCalibration<Scalar>::Settings levers;
  levers.lever_gain = settings.lever_gain;
  levers.lever_arm = settings.lever_arm;
  const Eigen::Matrix<Scalar, 3, 1> lever = ForceCalibration<Scalar>::lever(levers);

  CalibrationFit<Scalar> fit;
  if (loads.size() < 5) return detail::not_fitted(fit, CalibrationOutcome::too_few, "5 loads or more", loads.size());
  const detail::CentredLoads<Scalar> centred(loads, lever);
  if (!is_finite(centred.F) || !is_finite(centred.C)) {
    return detail::not_fitted(fit, CalibrationOutcome::not_finite, "finite forces and counts", "others");
  }
  const Eigen::HouseholderQR<typename detail::CentredLoads<Scalar>::Rows> qr(centred.F);
  const Matrix R = qr.matrixQR().template topRows<3>().template triangularView<Eigen::Upper>();
  fit.loads_condition = detail::condition<Scalar>(R);
  if (!(fit.loads_condition <= settings.largest_condition)) {
    return detail::not_fitted(fit, CalibrationOutcome::flat_loads,
                              "loads in three directions, whose condition number is at most largest_condition",
                              fit.loads_condition);
  }
  const Matrix S = Matrix(qr.solve(centred.C)).transpose();
  fit.sensitivity_condition = detail::condition<Scalar>(S);
  if (!(fit.sensitivity_condition <= settings.largest_condition)) {
    return detail::not_fitted(fit, CalibrationOutcome::flat_counts,
                              "counts that tell forces apart, by sensitivities whose condition number is at most "
                              "largest_condition",
                              fit.sensitivity_condition);
  }
  fit.counts_per_newton = S;
  fit.newtons_per_count = S.inverse();
  fit.offset = centred.C_mean - S * centred.F_mean;
  detail::judge(fit, centred, R, lever);
  return fit;
}

}  // namespace limpid
