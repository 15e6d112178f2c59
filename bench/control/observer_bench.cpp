// SPDX-License-Identifier: MIT
#include <limpid/control/disturbance_observer.hpp>

#include <benchmark/benchmark.h>

#include <chrono>

namespace {

using namespace limpid;
using namespace std::chrono_literals;

// What a tick gives, any of which may have changed.
template <int Axes>
struct Inputs {
  using Vector = Eigen::Array<double, Axes, 1>;

  Vector command = Vector::Constant(0.5), hand = Vector::Constant(-0.25), velocity = Vector::Constant(0.0625);
  Vector applied = Vector::Constant(0.375);
  Time now{0};

  void next() {
    now += 1ms;
    benchmark::DoNotOptimize(command);
    benchmark::DoNotOptimize(hand);
    benchmark::DoNotOptimize(velocity);
    benchmark::DoNotOptimize(applied);
  }
};

// The baseline: the inputs and an output, nothing observed. The cost of an axis is the difference over the axes.
template <int Axes>
void observer_empty(benchmark::State& state) {
  Inputs<Axes> in;
  for (auto _ : state) {
    in.next();
    typename DisturbanceObserver<FirstOrderQ<>, Axes>::Output output{in.command, in.command, Status::ok};
    benchmark::DoNotOptimize(output);
  }
}
BENCHMARK(observer_empty<1>);
BENCHMARK(observer_empty<2>);
BENCHMARK(observer_empty<3>);

template <typename Q, int Axes, ObserverForm form>
void observer(benchmark::State& state) {
  using Observer = DisturbanceObserver<Q, Axes>;
  using Vector = typename Observer::Vector;
  Observer observer(
      {.filter = {.cutoff = 50}, .mass = Vector::Constant(0.01), .damping = Vector::Constant(0.022), .form = form});
  Inputs<Axes> in;
  for (auto _ : state) {
    in.next();
    auto output = observer.update(in.now, in.command, typename Observer::OperatorForce(in.hand), in.velocity,
                                  typename Observer::AppliedForce(in.applied));
    benchmark::DoNotOptimize(output);
  }
}

#define LIMPID_OBSERVER_FORMS(Q, Axes)                        \
  BENCHMARK(observer<Q, Axes, ObserverForm::tustin>);         \
  BENCHMARK(observer<Q, Axes, ObserverForm::step_invariant>); \
  BENCHMARK(observer<Q, Axes, ObserverForm::backward_euler>)
#define LIMPID_OBSERVER_AXES(Q) \
  LIMPID_OBSERVER_FORMS(Q, 1);  \
  LIMPID_OBSERVER_FORMS(Q, 2);  \
  LIMPID_OBSERVER_FORMS(Q, 3)

LIMPID_OBSERVER_AXES(FirstOrderQ<>);
LIMPID_OBSERVER_AXES(ButterworthQ<>);
LIMPID_OBSERVER_AXES(UmenoHoriQ<>);

// Every tick as long as none before it: the coefficients are made anew each time. Per tick, all axes together.
template <typename Q, int Axes, ObserverForm form>
void observer_irregular(benchmark::State& state) {
  using Observer = DisturbanceObserver<Q, Axes>;
  using Vector = typename Observer::Vector;
  Observer observer(
      {.filter = {.cutoff = 50}, .mass = Vector::Constant(0.01), .damping = Vector::Constant(0.022), .form = form});
  Inputs<Axes> in;
  int odd = 0;
  for (auto _ : state) {
    in.next();
    in.now += Duration(odd = 1 - odd);
    auto output = observer.update(in.now, in.command, typename Observer::OperatorForce(in.hand), in.velocity,
                                  typename Observer::AppliedForce(in.applied));
    benchmark::DoNotOptimize(output);
  }
}
BENCHMARK(observer_irregular<FirstOrderQ<>, 3, ObserverForm::tustin>);
BENCHMARK(observer_irregular<UmenoHoriQ<>, 3, ObserverForm::tustin>);
BENCHMARK(observer_irregular<UmenoHoriQ<>, 3, ObserverForm::step_invariant>);

}  // namespace
