// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/linear_predictor.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/prediction/quadratic_predictor.hpp>

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
