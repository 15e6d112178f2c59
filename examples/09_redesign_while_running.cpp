// SPDX-License-Identifier: MIT
// A gain designed anew at every sample of a tissue that is only being learnt, between two ticks of the loop; one
// without a certificate is not used.
#include <limpid/design/sampled_gain.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/estimation/environment_estimator.hpp>
#include <limpid/evaluation/error_norms.hpp>
#include <limpid/evaluation/latency_histogram.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>

using namespace limpid;
using namespace std::chrono_literals;
using SoftTissue = KelvinVoigt<1>;
using Vector = Tool<1>::Vector;

constexpr Duration period = 16ms;
const Tissue<> true_tissue{1700, 24};  // the truth, which is learnt
const Tool<1> tool{.mass = 0.1, .damping = 0.1, .stiffness = 1};

struct Run {
  double error = 0;  // L2
  Gain<> L;          // the last one
  int designs = 0, certified = 0;
  LatencyHistogram taken{};
};

// The gain of smallest spectral radius of the sampled predictor; said to be certified where Theorem 3 holds for it too.
bool design(const Tissue<>& rho, Gain<>& L) {
  const double T = in_seconds(period);
  L = smallest_sampled_radius(SampledSystem<>{tool, T, T}, rho).gain;
  return verify_theorem3(PredictorDesign<>{.tool = tool, .T_d = T}, rho, L).verdict == Verdict::feasible;
}

Run run(const Gain<>& first, bool redesign) {
  VirtualTool<SoftTissue> truth({.theta = {true_tissue.stiffness, true_tissue.damping}, .tool = tool});
  DelayedSampled<ToolState<1>> sampled({.period = period, .delay = period});
  EnvironmentEstimator<SoftTissue> estimator(
      {.environment = {},
       .law = {.lower = {200, 20}, .upper = {2000, 40}, .initial = {1100, 30}, .initial_gain = {1e9, 8e6}}});
  ModelPredictor<SoftTissue> predictor({.tool = tool, .theta = {1100, 30}, .gain = {first[0], first[1]}});
  ErrorNorms<1> error;
  Run result{.L = first};
  for (Time now = 0ms; now <= 5s; now += 1ms) {
    const Vector F_h(1.5 * (1 - std::cos(6 * in_seconds(now))));
    const ToolState<1> state = truth.advance(now, F_h).value;
    const auto seen = sampled.update(now, state);
    (void)estimator.update(now, seen);
    (void)predictor.use(estimator.estimate());
    if (seen.fresh) (void)predictor.observe({seen.value, seen.taken, seen.arrived});
    if (seen.fresh && redesign) {
      const auto start = std::chrono::steady_clock::now();
      const auto theta = estimator.estimate().theta_hat;
      Gain<> L;
      const bool certified = design({theta(0, 0), theta(0, 1)}, L);
      if (certified && predictor.replace_gain({L[0], L[1]}) == Status::ok) {
        result.L = L;
        ++result.certified;
      }
      ++result.designs;
      result.taken.add(std::chrono::steady_clock::now() - start);
    }
    const Motion<1> motion = predictor.advance(now, F_h).motion;
    (void)error.add(now, motion.x - state.x, motion.v - state.v);
  }
  result.error = error.total().l2;
  return result;
}

double radius(const Gain<>& L) {
  return sampled_radius(SampledSystem<>{tool, in_seconds(period), in_seconds(period)}, true_tissue, L);
}

int main() {
  const Run none = run({0, 0}, false), printed = run({-441.3, -12.12}, false), anew = run({0, 0}, true);
  const auto us = [](Duration duration) { return 1e6 * in_seconds(duration); };
  std::printf("%d designs, %d certified and used; half of them within %.0f us, the slowest %.0f us, of %.0f us\n",
              anew.designs, anew.certified, us(anew.taken.quantile(0.5)), us(anew.taken.max()), us(period));
  std::printf("%-20s %12s %16s\n", "", "L2 error", "spectral radius");
  std::printf("%-20s %12.3g %16.3f\n", "without feedback", none.error, radius(none.L));
  std::printf("%-20s %12.3g %16.3f\n", "printed gain", printed.error, radius(printed.L));
  std::printf("%-20s %12.3g %16.3f\n", "designed anew", anew.error, radius(anew.L));
  return anew.certified > 0 && radius(anew.L) < radius(printed.L) ? 0 : 1;
}
