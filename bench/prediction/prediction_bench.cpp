// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/prediction/autoregressive_predictor.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/linear_predictor.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/prediction/predictor_mixture.hpp>
#include <limpid/prediction/quadratic_predictor.hpp>
#include <limpid/prediction/replay_predictor.hpp>
#include <limpid/prediction/smith_predictor.hpp>

#include <benchmark/benchmark.h>

namespace {

using namespace std::chrono_literals;

/// A tick of 1 ms with a fresh sample, 5 ms old.
template <typename Predictor>
void tick(benchmark::State& state, Predictor predictor) {
  using Scalar = typename Predictor::Scalar;
  limpid::ToolSample<3, Scalar> sample;
  Eigen::Array<Scalar, 3, 1> F_h(Scalar(1), Scalar(2), Scalar(0.5));
  limpid::Time now{};
  for (int k = 0; k < 10; ++k) (void)predictor.advance(now += 1ms, F_h);
  for (auto _ : state) {
    now += 1ms;
    sample.taken = now - 5ms;
    sample.arrived = now;
    benchmark::DoNotOptimize(sample);
    benchmark::DoNotOptimize(F_h);
    benchmark::DoNotOptimize(predictor.observe(sample));
    benchmark::DoNotOptimize(predictor.advance(now, F_h));
  }
}

void hold_predictor_3_axes(benchmark::State& state) { tick(state, limpid::HoldPredictor<3>()); }
BENCHMARK(hold_predictor_3_axes);

void linear_predictor_3_axes(benchmark::State& state) { tick(state, limpid::LinearPredictor<3>()); }
BENCHMARK(linear_predictor_3_axes);

void quadratic_predictor_3_axes(benchmark::State& state) {
  tick(state, limpid::QuadraticPredictor<3>({.tool = {.mass = 0.1, .damping = 0.1}}));
}
BENCHMARK(quadratic_predictor_3_axes);

void autoregressive_predictor_3_axes(benchmark::State& state) {
  tick(state, limpid::AutoregressivePredictor<2, 3>({.period = 1ms}));
}
BENCHMARK(autoregressive_predictor_3_axes);

template <typename Predictor>
Predictor linear() {
  using Scalar = typename Predictor::Scalar;
  typename Predictor::Theta theta;
  theta.col(0).setConstant(Scalar(800));
  theta.col(1).setConstant(Scalar(33));
  return Predictor({.environment = {},
                    .tool = {.mass = Scalar(0.1), .damping = Scalar(0.1)},
                    .theta = theta,
                    .gain = {Scalar(-195.1), Scalar(-4.89)}});
}

template <typename Scalar>
using Env = limpid::KelvinVoigt<3, Scalar>;

template <typename Scalar>
void known_model_predictor_3_axes(benchmark::State& state) {
  tick(state, linear<limpid::ModelPredictor<Env<Scalar>, limpid::Tool<3, Scalar>, limpid::Known>>());
}
BENCHMARK(known_model_predictor_3_axes<double>);
BENCHMARK(known_model_predictor_3_axes<float>);

void smith_predictor_3_axes(benchmark::State& state) {
  Env<double>::Theta theta;
  theta.col(0).setConstant(800);
  theta.col(1).setConstant(33);
  tick(state, limpid::SmithPredictor<Env<double>, limpid::Tool<3>, limpid::Known>(
                  {.environment = {}, .tool = {.mass = 0.1, .damping = 0.1}, .theta = theta}));
}
BENCHMARK(smith_predictor_3_axes);

/// A fresh sample on every tick, each replayed over as many ticks as the argument says.
template <typename Scalar, typename Environment = Env<Scalar>>
void replay(benchmark::State& state, const Environment& environment, const typename Environment::Theta& theta) {
  limpid::ReplayPredictor<Environment, limpid::Tool<3, Scalar>, limpid::Known> predictor(
      {.environment = environment,
       .tool = {.mass = Scalar(0.1), .damping = Scalar(0.1)},
       .theta = theta,
       .ticks_per_update = 512});
  limpid::ToolSample<3, Scalar> sample;
  Eigen::Array<Scalar, 3, 1> F_h(Scalar(1), Scalar(2), Scalar(0.5));
  limpid::Time now{};
  for (int k = 0; k < 600; ++k) (void)predictor.advance(now += 1ms, F_h);
  for (auto _ : state) {
    now += 1ms;
    sample.taken = now - state.range(0) * 1ms;
    sample.arrived = now;
    benchmark::DoNotOptimize(sample);
    benchmark::DoNotOptimize(F_h);
    benchmark::DoNotOptimize(predictor.observe(sample));
    benchmark::DoNotOptimize(predictor.advance(now, F_h));
  }
}

template <typename Scalar>
void linear_replay_3_axes(benchmark::State& state) {
  typename Env<Scalar>::Theta theta;
  theta.col(0).setConstant(Scalar(800));
  theta.col(1).setConstant(Scalar(33));
  replay<Scalar>(state, Env<Scalar>{}, theta);
}
BENCHMARK(linear_replay_3_axes<double>)->Arg(5)->Arg(32)->Arg(200);
BENCHMARK(linear_replay_3_axes<float>)->Arg(200);

void nonlinear_replay_3_axes(benchmark::State& state) {
  using Layers = limpid::SmoothBilinear<3>;
  Layers::Theta theta;
  theta.col(0).setConstant(200);
  theta.col(1).setConstant(2000);
  theta.col(2).setConstant(20);
  replay<double>(state, Layers({.depth = 0.008, .sharpness = 20}), theta);
}
BENCHMARK(nonlinear_replay_3_axes)->Arg(5)->Arg(32)->Arg(200);

/// Hold, linear, quadratic, autoregressive and replay, one axis; a sample each so many ticks, as old, at a tick of 1
/// ms.
void mixture_1_axis(benchmark::State& state) {
  using One = limpid::KelvinVoigt<1>;
  const limpid::Tool<1> tool{.mass = 0.1, .damping = 0.1};
  const auto period = state.range(0) * limpid::Duration(1ms);
  limpid::PredictorMixture<limpid::HoldPredictor<1>, limpid::LinearPredictor<1>, limpid::QuadraticPredictor<1>,
                           limpid::AutoregressivePredictor<2>, limpid::ReplayPredictor<One>>
      mixture({}, {}, {}, limpid::QuadraticPredictor<1>({.tool = tool}),
              limpid::AutoregressivePredictor<2>({.period = period}),
              limpid::ReplayPredictor<One>({.tool = tool, .theta = One::Theta(800, 33)}));
  limpid::ToolSample<1> sample;
  Eigen::Array<double, 1, 1> F_h(1.0);
  limpid::Time now{};
  for (int k = 0; k < 600; ++k) (void)mixture.advance(now += 1ms, F_h);
  for (auto _ : state) {
    now += 1ms;
    benchmark::DoNotOptimize(F_h);
    if (now % period == limpid::Duration{0}) {
      sample.taken = now - period;
      sample.arrived = now;
      benchmark::DoNotOptimize(sample);
      benchmark::DoNotOptimize(mixture.observe(sample));
    }
    benchmark::DoNotOptimize(mixture.advance(now, F_h));
  }
}
BENCHMARK(mixture_1_axis)->Arg(1)->Arg(16)->Arg(100);

/// A new estimate on every tick: the step's matrices are made anew.
template <typename Scalar>
void estimated_model_predictor_3_axes(benchmark::State& state) {
  auto predictor = linear<limpid::ModelPredictor<Env<Scalar>>>();
  limpid::EnvironmentEstimate<3, 2, Scalar> estimate;
  estimate.theta_hat.col(1).setConstant(Scalar(33));
  Eigen::Array<Scalar, 3, 1> F_h(Scalar(1), Scalar(2), Scalar(0.5));
  limpid::Time now{};
  for (auto _ : state) {
    estimate.theta_hat.col(0) = Eigen::Array<Scalar, 3, 1>::Constant(Scalar(800 + now.count() % 7));
    benchmark::DoNotOptimize(estimate);
    benchmark::DoNotOptimize(predictor.use(estimate));
    benchmark::DoNotOptimize(F_h);
    benchmark::DoNotOptimize(predictor.advance(now += 1ms, F_h));
  }
}
BENCHMARK(estimated_model_predictor_3_axes<double>);
BENCHMARK(estimated_model_predictor_3_axes<float>);

void nonlinear_model_predictor_3_axes(benchmark::State& state) {
  using Layers = limpid::SmoothBilinear<3>;
  Layers::Theta theta;
  theta.col(0).setConstant(200);
  theta.col(1).setConstant(2000);
  theta.col(2).setConstant(20);
  tick(state, limpid::ModelPredictor<Layers, limpid::Tool<3>, limpid::Known>(
                  {.environment = Layers({.depth = 0.008, .sharpness = 20}),
                   .tool = {.mass = 0.1, .damping = 0.1},
                   .theta = theta,
                   .gain = {-195.1, -4.89}}));
}
BENCHMARK(nonlinear_model_predictor_3_axes);

}  // namespace
