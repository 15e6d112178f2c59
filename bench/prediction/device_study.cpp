// SPDX-License-Identifier: MIT
#include "prediction/device_study.hpp"

#include "prediction/parallel.hpp"
#include "prediction/summary.hpp"

#include <common/words.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>

namespace limpid::bench {

namespace {

std::vector<std::size_t> tissues_of(const Selection& selection, bool realistic) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < selection.tissues.size(); ++i) {
    const std::string& name = selection.tissues[i].name;
    if (!realistic || name == "A" || name == "B") chosen.push_back(i);
  }
  return chosen;
}

std::vector<Force> scaled(std::vector<Force> forces, double share) {
  for (Force& force : forces) force.at = [at = force.at, share](double t) { return share * at(t); };
  return forces;
}

// Presses until half time or before, and then half of their force, which stays.
Force presses_then_rests(double newtons, double seconds) {
  const double until = std::floor(seconds / 2 - 1.5) + 0.5;
  return {examples::words("rests at %.3g N", newtons / 2),
          [=](double t) { return newtons * (t < until ? (1 - std::cos(std::numbers::pi * t)) / 2 : 0.5); }};
}

// After a long period a sample corrects the wanted motion by more, and the arm catches up at Lambda times that: a peak.
Follower at_period(Follower follower, std::size_t period) {
  constexpr std::size_t longest = 100;
  return follower == Follower::compensated && period > longest ? Follower::compensated_slow : follower;
}

struct Job {
  std::size_t scenario, tissue, force;
};

std::vector<DeviceRow> run_job(const Selection& selection, const DeviceScenario& scenario, const Job& job) {
  const Truth truth = simulate(selection.tissues[job.tissue], scenario.forces[job.force], {}, selection.seconds);
  const auto followed = [&](const Contender& contender, const Course& course, Follower follower) {
    return press(truth, contender.run(course), follower);
  };
  const Contender &hold = contenders().front(), &ideal = contenders().back();
  std::vector<DeviceRow> rows;
  for (std::size_t p = 0; p < selection.periods.size(); ++p) {
    const std::size_t period = selection.periods[p];
    const auto samples = sampled(truth, period, {}, 1);
    const Course course{truth, samples, period};
    const Follower follower = at_period(scenario.follower, period);
    rows.push_back({.scenario = job.scenario,
                    .tissue = job.tissue,
                    .period = p,
                    .force = job.force,
                    .judged = followed(selection.predictors[judged_predictor(selection)], course, follower),
                    .ideal = followed(ideal, course, follower),
                    .hold = followed(hold, course, scenario.of_hold),
                    .hold_as_judged = followed(hold, course, follower)});
  }
  return rows;
}

auto place_of(const DeviceRow& row) { return std::tie(row.scenario, row.tissue, row.period, row.force); }

}  // namespace

std::vector<DeviceScenario> device_scenarios(const Selection& selection) {
  const auto all = tissues_of(selection, false), pressed = tissues_of(selection, true);
  std::vector<Force> resting;
  for (const double newtons : {1.0, 1.7, 2.0, 3.0}) resting.push_back(presses_then_rests(newtons, selection.seconds));
  const Follower ours = Follower::compensated, of_hold = Follower::best_of_hold;
  return {{"ideal Omni", Follower::ideal, Follower::ideal, selection.forces, all},
          {"realistic Omni", ours, of_hold, selection.forces, pressed},
          {"realistic Omni, 2/3 of the force", ours, of_hold, scaled(selection.forces, 2.0 / 3), pressed},
          {"realistic Omni, coming to rest", ours, of_hold, std::move(resting), pressed, true}};
}

std::vector<DeviceRow> run_device(const Selection& selection, const std::vector<DeviceScenario>& scenarios,
                                  unsigned threads) {
  std::vector<Job> jobs;
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    for (const std::size_t tissue : scenarios[s].tissues) {
      for (std::size_t force = 0; force < scenarios[s].forces.size(); ++force) jobs.push_back({s, tissue, force});
    }
  }
  std::vector<std::vector<DeviceRow>> of_jobs(jobs.size());
  in_parallel(jobs.size(), threads,
              [&](std::size_t i) { of_jobs[i] = run_job(selection, scenarios[jobs[i].scenario], jobs[i]); });
  std::vector<DeviceRow> rows;
  for (auto& of_job : of_jobs) std::ranges::move(of_job, std::back_inserter(rows));
  std::ranges::sort(rows, [](const DeviceRow& l, const DeviceRow& r) { return place_of(l) < place_of(r); });
  return rows;
}

}  // namespace limpid::bench
