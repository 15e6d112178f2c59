// SPDX-License-Identifier: MIT
// A tool in a tissue whose samples come every 100 ms, 100 ms late: held, and predicted to the present.
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/evaluation/error_norms.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <cmath>
#include <cstdio>

using namespace limpid;
using namespace std::chrono_literals;
using Tissue = KelvinVoigt<1>;
using Vector = Tool<1>::Vector;

template <Predictor P>
double l2_error(P predictor) {
  VirtualTool<Tissue> truth({.theta = {800, 30}, .tool = {.mass = 0.1, .damping = 0.1}});
  DelayedSampled<ToolState<1>> sampled({.period = 100ms, .delay = 100ms});
  ErrorNorms<1> error;
  for (Time now = 0ms; now <= 5s; now += 1ms) {
    const Vector F_h(1.5 * (1 - std::cos(6 * in_seconds(now))));
    const ToolState<1> tool = truth.advance(now, F_h).value;
    const auto seen = sampled.update(now, tool);
    if (seen.fresh) (void)predictor.observe({seen.value, seen.taken, seen.arrived});
    const Motion<1> motion = predictor.advance(now, F_h).motion;
    (void)error.add(now, motion.x - tool.x, motion.v - tool.v);
  }
  return error.total().l2;
}

int main() {
  using Model = ModelPredictor<Tissue, Tool<1>, Known>;
  const double held = l2_error(HoldPredictor<1>{});
  const double rough =
      l2_error(Model({.tool = {.mass = 0.1, .damping = 0.1}, .theta = {1000, 35}, .gain = {-195.1, -4.89}}));
  const double exact = l2_error(Model({.tool = {.mass = 0.1, .damping = 0.1}, .theta = {800, 30}}));
  std::printf("L2 error: held %.4g, predicted with parameters 20 %% off %.4g, with the true ones %.4g\n", held, rough,
              exact);
  return rough < held && exact < 1e-11 * held ? 0 : 1;
}
