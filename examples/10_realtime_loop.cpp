// SPDX-License-Identifier: MIT
// A second of a loop at 1 kHz by the machine's clock; the tissue is on a thread of its own, truly slow and late.
// With CAP_SYS_NICE and CAP_IPC_LOCK the loop is a real-time one; without them the report says so. Ctrl-C ends it.
#include <limpid/control/fade.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/loop/realtime/environment_link.hpp>
#include <limpid/loop/realtime/periodic_loop.hpp>
#include <limpid/loop/realtime/slow_environment.hpp>
#include <limpid/loop/realtime/stop_on_signal.hpp>
#include <limpid/prediction/replay_predictor.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

using namespace limpid;
using namespace std::chrono_literals;
using Tissue = KelvinVoigt<1>;

int main() {
  const Tool<1> tool{.mass = 0.1, .damping = 0.1};
  const VirtualTool<Tissue> pressed({.theta = {800, 30}, .tool = tool});

  EnvironmentExchange<1> exchange;
  SlowEnvironment tissue(exchange, pressed, {.period = 30ms, .delay = 20ms});
  const std::jthread tissue_thread = tissue.start();

  EnvironmentLink link(exchange, {.longest_age = 150ms});
  ReplayPredictor<Tissue, Tool<1>, Known> predictor({.tool = tool, .theta = {800, 30}});
  Fade fade({.fade_out = 20ms, .fade_in = 100ms, .hold = 10ms});
  VirtualTool<Tissue> truth = pressed;  // not slow, to compare with
  double held_error = 0, error = 0, largest_force = 0;
  int samples = 0;

  PeriodicLoop loop({.period = 1ms, .duration = 1s, .thread = {.priority = 80, .cpu = 0, .lock_memory = true}});
  std::stop_source stop;
  const StopOnSignal on_signal(stop);
  loop.run(stop.get_token(), [&](const TickTime& at) noexcept {
    const Tool<1>::Vector F_h(1.5 * (1 - std::cos(12 * 1e-3 * static_cast<double>(at.index))));
    const double true_x = truth.advance(at.now, F_h).value.x[0];
    const Status sent = link.send(at.now, F_h);
    const auto& seen = link.read(at.now);
    if (seen.fresh) (void)predictor.observe({seen.value, seen.taken, seen.arrived});
    const Motion<1> motion = predictor.advance(at.now, F_h).motion;
    const double force = fade.update(at.now, seen.status == Status::ok) * (800 * motion.x[0] + 30 * motion.v[0]);
    samples += seen.fresh ? 1 : 0;
    largest_force = std::max(largest_force, force);
    held_error = std::max(held_error, std::abs(seen.value.x[0] - true_x));
    error = std::max(error, std::abs(motion.x[0] - true_x));
    return sent | (seen.status & Status::stale);
  });

  std::printf("%s", describe(loop.report()).c_str());
  std::printf("%d samples; largest error held %.3g mm, predicted %.3g mm; largest force %.2f N\n", samples,
              1e3 * held_error, 1e3 * error, largest_force);
  return error <= held_error ? 0 : 1;
}
