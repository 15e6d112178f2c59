// SPDX-License-Identifier: MIT
#include "decouple_device.hpp"

#include <limpid/core/held_step.hpp>
#include <limpid/device/simulated_five_bar.hpp>
#include <limpid/robot/cartesian_dynamics.hpp>

#include <Eigen/LU>

#include <complex>
#include <numbers>
#include <stdexcept>

namespace limpid::examples {

namespace {

using Complex = std::complex<double>;
using ComplexMatrix2 = Eigen::Matrix<Complex, 2, 2>;

// Calls `f` with the filter of that kind.
template <typename F>
auto with_filter(QKind kind, double cutoff, F&& f) {
  switch (kind) {
    case QKind::butterworth:
      return f(ButterworthQ<>{.cutoff = cutoff});
    case QKind::umeno_hori:
      return f(UmenoHoriQ<>{.cutoff = cutoff});
    default:
      return f(FirstOrderQ<>{.cutoff = cutoff});
  }
}

template <std::size_t size>
Complex polynomial(const std::array<double, size>& p, Complex at) {
  Complex value = 0;
  for (std::size_t i = size; i-- > 0;) value = value * at + p[i];
  return value;
}

Complex point(const ObservedPlant<2>& plant, double hertz) {
  return std::polar(1.0, 2 * std::numbers::pi * hertz * plant.period);
}

// From the held force to the velocity at the ticks: (z I - Phi)^-1 Gamma
ComplexMatrix2 sampled_response(const ObservedPlant<2>& plant, Complex z) {
  const Eigen::Matrix2d inverse = plant.M.inverse();
  const auto exact = held_step(Eigen::Matrix2d(-inverse * plant.B), plant.period);
  const ComplexMatrix2 pencil = z * ComplexMatrix2::Identity() - exact.Phi.cast<Complex>();
  return pencil.inverse() * (exact.Psi * inverse).cast<Complex>();
}

}  // namespace

std::string_view name(QKind kind) {
  constexpr std::array<std::string_view, 3> names{"first", "butterworth", "q31"};
  return names[static_cast<std::size_t>(kind)];
}

QKind q_kind(const std::string& typed) {
  for (const QKind kind : q_kinds) {
    if (name(kind) == typed) return kind;
  }
  throw std::invalid_argument("--filter: accepts first, butterworth or q31, got " + typed);
}

ObservedPlant<2> linear_five_bar() {
  const FiveBar<> robot;
  const auto tip = cartesian_dynamics(robot, robot.theta_of({}), {SimulatedFiveBar<>::start_pose(), {0, 0}});
  ObservedPlant<2> plant;
  plant.M = (tip.M_x + tip.M_x.transpose()) / 2;
  plant.B = tip.B_x;
  plant.mass.setConstant(nominal_mass);
  plant.damping.setConstant(nominal_damping);
  return plant;
}

double coupling_without_observer(const ObservedPlant<2>& plant, double hertz) {
  const ComplexMatrix2 G = sampled_response(plant, point(plant, hertz));
  return std::abs(G(1, 0) / G(0, 0));
}

std::optional<double> coupling(const ObservedPlant<2>& plant, QKind kind, double cutoff, double hertz) {
  return with_filter(kind, cutoff, [&](const auto& filter) -> std::optional<double> {
    if (!(observed_radius(plant, filter, ObserverForm::tustin, cutoff) < 1)) return {};
    const Complex z = point(plant, hertz), s = 2 / plant.period * (z - 1.0) / (z + 1.0);
    const Complex at = s * filter.time_constant();
    const Complex Q = polynomial(filter.numerator(), at) / polynomial(filter.denominator(), at);
    // F = hand + Q [F - P_n^-1 v],  v = G F
    const ComplexMatrix2 G = sampled_response(plant, z);
    const ComplexMatrix2 loop = (1.0 - Q) * ComplexMatrix2::Identity() + Q * (nominal_mass * s + nominal_damping) * G;
    const ComplexMatrix2 response = G * loop.inverse();
    return std::abs(response(1, 0) / response(0, 0));
  });
}

CutoffLimit<> cutoff_limit(const ObservedPlant<2>& plant, QKind kind) {
  return with_filter(kind, 1,
                     [&](const auto& filter) { return observer_cutoff_limit(plant, filter, ObserverForm::tustin); });
}

}  // namespace limpid::examples
