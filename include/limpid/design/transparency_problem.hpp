// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/haptic_wall.hpp>
#include <limpid/design/state_space.hpp>

#include <cmath>
#include <complex>
#include <string_view>

namespace limpid {

/// What stands for the hold of the digital-to-analogue converter. The paper asks for unit gain at zero and 90 degrees
/// of lag at the Nyquist frequency, which both rational models have; which of them it took it does not say.
enum class HoldModel {
  second_order,  ///< A: w_n^2/(s^2 + sqrt(2) w_n s + w_n^2), w_n = pi/T
  first_order,   ///< B: (2/T)/(s + 2/T); 57.5 degrees at Nyquist
  exact,         ///< C: (1 - exp(-s T))/(s T)
};

[[nodiscard]] constexpr std::string_view describe(HoldModel hold) noexcept {
  switch (hold) {
    case HoldModel::second_order:
      return "A, second order";
    case HoldModel::first_order:
      return "B, first order";
    default:
      return "C, exact";
  }
}

/// The haptic interface of Fig. 3 of Eom, Suh and Yi: a device, the wall to be felt through it, the hold between them.
template <Real Scalar = double>
struct TransparencyProblem {
  HapticPlant<Scalar> plant{};               ///< P(s), (7)
  VirtualWall<Scalar> wall{};                ///< V(s), (8)
  Scalar period{0};                          ///< T of the controller, s, > 0
  HoldModel hold = HoldModel::second_order;  ///< ZOH(s)
  StateSpace<Scalar> weight{};             ///< w1(s) of (11), one input, one output, continuous; see first_order_weight
  PlantUncertainty<Scalar> uncertainty{};  ///< alpha and beta of (13), for W(s) = alpha m s + beta b, (15)

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    plant.check();
    wall.check();
    expect(is_finite(period) && period > Scalar{0}, "TransparencyProblem: period", "finite and > 0", period);
    expect(hold == HoldModel::second_order || hold == HoldModel::first_order || hold == HoldModel::exact,
           "TransparencyProblem: hold", "a HoldModel", static_cast<int>(hold));
    weight.check();
    expect(weight.inputs() == 1 && weight.outputs() == 1 && !weight.is_discrete(), "TransparencyProblem: weight",
           "continuous, one input, one output", weight.D);
    uncertainty.check();
  }
};

namespace detail {

template <Real Scalar>
void check(const TransparencyProblem<Scalar>& problem, const WallFeedback<Scalar>& C) {
  problem.check();
  C.check();
}

/// (1 - exp(-i omega T))/(i omega T)
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> exact_hold(const Scalar& omega, const Scalar& period) {
  using std::cos, std::sin;
  const Scalar half = omega * period / Scalar{2};
  if (half == Scalar{0}) return {Scalar{1}, Scalar{0}};
  const Scalar size = sin(half) / half;
  return {size * cos(half), -size * sin(half)};
}

/// ZOH(i omega)
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> hold_response(HoldModel hold, const Scalar& omega, const Scalar& period) {
  using std::acos, std::sqrt;
  using Complex = std::complex<Scalar>;
  if (hold == HoldModel::exact) return exact_hold(omega, period);
  if (hold == HoldModel::first_order) return Complex(Scalar{1}) / Complex(Scalar{1}, omega * period / Scalar{2});
  const Scalar x = omega * period / acos(Scalar{-1});
  return Complex(Scalar{1}) / Complex(Scalar{1} - x * x, sqrt(Scalar{2}) * x);
}

/// s times the characteristic function 1/P + ZOH C at s = i omega: s (m s + b) + ZOH (B_c s + K_c)
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> characteristic(const TransparencyProblem<Scalar>& problem,
                                                  const WallFeedback<Scalar>& C, const Scalar& omega) {
  using Complex = std::complex<Scalar>;
  const auto& [m, b] = problem.plant;
  return Complex(-m * omega * omega, b * omega) +
         hold_response(problem.hold, omega, problem.period) * Complex(C.K_c, C.B_c * omega);
}

}  // namespace detail

/// Y_v(i omega) = s/(K + B s), m/(N s): the wall's admittance. Eq. (8) prints its impedance.
/// @throws std::invalid_argument  where the wall is refused or omega is not finite
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> wall_admittance(const VirtualWall<Scalar>& wall, const Scalar& omega) {
  wall.check();
  expect(is_finite(omega), "wall_admittance: omega", "finite", omega);
  return std::complex<Scalar>(Scalar{0}, omega) / std::complex<Scalar>(wall.stiffness, wall.damping * omega);
}

/// Y_t(i omega) = P/(1 + ZOH P C), (9), m/(N s): what the hand feels. Not finite where a pole is on the axis there.
/// @throws std::invalid_argument  where an argument is refused or omega is not finite
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> transmitted_admittance(const TransparencyProblem<Scalar>& problem,
                                                          const WallFeedback<Scalar>& C, const Scalar& omega) {
  detail::check(problem, C);
  expect(is_finite(omega), "transmitted_admittance: omega", "finite", omega);
  return std::complex<Scalar>(Scalar{0}, omega) / detail::characteristic(problem, C, omega);
}

/// L(i omega) = -W P/(1 + ZOH P C), (16): from the uncertainty to itself. Not finite where a pole is on the axis there.
/// @throws std::invalid_argument  where an argument is refused or omega is not finite
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> uncertainty_response(const TransparencyProblem<Scalar>& problem,
                                                        const WallFeedback<Scalar>& C, const Scalar& omega) {
  detail::check(problem, C);
  expect(is_finite(omega), "uncertainty_response: omega", "finite", omega);
  const auto& [m, b] = problem.plant;
  const auto& [alpha, beta] = problem.uncertainty;
  // -s (alpha m s + beta b)
  return std::complex<Scalar>(alpha * m * omega * omega, -beta * b * omega) / detail::characteristic(problem, C, omega);
}

}  // namespace limpid
