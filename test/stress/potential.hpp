// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/unilateral.hpp>

#include <algorithm>
#include <cmath>

namespace limpid::stress {

/// Integral of an axis' force at rest from 0 to x, J, and the stiffest that it is up to that depth, N/m.
struct Potential {
  double energy, stiffness;
};

/// @param theta  of one axis
template <typename Theta, typename Scalar>
Potential potential_of(const KelvinVoigt<1, Scalar>&, const Theta& theta, double x) {
  const double k = double(theta[0]);
  return {k * x * x / 2, k};
}

template <typename Theta, typename Scalar>
Potential potential_of(const Unilateral<KelvinVoigt<1, Scalar>>&, const Theta& theta, double x) {
  const double k = double(theta[0]), depth = std::max(x, 0.0);
  return {k * depth * depth / 2, k};
}

/// With the exponent of `environment_of`.
template <typename Theta, typename Scalar>
Potential potential_of(const HuntCrossley<1, Scalar>&, const Theta& theta, double x) {
  const double k = double(theta[0]), N = 1.3, depth = std::abs(x);
  return {k * std::pow(depth, N + 1) / (N + 1), N * k * std::pow(depth, N - 1)};
}

/// By Simpson's rule over pieces of at most a quarter of the corner's width, with the corner of `environment_of`.
template <typename Theta, typename Scalar>
Potential potential_of(const SmoothBilinear<1, Scalar>& environment, const Theta& theta, double x) {
  using Vector = Eigen::Array<Scalar, 1, 1>;
  const auto force = [&](double at) {
    return double(environment.force(theta.transpose(), Vector::Constant(Scalar(at)), Vector::Zero())[0]);
  };
  const double width = 0.0028 / 20;
  const int pieces = std::min(1 + int(std::min(std::abs(x) / width * 4, 1e4)), 2000);
  const double piece = x / pieces;
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const double from = piece * i;
    sum += force(from) + 4 * force(from + piece / 2) + force(from + piece);
  }
  return {sum * piece / 6, std::max(double(theta[0]), double(theta[1]))};
}

}  // namespace limpid::stress
