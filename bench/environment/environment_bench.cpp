// SPDX-License-Identifier: MIT
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>

#include <benchmark/benchmark.h>

namespace {

using namespace std::chrono_literals;

template <limpid::Environment E>
void run_force(benchmark::State& state, const E& e, const limpid::EnvironmentTheta<E>& theta) {
  Eigen::Array3d x{0.003, 0.001, 0.002}, v{0.01, -0.02, 0.005};
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    benchmark::DoNotOptimize(v);
    benchmark::DoNotOptimize(e.force(theta, x, v));
  }
}

void kelvin_voigt_force_3_axes(benchmark::State& state) {
  run_force(state, limpid::KelvinVoigt<3>{}, Eigen::Array<double, 3, 2>::Constant(100));
}
BENCHMARK(kelvin_voigt_force_3_axes);

void smooth_bilinear_force_3_axes(benchmark::State& state) {
  run_force(state, limpid::SmoothBilinear<3>({.depth = 0.00284, .sharpness = 20}),
            Eigen::Array<double, 3, 3>::Constant(100));
}
BENCHMARK(smooth_bilinear_force_3_axes);

void hunt_crossley_force_3_axes(benchmark::State& state) {
  run_force(state, limpid::HuntCrossley<3>({.exponent = 1.3}), Eigen::Array<double, 3, 3>::Constant(100));
}
BENCHMARK(hunt_crossley_force_3_axes);

template <limpid::Environment E>
void run_tool(benchmark::State& state, const E& e, const limpid::EnvironmentTheta<E>& theta) {
  limpid::VirtualTool<E> tool({.environment = e, .theta = theta, .tool = {.mass = 0.1, .damping = 0.1}});
  Eigen::Array3d F_h{3, 1, 2};
  limpid::Time now{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(F_h);
    benchmark::DoNotOptimize(tool.advance(now, F_h));
    now += 1ms;
  }
}

void virtual_tool_kelvin_voigt_3_axes(benchmark::State& state) {
  run_tool(state, limpid::KelvinVoigt<3>{}, Eigen::Array<double, 3, 2>::Constant(100));
}
BENCHMARK(virtual_tool_kelvin_voigt_3_axes);

void virtual_tool_smooth_bilinear_3_axes(benchmark::State& state) {
  Eigen::Array<double, 3, 3> theta;
  theta.rowwise() = Eigen::Array<double, 1, 3>{200, 2000, 30};
  run_tool(state, limpid::SmoothBilinear<3>({.depth = 0.00284, .sharpness = 20}), theta);
}
BENCHMARK(virtual_tool_smooth_bilinear_3_axes);

}  // namespace
