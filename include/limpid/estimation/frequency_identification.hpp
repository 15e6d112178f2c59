// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace limpid {

namespace detail {

template <Real Scalar>
[[nodiscard]] bool is_finite_response(const std::complex<Scalar>& z) noexcept {
  return is_finite(z.real()) && is_finite(z.imag());
}

/// The part that is not finite, if any: what an error shows.
template <Real Scalar>
[[nodiscard]] Scalar worse_part(const std::complex<Scalar>& z) noexcept {
  return is_finite(z.real()) ? z.imag() : z.real();
}

}  // namespace detail

/// What a sine does to an axis: where F = Re F_0 exp(i omega t), its velocity is Re (v/F) F_0 exp(i omega t).
template <Real Scalar = double>
struct ResponseSample {
  Scalar omega;                   ///< rad/s, > 0
  std::complex<Scalar> response;  ///< v/F, m/(N s)
  Scalar weight = Scalar{1};      ///< how much its relative error counts, >= 0
};

/// The axis 1/(m s + b) that comes nearest to a frequency response.
template <Real Scalar = double>
struct IdentifiedAxis {
  Scalar mass{0};         ///< m, kg
  Scalar damping{0};      ///< b, N s/m
  Scalar misfit{0};       ///< root mean square of |(b + i omega m) v/F - 1|: 0 for such an axis
  bool physical = false;  ///< whether m > 0 and b >= 0
  std::string reason;     ///< why not; empty where it is
};

/// Nominal mass and damping of an axis, Eom, Suh and Yi, section 2: the others locked, it is taken for
/// F = m x'' + b x', from force to velocity 1/(m s + b). They minimise the sum over the samples of
///
///     weight |(b + i omega m) v/F - 1|^2
///
/// the squares of relative errors, so that a response that was measured to so many per cent everywhere is weighed
/// alike everywhere. It is linear in (m, b), and (v/F)/|v/F|^2 = 1/(v/F)* makes it fall apart into
///
///     b = sum w Re(v/F) / sum w |v/F|^2          m = -sum w omega Im(v/F) / sum w omega^2 |v/F|^2
///
/// An axis with something else in it, such as friction in which it sticks, has a misfit, and may come out with a
/// negative mass: the answer says so. Off line.
/// @throws std::invalid_argument  where there is no sample, or one cannot be: an omega that is not finite and > 0, a
///                                response that is not finite or all zero, a weight that is not finite and >= 0
template <Real Scalar>
[[nodiscard]] IdentifiedAxis<Scalar> identify_axis(std::span<const ResponseSample<Scalar>> samples) {
  using std::sqrt;
  Scalar all{0}, real{0}, imaginary{0}, square{0}, square_omega{0};
  for (const auto& [omega, response, weight] : samples) {
    expect(is_finite(omega) && omega > Scalar{0}, "identify_axis: omega", "finite and > 0", omega);
    expect(detail::is_finite_response(response), "identify_axis: response", "finite", detail::worse_part(response));
    expect(is_finite(weight) && weight >= Scalar{0}, "identify_axis: weight", "finite and >= 0", weight);
    const Scalar size = response.real() * response.real() + response.imag() * response.imag();
    all += weight;
    real += weight * response.real();
    imaginary += weight * omega * response.imag();
    square += weight * size;
    square_omega += weight * omega * omega * size;
  }
  expect(square > Scalar{0}, "identify_axis: samples", "some with a weight and a response other than 0",
         samples.size());
  IdentifiedAxis<Scalar> axis{-imaginary / square_omega, real / square, Scalar{0}, true, {}};
  Scalar error{0};
  for (const auto& [omega, response, weight] : samples) {
    const std::complex<Scalar> one = std::complex<Scalar>(axis.damping, omega * axis.mass) * response;
    error += weight * ((one.real() - Scalar{1}) * (one.real() - Scalar{1}) + one.imag() * one.imag());
  }
  axis.misfit = sqrt(error / all);
  if (!(axis.mass > Scalar{0})) axis.reason = "the velocity leads the force: a spring, not a mass";
  if (!(axis.damping >= Scalar{0})) axis.reason = "the axis gives energy";
  if (!is_finite(square) || !(square_omega > Scalar{0}) || !is_finite(square_omega) || !is_finite(axis.misfit)) {
    axis.reason = "squares of the samples are out of the scalar's range";
  }
  axis.physical = axis.reason.empty();
  return axis;
}

/// v/F at one frequency from a record of ticks of equal length, by correlation with exp(-i omega t) over its last whole
/// periods. What comes before them, in which the axis settles, is left out. The force is held from tick to tick, as a
/// device holds it; the velocity is that at the ticks and taken as linear between them. For m v' + b v = F that is off
/// by the part (b T/m)(omega T)/12, which makes b come out less by the part (omega T)^2/12; readings in steps add
/// theirs. Off line.
/// @param force     given at each tick and held until the next, N
/// @param velocity  at the same ticks, m/s
/// @param period    T, from tick to tick, s, > 0
/// @param omega     rad/s, below pi/T
/// @param periods   of the sine that count; they must be a whole number of ticks, to 1e-6 of one and the rounding of
///                  their number, or the transient and the mean would leak in
/// @throws std::invalid_argument  where an argument cannot be, the record is too short or not finite where it counts,
///                                or its force has nothing at omega but rounding
template <Real Scalar>
[[nodiscard]] ResponseSample<Scalar> response_of_record(std::span<const Scalar> force, std::span<const Scalar> velocity,
                                                        const Scalar& period, const Scalar& omega, int periods) {
  using std::abs, std::atan, std::cos, std::round, std::sin;
  using Complex = std::complex<Scalar>;
  const Scalar turn = Scalar{8} * atan(Scalar{1}), step = omega * period;
  expect(is_finite(period) && period > Scalar{0}, "response_of_record: period", "finite and > 0", period);
  expect(is_finite(omega) && omega > Scalar{0} && step < turn / Scalar{2}, "response_of_record: omega",
         "of (0, pi/period)", omega);
  expect(periods > 0, "response_of_record: periods", "> 0", periods);
  const Scalar exact = Scalar(periods) * turn / step, whole = round(exact), off = exact - whole;
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon(), most_off = Scalar(1e-6) + Scalar{4} * epsilon * exact;
  expect(off * off < most_off * most_off, "response_of_record: periods", "a whole number of ticks long", exact);
  expect(force.size() == velocity.size(), "response_of_record: velocity", "as many as forces", velocity.size());
  const bool long_enough = whole <= static_cast<Scalar>(force.size());
  expect(long_enough, "response_of_record: force", "as long as the periods that count", force.size());
  Complex F{}, v{};
  Scalar all{0};
  for (std::size_t i = force.size() - static_cast<std::size_t>(whole); i < force.size(); ++i) {
    const Complex turned(cos(step * static_cast<Scalar>(i)), -sin(step * static_cast<Scalar>(i)));
    F += turned * force[i];
    v += turned * velocity[i];
    all += abs(force[i]);
  }
  const Scalar size = F.real() * F.real() + F.imag() * F.imag();
  // of the angles, of which the last is the largest, and of the sum; and what leaks in from the mean
  const Scalar rounding = (epsilon * (step * static_cast<Scalar>(force.size()) + whole) + abs(off) / whole) * all;
  expect(is_finite(size) && size > rounding * rounding, "response_of_record: force", "finite, with a part at omega",
         size);
  // A held tick has the transform sinc exp(-i omega T/2), linear pieces sinc^2: its quotient is left.
  const Scalar half = step / Scalar{2}, sinc = sin(half) / half;
  const Complex response = v * Complex(F.real(), -F.imag()) * (Complex(cos(half), sin(half)) * Scalar(sinc / size));
  expect(detail::is_finite_response(response), "response_of_record: velocity", "finite, with a finite response",
         detail::worse_part(response));
  return {omega, response};
}

}  // namespace limpid
