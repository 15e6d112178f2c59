// SPDX-License-Identifier: MIT
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/environment/virtual_tool.hpp>

#include <benchmark/benchmark.h>

#include <string>
#include <type_traits>

namespace {

using namespace std::chrono_literals;

// One of three axes, or all.
template <int axes>
Eigen::Array<double, axes, 1> first(double x, double y, double z) {
  return Eigen::Array3d(x, y, z).head<axes>();
}

// What is asked of an environment at a point.
struct Force {
  template <typename E, typename... At>
  auto operator()(const E& e, const At&... at) const noexcept {
    return e.force(at...);
  }
};
struct Tangent {
  template <typename E, typename... At>
  auto operator()(const E& e, const At&... at) const noexcept {
    return e.tangent(at...);
  }
};
struct Response {
  template <typename E, typename... At>
  auto operator()(const E& e, const At&... at) const noexcept {
    return limpid::response_of(e, at...);
  }
};

// Flat, as a predictor is.
template <typename Ask, typename Make>
[[gnu::flatten]] void run(benchmark::State& state, Make make) {
  const auto e = make();
  using E = std::remove_const_t<decltype(e)>;
  const auto theta = limpid::EnvironmentTheta<E>::Constant(100).eval();
  auto x = first<E::axes>(0.003, 0.001, 0.002), v = first<E::axes>(0.01, -0.02, 0.005);
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    benchmark::DoNotOptimize(v);
    benchmark::DoNotOptimize(Ask{}(e, theta, x, v));
  }
}

template <typename Make>
void add(const std::string& name, Make make) {
  benchmark::RegisterBenchmark((name + "_force").c_str(), run<Force, Make>, make);
  benchmark::RegisterBenchmark((name + "_tangent").c_str(), run<Tangent, Make>, make);
  benchmark::RegisterBenchmark((name + "_response").c_str(), run<Response, Make>, make);
}

template <int axes>
bool add_models(const std::string& of) {
  using namespace limpid;
  add("kelvin_voigt_" + of, [] { return KelvinVoigt<axes>{}; });
  add("smooth_bilinear_" + of, [] { return SmoothBilinear<axes>({.depth = 0.00284, .sharpness = 20}); });
  add("hunt_crossley_" + of, [] { return HuntCrossley<axes>({.exponent = 1.3}); });
  add("unilateral_kelvin_voigt_" + of, [] {
    using Wall = Unilateral<KelvinVoigt<axes>>;
    return Wall(typename Wall::Settings{});
  });
  return true;
}

[[maybe_unused]] const bool added = add_models<1>("1_axis") && add_models<3>("3_axes");

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
