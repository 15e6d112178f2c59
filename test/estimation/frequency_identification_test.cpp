// SPDX-License-Identifier: MIT
#include <limpid/estimation/frequency_identification.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <type_traits>
#include <vector>

using limpid::identify_axis;
using limpid::response_of_record;
using limpid::ResponseSample;

namespace {

template <typename Scalar>
std::vector<ResponseSample<Scalar>> responses(const Scalar& m, const Scalar& b) {
  std::vector<ResponseSample<Scalar>> samples;
  for (int i = 1; i <= 8; ++i) {
    const Scalar omega = static_cast<Scalar>(10 * i);
    samples.push_back({omega, Scalar(1) / std::complex<Scalar>(b, omega * m)});
  }
  return samples;
}

template <typename Scalar>
auto identified(const std::vector<ResponseSample<Scalar>>& samples) {
  return identify_axis(std::span<const ResponseSample<Scalar>>(samples));
}

// The axis m v' + b v = F for a cosine that is held from tick to tick, from rest: exact at the ticks.
struct Record {
  std::vector<double> force, velocity;

  Record(double m, double b, double T, double omega, int ticks, double offset = 0) {
    const double decay = std::exp(-b * T / m), gain = -std::expm1(-b * T / m) / b;
    double v = 0;
    for (int k = 0; k < ticks; ++k) {
      force.push_back(std::cos(omega * k * T) + offset);
      velocity.push_back(v);
      v = decay * v + gain * force.back();
    }
  }

  [[nodiscard]] ResponseSample<double> response(double T, double omega, int periods) const {
    return response_of_record<double>(force, velocity, T, omega, periods);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("the response of a mass and a damper gives them back", Scalar, float, double, long double) {
  const Scalar m = Scalar(1) / 100, b = Scalar(22) / 1000, epsilon = std::numeric_limits<Scalar>::epsilon();
  const auto axis = identified(responses(m, b));
  CHECK(std::abs(axis.mass - m) < 20 * epsilon * m);      // sums of eight terms of one sign, some roundings each
  CHECK(std::abs(axis.damping - b) < 300 * epsilon * b);  // b is 1/4 to 1/36 of the response it is taken from
  CHECK(axis.misfit < 20 * epsilon);
  CHECK(axis.physical);
  CHECK(axis.reason.empty());
}

TEST_CASE("no other mass and damping come nearer to a scattered response, in the weighted relative error") {
  constexpr unsigned seed = 19940501;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.1);
  std::uniform_real_distribution<double> part(0, 1);
  auto samples = responses(0.01, 0.022);
  double all = 0;
  for (auto& sample : samples) {
    sample.response *= std::complex(1 + noise(random), noise(random));
    sample.weight = part(random);
    all += sample.weight;
  }
  const auto error = [&](double m, double b) {
    double sum = 0;
    for (const auto& [omega, response, weight] : samples) {
      sum += weight * std::norm(std::complex(b, omega * m) * response - 1.0);
    }
    return std::sqrt(sum / all);
  };
  const auto axis = identified(samples);
  CHECK(axis.misfit == doctest::Approx(error(axis.mass, axis.damping)).epsilon(1e-12));
  for (const auto& [m, b] : {std::pair{1e-4, 0.0}, {-1e-4, 0.0}, {0.0, 1e-3}, {0.0, -1e-3}, {1e-4, 1e-3}}) {
    CHECK(error(axis.mass + m, axis.damping + b) > axis.misfit);
  }
}

TEST_CASE("a sample without weight does not count, whatever it says") {
  auto samples = responses(0.01, 0.022);
  samples.push_back({50, {7, 7}, 0});
  CHECK(identified(samples).mass == doctest::Approx(0.01).epsilon(1e-14));
}

TEST_CASE("an axis that is a spring or gives energy is told as such") {
  std::vector<ResponseSample<double>> spring{{10, {1e-3, 0.1}}}, engine{{10, {-1e-3, -0.1}}};
  CHECK_FALSE(identified(spring).physical);
  CHECK(identified(spring).mass < 0);
  CHECK(identified(spring).reason == "the velocity leads the force: a spring, not a mass");
  CHECK_FALSE(identified(engine).physical);
  CHECK(identified(engine).reason == "the axis gives energy");
}

// Of a held force the velocity is linear between ticks but for the damping in a tick.
TEST_CASE("a record of a held force gives the axis, its damping to (omega T)^2/12, up to half the Nyquist frequency") {
  const double m = 0.01, b = 0.022, T = 1e-3;
  for (const double hertz : {2.0, 5.0, 10.0, 20.0, 50.0, 125.0, 250.0}) {
    CAPTURE(hertz);
    const double omega = 2 * std::numbers::pi * hertz, part = omega * T * omega * T / 12;
    // after 11 s a transient of exp(-24) = 3e-11 is left
    const auto sample = Record(m, b, T, omega, 12'000).response(T, omega, static_cast<int>(hertz));
    const auto axis = identified(std::vector{sample});
    CHECK(std::abs(axis.mass - m) < 1e-6 * m);                  // (b T/m)^2/12 = 4e-7
    CHECK(std::abs(axis.damping / b - 1) < 1.1 * part + 1e-7);  // the next term is a tenth at 250 Hz
  }
}

TEST_CASE("what comes before the periods that count, and a mean force, do not matter") {
  const double T = 1e-3, omega = 10 * std::numbers::pi;
  const auto plain = Record(0.01, 0.022, T, omega, 15'000).response(T, omega, 5);
  auto other = Record(0.01, 0.022, T, omega, 15'000, 3);
  for (std::size_t i = 0; i < 14'000; ++i) other.velocity[i] = 1e3;
  CHECK(std::abs(other.response(T, omega, 5).response - plain.response) < 1e-10 * std::abs(plain.response));
}

TEST_CASE("an axis whose squares leave the range of the scalar is told as such") {
  for (const double omega : {1e-310, 1e200}) {
    const std::vector<ResponseSample<double>> samples{{omega, {2, -2}}};
    CHECK_FALSE(identified(samples).physical);
    CHECK(identified(samples).reason == "squares of the samples are out of the scalar's range");
  }
}

TEST_CASE("a record without a force at omega, or with a velocity that is not finite, is refused") {
  const double T = 1e-3, omega = 10 * std::numbers::pi, nan = std::numeric_limits<double>::quiet_NaN();
  const Record moved(0.01, 0.022, T, omega, 1000);
  Record constant = moved, torn = moved;
  constant.force.assign(1000, 1.0);  // at omega only the rounding of its sum
  CHECK_THROWS_AS((void)constant.response(T, omega, 2), std::invalid_argument);
  for (const double bad : {nan, 1e308}) {  // 1e308: the response is out of range
    torn.velocity[900] = bad;
    CHECK_THROWS_AS((void)torn.response(T, omega, 2), std::invalid_argument);
  }
  torn.velocity[900] = 0;
  torn.velocity[0] = nan;  // before the periods that count
  CHECK(std::isfinite(torn.response(T, omega, 2).response.real()));
  const std::vector<ResponseSample<double>> imaginary{{10, {1, nan}}};
  CHECK_THROWS_WITH_AS((void)identified(imaginary), "identify_axis: response: expected finite, got nan",
                       std::invalid_argument);
}

TEST_CASE("periods that are a whole number of ticks are so in float too") {
  for (const int hertz : {1, 2, 4, 5, 8, 10, 20, 25, 40, 50}) {
    CAPTURE(hertz);
    const float T = 1e-3F, omega = 2 * std::numbers::pi_v<float> * static_cast<float>(hertz);
    std::vector<float> force, velocity;
    for (int k = 0; k < 4000; ++k) {
      force.push_back(std::cos(omega * T * static_cast<float>(k)));
      velocity.push_back(2 * force.back());
    }
    // off by the hold: an exponential of half a tick over a sinc; phases of up to 1257 rad have errors of 1e-4
    const auto sample = response_of_record<float>(force, velocity, T, omega, 3 * hertz);
    const float half = omega * T / 2;
    CHECK(std::abs(sample.response - 2 * (std::sin(half) / half) * std::polar(1.0F, half)) < 1e-3F);
  }
}

TEST_CASE("what cannot be is refused with its field") {
  const std::vector<ResponseSample<double>> empty{}, nan{{10, {NAN, 0}}}, none{{10, {1, 1}, 0}};
  const std::vector<ResponseSample<double>> standing{{0, {1, 1}}}, negative{{10, {1, 1}, -1}};
  CHECK_THROWS_WITH_AS((void)identified(empty),
                       "identify_axis: samples: expected some with a weight and a response other than 0, got 0",
                       std::invalid_argument);
  for (const auto& samples : {nan, none, standing, negative}) {
    CHECK_THROWS_AS((void)identified(samples), std::invalid_argument);
  }
  const Record record(0.01, 0.022, 1e-3, 10, 1000);
  CHECK_THROWS_AS((void)record.response(1e-3, 4000, 1), std::invalid_argument);                   // above pi/T
  CHECK_THROWS_AS((void)record.response(1e-3, 10, 1), std::invalid_argument);                     // 628.3 ticks
  CHECK_THROWS_AS((void)record.response(1e-3, 10 * std::numbers::pi, 6), std::invalid_argument);  // 1200 of 1000
  CHECK_THROWS_AS((void)record.response(1e-3, 10 * std::numbers::pi, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)record.response(0, 10 * std::numbers::pi, 1), std::invalid_argument);
  const std::vector<double> still(1000, 1.0);
  const double omega = 10 * std::numbers::pi;
  CHECK_THROWS_AS((void)response_of_record<double>(still, std::span(still).first(999), 1e-3, omega, 1),
                  std::invalid_argument);
}
