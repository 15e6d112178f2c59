// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/estimation/environment_estimator.hpp>
#include <limpid/estimation/excitation.hpp>
#include <limpid/estimation/projection_rls.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace {

using namespace std::chrono_literals;

// k, b and c of the offset model, as far as N goes.
template <int N, typename Scalar>
typename limpid::ProjectionRLS<N, 3, Scalar>::Settings settings() {
  typename limpid::ProjectionRLS<N, 3, Scalar>::Settings s;
  const double lower[] = {200, 20, -55}, upper[] = {2000, 40, 0}, gain[] = {1e9, 8e6, 1e4};
  for (int j = 0; j < N; ++j) {
    s.lower.col(j).setConstant(Scalar(lower[j]));
    s.upper.col(j).setConstant(Scalar(upper[j]));
    s.initial.col(j).setConstant(Scalar((lower[j] + upper[j]) / 2));
    s.initial_gain.col(j).setConstant(Scalar(gain[j]));
  }
  return s;
}

/// A press of 5 mm (1 - cos) in 1024 ticks of 1 ms, the axes out of step.
template <int N, typename Scalar>
struct Press {
  using Rls = limpid::ProjectionRLS<N, 3, Scalar>;
  std::vector<typename Rls::Regressor> phi;
  std::vector<typename Rls::Vector> F;

  Press() {
    const double omega = 2 * M_PI / 1.024, truth[] = {800, 33, -2};
    for (int k = 0; k < 1024; ++k) {
      typename Rls::Regressor row = Rls::Regressor::Ones();
      typename Rls::Vector force = Rls::Vector::Zero();
      for (int axis = 0; axis < 3; ++axis) {
        const double angle = omega * k * 1e-3 + axis;
        row(axis, 0) = Scalar(0.005 * (1 - std::cos(angle)));
        if constexpr (N > 1) row(axis, 1) = Scalar(0.005 * omega * std::sin(angle));
        for (int j = 0; j < N; ++j) force[axis] += row(axis, j) * Scalar(truth[j]);
      }
      phi.push_back(row);
      F.push_back(force);
    }
  }
};

template <int N, typename Scalar>
void projection_rls_3_axes(benchmark::State& state) {
  const Press<N, Scalar> press;
  limpid::ProjectionRLS<N, 3, Scalar> rls(settings<N, Scalar>());
  auto dt = Scalar(0.001);
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(dt);
    benchmark::DoNotOptimize(rls.update(dt, press.phi[k], press.F[k]));
    benchmark::DoNotOptimize(rls.theta());
    k = (k + 1) % press.phi.size();
  }
}
BENCHMARK(projection_rls_3_axes<1, double>);
BENCHMARK(projection_rls_3_axes<2, double>);
BENCHMARK(projection_rls_3_axes<2, float>);
BENCHMARK(projection_rls_3_axes<3, double>);

// At the limit of the gain, where the largest eigenvalue is needed on every tick.
template <int N>
void projection_rls_3_axes_idle(benchmark::State& state) {
  using Rls = limpid::ProjectionRLS<N, 3>;
  Rls rls(settings<N, double>());
  double dt = 0.001;
  for (auto _ : state) {
    benchmark::DoNotOptimize(dt);
    benchmark::DoNotOptimize(rls.update(dt, Rls::Regressor::Zero(), Rls::Vector::Zero()));
  }
}
BENCHMARK(projection_rls_3_axes_idle<2>);
BENCHMARK(projection_rls_3_axes_idle<3>);

void environment_estimator_3_axes(benchmark::State& state) {
  const Press<2, double> press;
  limpid::EnvironmentEstimator<limpid::KelvinVoigt<3>> estimator({.environment = {}, .law = settings<2, double>()});
  limpid::Held<limpid::ToolState<3>> held;
  limpid::Time now{};
  std::size_t k = 0;
  for (auto _ : state) {  // a fresh sample on every tick
    held.value.x = press.phi[k].col(0);
    held.value.v = press.phi[k].col(1);
    held.value.force = press.F[k];
    held.taken = now += 1ms;
    benchmark::DoNotOptimize(held);
    benchmark::DoNotOptimize(estimator.update(now, held));
    benchmark::DoNotOptimize(estimator.estimate());
    k = (k + 1) % press.phi.size();
  }
}
BENCHMARK(environment_estimator_3_axes);

void excitation_monitor_3_axes(benchmark::State& state) {
  const Press<2, double> press;
  limpid::ExcitationMonitor<2, 3> monitor({.window = 1, .least = 1e-6});
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(monitor.update(0.001, press.phi[k]));
    k = (k + 1) % press.phi.size();
  }
}
BENCHMARK(excitation_monitor_3_axes);

}  // namespace
