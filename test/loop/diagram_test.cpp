// SPDX-License-Identifier: MIT
#include <limpid/loop/diagram.hpp>

#include "loop/scene.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace scene;
using limpid::inputs;
using limpid::make_loop;
using limpid::wants;

TEST_CASE("the diagram shows inputs, blocks, signals and what is wanted; pruned blocks are dashed") {
  const auto loop = make_loop<wants<Torque>, inputs<Force>>(Tracking{}, KnownPrediction{}, Estimation{}, Sampling{});
  CHECK(limpid::diagram(loop) == R"(digraph loop {
  rankdir=LR;
  input0 [label="Force", shape=plaintext];
  block0 [label="Tracking", shape=box];
  block1 [label="KnownPrediction", shape=box];
  block2 [label="Estimation", shape=box, style=dashed];
  block3 [label="Sampling", shape=box];
  block1 -> block0 [label="Motion"];
  block3 -> block1 [label="Sample"];
  input0 -> block1 [label="Force"];
  block3 -> block2 [label="Sample", style=dashed];
  input0 -> block3 [label="Force"];
  wanted0 [label="Torque", shape=plaintext];
  block0 -> wanted0 [label=""];
}
)");
}

namespace {

struct Quoted {
  using value_type = double;
  static constexpr const char* name = R"(the "last" force)";
  static double initial() { return 0; }
};

}  // namespace

TEST_CASE("previous values are labelled as such, and names are quoted for DOT") {
  const auto loop = make_loop<wants<Motion>, inputs<Quoted>>(
      limpid::make_block<struct Delay, limpid::signals<limpid::Previous<Quoted>>, limpid::signals<Motion>>(
          [](Time, double last) { return last; }));
  const std::string dot = limpid::diagram(loop);
  CHECK(dot.find(R"(block0 [label="Delay", shape=box];)") != std::string::npos);
  CHECK(dot.find(R"(input0 -> block0 [label="previous the \"last\" force"];)") != std::string::npos);
}
