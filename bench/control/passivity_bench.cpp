// SPDX-License-Identifier: MIT
#include <limpid/control/passivity_controller.hpp>
#include <limpid/control/virtual_coupling.hpp>
#include <limpid/environment/operator_hand.hpp>

#include <benchmark/benchmark.h>

#include <chrono>

namespace {

using namespace limpid;
using namespace std::chrono_literals;

// What a tick gives, any of which may have changed.
template <int Axes>
struct Inputs {
  using Vector = Eigen::Array<double, Axes, 1>;

  Vector force = Vector::Constant(-0.25), x = Vector::Constant(0.0625), v = Vector::Constant(0.125);
  Time now{0};

  void next() {
    now += 1ms;
    benchmark::DoNotOptimize(force);
    benchmark::DoNotOptimize(x);
    benchmark::DoNotOptimize(v);
  }
};

// The baseline: the inputs and a force, nothing done.
template <int Axes>
void passivity_empty(benchmark::State& state) {
  Inputs<Axes> in;
  for (auto _ : state) {
    in.next();
    typename Inputs<Axes>::Vector force = in.force;
    benchmark::DoNotOptimize(force);
  }
}
BENCHMARK(passivity_empty<1>);
BENCHMARK(passivity_empty<3>);

template <int Axes>
void virtual_coupling(benchmark::State& state) {
  using Vector = typename Inputs<Axes>::Vector;
  VirtualCoupling<Axes> coupling({.stiffness = Vector::Constant(200), .damping = Vector::Constant(0.025)});
  Inputs<Axes> in;
  for (auto _ : state) {
    in.next();
    auto output = coupling.update(in.now, {in.x, in.v}, {in.v, in.x});
    benchmark::DoNotOptimize(output);
  }
}
BENCHMARK(virtual_coupling<1>);
BENCHMARK(virtual_coupling<3>);

template <int Axes, EnergyPairing pairing>
void passivity_controller(benchmark::State& state) {
  PassivityController<Axes> controller({.pairing = pairing, .largest_damping = 10});
  Inputs<Axes> in;
  for (auto _ : state) {
    in.next();
    auto output = controller.update(in.now, in.force, in.x, in.v);
    benchmark::DoNotOptimize(output);
  }
}
BENCHMARK(passivity_controller<1, EnergyPairing::held_force>);
BENCHMARK(passivity_controller<3, EnergyPairing::held_force>);
BENCHMARK(passivity_controller<3, EnergyPairing::same_tick>);

// With the energies.
template <int Axes>
void operator_hand(benchmark::State& state) {
  using Vector = typename Inputs<Axes>::Vector;
  OperatorHand<Axes> hand(
      {.mass = Vector::Constant(0.3), .damping = Vector::Constant(5), .stiffness = Vector::Constant(300)});
  Inputs<Axes> in;
  for (auto _ : state) {
    in.next();
    auto output = hand.advance(in.now, in.force, in.x, in.v);
    benchmark::DoNotOptimize(output);
  }
}
BENCHMARK(operator_hand<1>);
BENCHMARK(operator_hand<3>);

}  // namespace
