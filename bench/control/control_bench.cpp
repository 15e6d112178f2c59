// SPDX-License-Identifier: MIT
#include <limpid/control/compensated_tracking.hpp>
#include <limpid/control/computed_torque.hpp>
#include <limpid/control/friction_compensator.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/control/velocity_observer.hpp>
#include <limpid/robot/omni.hpp>

#include <benchmark/benchmark.h>

#include <chrono>

namespace {

using namespace limpid;
using namespace std::chrono_literals;

template <typename Scalar>
using Vector = Eigen::Matrix<Scalar, 3, 1>;

template <typename Scalar>
struct Inputs {
  JointState<3, Scalar> is{{Scalar(0.1), Scalar(0.7), Scalar(-1.4)}, {Scalar(0.3), Scalar(-0.2), Scalar(0.1)}};
  DesiredJoints<3, Scalar> wanted{{Scalar(0.11), Scalar(0.69), Scalar(-1.38)},
                                  {Scalar(0.2), Scalar(-0.1), Scalar(0.1)},
                                  {Scalar(1), Scalar(2), Scalar(-1)}};
  Vector<Scalar> F_h{Scalar(1), Scalar(-0.5), Scalar(0.3)};
  Vector<Scalar> torque{Scalar(0.1), Scalar(-0.05), Scalar(0.08)};
  Time now{0};

  void next() {  // any of them may have changed
    now += 1ms;
    benchmark::DoNotOptimize(is);
    benchmark::DoNotOptimize(wanted);
    benchmark::DoNotOptimize(F_h);
    benchmark::DoNotOptimize(torque);
  }
};

template <typename Scalar>
void computed_torque(benchmark::State& state) {
  ComputedTorque<Omni<Scalar>> controller({.Lambda = Vector<Scalar>(Scalar(2.8), Scalar(3), Scalar(1.5)),
                                           .Kd = Vector<Scalar>(Scalar(0.4), Scalar(0.28), Scalar(0.1)),
                                           .theta = Omni<Scalar>::table_5_2()});
  Inputs<Scalar> in;
  for (auto _ : state) {
    in.next();
    benchmark::DoNotOptimize(controller.update(in.is, in.wanted, in.F_h));
  }
}
BENCHMARK(computed_torque<double>);

template <typename Scalar>
void slotine_li_adaptive(benchmark::State& state) {
  using Controller = SlotineLiAdaptive<Omni<Scalar>>;
  Controller controller({.Lambda = Vector<Scalar>(Scalar(2.8), Scalar(3), Scalar(1.5)),
                         .Kd = Vector<Scalar>(Scalar(0.4), Scalar(0.28), Scalar(0.1)),
                         .Gamma = Controller::Parameters::Constant(Scalar(1e-9)),  // adapts, but hardly moves
                         .theta0 = Omni<Scalar>::table_5_2()});
  Inputs<Scalar> in;
  for (auto _ : state) {
    in.next();
    benchmark::DoNotOptimize(controller.update(in.now, in.is, in.wanted, in.F_h));
  }
}
BENCHMARK(slotine_li_adaptive<float>);
BENCHMARK(slotine_li_adaptive<double>);

template <typename Scalar>
void velocity_observer(benchmark::State& state) {
  VelocityObserver<Omni<Scalar>> observer({.theta = Omni<Scalar>::table_5_2()});
  Inputs<Scalar> in;
  for (auto _ : state) {
    in.next();
    benchmark::DoNotOptimize(observer.update(in.now, in.is.q, in.torque, in.F_h));
  }
}
BENCHMARK(velocity_observer<float>);
BENCHMARK(velocity_observer<double>);

// Three joints in motion, identification and compensation.
template <typename Scalar>
void friction_compensator(benchmark::State& state) {
  using Compensator = FrictionCompensator<3, Scalar>;
  typename Compensator::Settings settings;
  settings.identifier.largest.setConstant(Scalar(0.125));
  Compensator compensator(settings);
  Inputs<Scalar> in;
  Scalar to_and_fro(0.0078125);
  for (auto _ : state) {
    in.next();
    in.is.q.array() += to_and_fro;
    in.wanted.q.array() += to_and_fro;
    to_and_fro = -to_and_fro;
    benchmark::DoNotOptimize(compensator.identify(in.now, in.is, in.torque));
    benchmark::DoNotOptimize(compensator.update(in.wanted));
  }
}
BENCHMARK(friction_compensator<float>);
BENCHMARK(friction_compensator<double>);

template <typename Scalar>
void compensated_tracking(benchmark::State& state) {
  using Tracking = CompensatedTracking<Omni<Scalar>>;
  typename Tracking::Settings settings;
  settings.controller.Lambda = Vector<Scalar>(Scalar(12), Scalar(13), Scalar(6));
  settings.controller.Kd = Vector<Scalar>(Scalar(0.25), Scalar(0.125), Scalar(0.0625));
  settings.controller.Gamma.setConstant(Scalar(1e-9));
  settings.controller.theta0 = settings.observer.theta = Omni<Scalar>::table_5_2();
  settings.friction.identifier.largest.setConstant(Scalar(0.125));
  Tracking tracking(settings);
  Inputs<Scalar> in;
  for (auto _ : state) {
    in.next();
    benchmark::DoNotOptimize(tracking.update(in.now, in.is, in.wanted, in.F_h, in.torque));
  }
}
BENCHMARK(compensated_tracking<double>);

// Argument: 0 far from every limit, 1 near a joint limit, (5.4) and both edges of the workspace, with slewing.
template <typename Scalar>
void safety_limiter(benchmark::State& state) {
  SafetyLimiter<Omni<Scalar>> limiter({.workspace_margin = state.range(0) == 0 ? Scalar(0.01) : Scalar(0.2)});
  Inputs<Scalar> in;
  if (state.range(0) != 0) in.is.q = {Scalar(1), Scalar(1.75), Scalar(-1.6)};
  for (auto _ : state) {
    in.next();
    benchmark::DoNotOptimize(limiter.limit(in.now, in.is, in.torque));
  }
}
BENCHMARK(safety_limiter<float>)->Arg(0)->Arg(1);
BENCHMARK(safety_limiter<double>)->Arg(0)->Arg(1);

}  // namespace
