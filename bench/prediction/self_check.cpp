// SPDX-License-Identifier: MIT
#include "prediction/self_check.hpp"

#include "prediction/choice.hpp"
#include "prediction/device_press.hpp"
#include "prediction/matrix.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>

namespace limpid::bench {

namespace {

const Tissue& tissue(const std::string& name) { return *std::ranges::find(tissues(), name, &Tissue::name); }

Force constant(double newtons) {
  return {"constant", [=](double) { return newtons; }};
}

// m x'' + B x' + k x = F from rest: x = F/k (1 - (p2 exp(p1 t) - p1 exp(p2 t)) / (p2 - p1)), p of m p^2 + B p + k = 0.
// A step of the method errs by (p h)^5 / 120, p h < .016: 1e-11, 1e-8 over the slow time constant's 1600 steps.
bool linear_tissue_moves_as_its_solution() {
  const double k = 800, B = 30 + tool_damping, F = 2, root = std::sqrt(B * B - 4 * tool_mass * k);
  const double p1 = (-B + root) / (2 * tool_mass), p2 = (-B - root) / (2 * tool_mass);
  const Truth truth = simulate(tissue("linear800"), constant(F), {}, 1);
  double worst = 0;
  for (std::size_t i = 0; i < truth.ticks.size(); ++i) {
    const double t = static_cast<double>(i) * tick_seconds;
    const double x = F / k * (1 - (p2 * std::exp(p1 * t) - p1 * std::exp(p2 * t)) / (p2 - p1));
    worst = std::max(worst, std::abs(truth.ticks[i].tool.x - x));
  }
  return worst < 1e-8 * F / k;
}

bool friction_holds_what_it_can() {
  const TissueChange friction{.friction = 0.1};
  const auto at_rest = [](const TrueTick& tick) { return tick.tool.x == 0 && tick.tool.v == 0; };
  const Truth held = simulate(tissue("linear800"), constant(0.09), friction, 1);
  const Truth moved = simulate(tissue("linear800"), constant(0.11), friction, 1);
  return std::ranges::all_of(held.ticks, at_rest) && held.ticks.back().F_e == 0.09 && moved.ticks.back().tool.x > 0;
}

// A Maxwell branch has relaxed after 20 lags: the tool stands where the spring alone holds it.
bool relaxation_ends_at_the_spring() {
  const Truth truth = simulate(tissue("linear800"), constant(2), {.relaxation = 200, .lag = 0.1}, 3);
  return std::abs(truth.ticks.back().tool.x - 2.0 / 800) < 1e-8;
}

Truth ramp(double seconds) {
  Truth truth{.ticks = {}, .step_at = seconds / 2, .step_shows = seconds / 2};
  const auto count = static_cast<std::size_t>(std::llround(seconds / tick_seconds)) + 1;
  for (std::size_t k = 0; k < count; ++k) {
    truth.ticks.push_back({{.x = static_cast<double>(k) * 1e-6, .v = 1e-3}, 0, static_cast<double>(k) * 1e-5});
  }
  return truth;
}

bool samples_come_a_period_apart() {
  const Truth truth = ramp(20);
  const auto samples = sampled(truth, 100, {}, 1);
  bool good = samples.size() == 201;
  for (std::size_t i = 0; good && i < samples.size(); ++i) {
    const auto& [taken, arrived, x, v, F_e] = samples[i];
    const TrueTick& tick = truth.ticks[taken];
    good = taken == 100 * i && arrived == taken + 100 && x == tick.tool.x && v == tick.tool.v && F_e == tick.F_e;
  }
  return good;
}

// Of 10000 samples 500 +- 22 are lost: five deviations.
bool samples_are_lost_and_late() {
  const Truth truth = ramp(20);
  const auto left = static_cast<double>(sampled(truth, 2, {.loss = 0.05}, 1).size());
  bool good = std::abs(left - 9500) < 110;
  const auto samples = sampled(truth, 100, {.position_step = 1e-5, .jitter = 0.2}, 1);
  for (std::size_t i = 0; good && i < samples.size(); ++i) {
    const double off = std::abs(static_cast<double>(samples[i].taken) - 100 * static_cast<double>(i));
    const double steps = samples[i].x / 1e-5;
    good = off <= 20.5 && std::abs(steps - std::round(steps)) < 1e-9;
  }
  return good;
}

// Hold errs by 1 but in the second window, where it does not, and the trace by half of that.
bool windows_are_judged() {
  const Truth truth = ramp(20);
  Trace hold, half;
  for (std::size_t k = 0; k < truth.ticks.size(); ++k) {
    const double error = k >= 4000 && k < 8000 ? 0 : 1;
    const auto& s = truth.ticks[k].tool;
    hold.push_back({s.x, s.v + error});
    half.push_back({s.x, s.v + error / 2});
  }
  const Figures figures = judge(truth, half, hold, late_seconds);
  bool good = figures.windows.size() == 5;
  for (const double figure : {figures.early, figures.late, figures.worst})
    good = good && std::abs(figure - 0.5) < 1e-12;
  for (const Window& window : figures.windows) good = good && window.judged == (window.start != 4);
  return good && std::abs(figures.windows.front().hold_error - 2) < 1e-12;
}

Selection small(const std::vector<std::string>& predictors) {
  return selected({.tissues = {"linear800", "A"},
                   .forces = {"cosine"},
                   .disturbances = {"clean", "loss", "stiffness-step"},
                   .predictors = predictors,
                   .periods = {0.1},
                   .seconds = 12});
}

// A linear law is known from the first sample on. Four steps a tick, p h < .08: (p h)^4 / 120 of hold's error.
bool floor_of_a_linear_tissue_is_exact() {
  const auto rows = run_matrix(small({"hold"}), 1);
  return std::ranges::all_of(rows, [](const Row& row) {
    return row.predictor != 1 || row.tissue != 0 || row.disturbance == 2 || row.figures.late < 4e-7;
  });
}

bool ideal_has_no_error_and_hold_its_own() {
  const auto rows = run_matrix(small({"hold", "ideal"}), 1);
  return std::ranges::all_of(rows, [](const Row& row) {
    const Figures& f = row.figures;
    return row.predictor > 1 || (f.early == f.late && f.late == f.worst && f.worst == (row.predictor == 0 ? 1 : 0));
  });
}

// Of the arm: what it follows perfectly is not wrong by a tenth of what comes 100 to 200 ms late.
bool ideal_arm_follows_the_true_signal() {
  const Truth truth = simulate(tissue("A"), synthetic_forces().front(), {}, 12);
  const auto samples = sampled(truth, 100, {}, 1);
  const Course course{truth, samples, 100};
  const Press ideal = press(truth, contenders().back().run(course), Follower::ideal);
  const Press hold = press(truth, contenders().front().run(course), Follower::ideal);
  return ideal.late < 0.1 * hold.late && !ideal.out_of_reach();
}

bool threads_change_nothing() {
  const Selection selection = small({"linear", "curve"});
  const auto alone = run_matrix(selection, 1), together = run_matrix(selection, 3);
  return std::ranges::equal(alone, together, [](const Row& l, const Row& r) {
    return l.disturbance == r.disturbance && l.tissue == r.tissue && l.predictor == r.predictor &&
           l.figures.early == r.figures.early && l.figures.late == r.figures.late && l.figures.worst == r.figures.worst;
  });
}

}  // namespace

bool self_check() {
  struct Check {
    const char* what;
    bool (*met)();
  };
  bool all = true;
  for (const auto& [what, met] : {
           Check{"a linear tissue moves as its solution", linear_tissue_moves_as_its_solution},
           Check{"friction holds what it can", friction_holds_what_it_can},
           Check{"relaxation ends at the spring", relaxation_ends_at_the_spring},
           Check{"samples come a period apart", samples_come_a_period_apart},
           Check{"samples are lost, late and quantised as asked", samples_are_lost_and_late},
           Check{"windows are judged over hold's error", windows_are_judged},
           Check{"the floor of a linear tissue is exact", floor_of_a_linear_tissue_is_exact},
           Check{"ideal has no error, hold its own", ideal_has_no_error_and_hold_its_own},
           Check{"an ideal arm follows the true signal, and hold less well", ideal_arm_follows_the_true_signal},
           Check{"threads change nothing", threads_change_nothing},
       }) {
    const bool good = met();
    std::printf("%s: %s\n", what, good ? "met" : "MISSED");
    all = all && good;
  }
  return all;
}

}  // namespace limpid::bench
