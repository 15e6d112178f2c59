// SPDX-License-Identifier: MIT
#include <limpid/estimation/contact_edge.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace {

using Edge = limpid::ContactEdge<>;
constexpr Edge::Tissue softest{.slope = 150, .damping = 60};

bool feel(Edge& edge, double x, double v, double force) {
  return edge.feel({.taken = {}, .x = x, .v = v, .force = force}, softest);
}

}  // namespace

TEST_CASE("a tool that goes deeper and feels nothing shows that there is an edge") {
  Edge edge;
  feel(edge, 0, 0, 0);
  CHECK(!edge.exists());
  feel(edge, 5e-4, 0.02, 0);
  CHECK(edge.exists());
}

TEST_CASE("a tool that goes back at a steady rate and feels nothing shows it too") {
  Edge edge;
  CHECK(feel(edge, 0.003, -0.005, 2));
  for (int i = 0; i < 5; ++i) feel(edge, 1e-3 - 5e-4 * i, -5e-3, 0);
  CHECK(edge.exists());
}

TEST_CASE("a soft tissue that recovers behind the tool is not taken for an edge") {
  Edge edge;
  const double rate = 200 / 30.0;  // of k x + b v = 0, 1/s
  for (double t = 0; t < 1; t += 0.016) {
    const double x = 0.003 * std::exp(-rate * t);
    feel(edge, x, -rate * x, 0);
    CHECK(!edge.exists());
  }
}

TEST_CASE("a bilateral tissue that is pressed and pulled by turns is not taken for an edge") {
  for (const double k : {200.0, 800.0, 2000.0}) {
    for (const double period : {0.016, 0.032, 0.1, 0.2}) {
      Edge edge;
      CAPTURE(k);
      CAPTURE(period);
      for (double t = 0; t < 20; t += period) {
        const double x = 3 / k * std::sin(3.14 * t), v = 3 / k * 3.14 * std::cos(3.14 * t);
        feel(edge, x, v, k * x + 30 * v);
        CHECK(!edge.exists());
      }
    }
  }
}

TEST_CASE("where a tissue pulls in two samples one after the other there is no edge any more") {
  Edge edge;
  for (const double x : {0.0, 5e-4}) feel(edge, x, 0.01, 0);
  REQUIRE(edge.exists());
  feel(edge, -1e-3, -0.01, -1);
  CHECK(edge.exists());
  feel(edge, -2e-3, -0.01, -1);
  CHECK(!edge.exists());
}

TEST_CASE("a tool that was free five times since its tissue pulled meets an edge after all") {
  Edge edge;
  const auto fly = [&] {
    for (const double x : {0.0, 5e-4}) feel(edge, x, 0.01, 0);
    feel(edge, 2e-3, 0, 1);
  };
  fly();
  for (int i = 0; i < 2; ++i) feel(edge, 1e-3, -0.01, -1);
  for (int i = 0; i < 4; ++i) fly();
  CHECK(!edge.exists());
  fly();
  CHECK(edge.exists());
}

TEST_CASE("where the tool was free deeper than it feels a force now, the guess is by that force") {
  Edge edge;
  for (const double x : {4e-3, 5e-3}) feel(edge, x, 0.01, 0);
  const auto [at, deviation] = edge.guess({.taken = {}, .x = 3e-3, .v = 0, .force = 2}, 1000, 25);
  CHECK(at == doctest::Approx(1e-3));
  CHECK(deviation == doctest::Approx(2e-3));
}

TEST_CASE("noise that was seen while the tool was free is not taken for a push") {
  Edge edge;
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, 0.03);
  for (int i = 0; i < 30; ++i) feel(edge, 1e-3 * i, 0.01, noise(generator));
  REQUIRE(edge.exists());
  CHECK(!feel(edge, 0.031, 0.01, 0.06));  // twice its deviation
  CHECK(feel(edge, 0.031, 0.01, 0.3));    // ten times
}

TEST_CASE("the edge is guessed between the deepest free sample and the first with force") {
  Edge edge;
  for (const double x : {0.0, 4e-4, 8e-4}) feel(edge, x, 0.01, 0);
  CHECK(feel(edge, 1.2e-3, 0.01, 0.3));
  const auto [at, deviation] = edge.guess({.taken = {}, .x = 1.2e-3, .v = 0.01, .force = 0.3}, 1000, 0);
  CHECK(at == doctest::Approx(0.9e-3));         // 0.3 N deep at 1000 N/m
  CHECK(deviation == doctest::Approx(0.3e-3));  // the farther end of the bracket, 0.1 and 0.3 mm away
}
