// SPDX-License-Identifier: MIT
#include "transparency_options.hpp"

#include "option_values.hpp"
#include "output_file.hpp"

#include <limpid/design/transfer_function.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

namespace limpid::examples {

namespace {

// As typed; the defaults are those of section 4 of the paper and its Fig. 8.
struct Typed {
  std::string mass = "0.01", damping = "0.022", stiffness = "1000", wall_damping = "1", period = "0.001",
              uncertainty = "0.5,0.5", weight = "100", zoh = "A", gains = "1,5,10,15,20,25", velocity, delay = "0",
              cutoff, radius = "1", step, json, plot;
  bool free = false;
};

const std::map<std::string, HoldModel> holds{
    {"A", HoldModel::second_order}, {"B", HoldModel::first_order}, {"C", HoldModel::exact}};
const std::map<std::string, VelocitySource> velocities{{"measured", VelocitySource::sampled},
                                                       {"sampled", VelocitySource::sampled},
                                                       {"difference", VelocitySource::backward_difference}};

void add_options(CLI::App& app, Typed& typed) {
  const auto add = [&](const char* option, std::string& to, const char* help) {
    return app.add_option(option, to, help)->capture_default_str();
  };
  add("--mass", typed.mass, "m of the device, kg");
  add("--damping", typed.damping, "b of the device, N s/m");
  add("--stiffness", typed.stiffness, "K of the wall, N/m");
  add("--wall-damping", typed.wall_damping, "B of the wall, N s/m");
  add("--period", typed.period, "T of the controller, s; also as a fraction");
  add("--uncertainty", typed.uncertainty, "alpha,beta: parts by which mass and damping may differ, (13)");
  add("--weight", typed.weight, "cut-off of the first-order weight w1 of (11), rad/s");
  add("--zoh", typed.zoh, "model of the hold: A second order, B first order, C exact")
      ->check(CLI::IsMember({"A", "B", "C"}));
  add("--gains", typed.gains, "B_c of the table, and of --step, N s/m");
  app.add_flag("--free", typed.free, "seek the stiffness gain K_c too; else it is the wall's stiffness");
  app.add_option(
         "--velocity", typed.velocity,
         "of the sampled loop: measured (also: sampled), or the backward difference of the position; default: both are "
         "judged, the step has the difference")
      ->check(CLI::IsMember({"measured", "sampled", "difference"}));
  add("--delay", typed.delay, "of the sampled loop, from measuring to acting, s");
  app.add_option("--cutoff", typed.cutoff, "of a first-order low-pass of the velocity, Hz; default: none");
  add("--radius", typed.radius, "bound of the sampled loop's spectral radius; below 1: with a margin");
  app.add_option("--step", typed.step, "force of the operator, N: the sampled loop's response to it");
  app.add_option("--json", typed.json, "write the figures here");
  app.add_option("--plot", typed.plot, "draw the paper's figures into this folder (SVG)");
}

std::vector<double> gains_of(const Typed& typed) {
  const auto commas = static_cast<std::size_t>(std::count(typed.gains.begin(), typed.gains.end(), ','));
  if (commas >= 1000) refuse("--gains", "at most 1000 gains", std::to_string(commas + 1));
  const auto gains = numbers("--gains", typed.gains, std::string(commas, ','), "numbers with commas between");
  for (const double gain : gains) {
    if (!(gain >= 0 && gain <= 1e9)) refuse("--gains", "gains in [0, 1e9] N s/m", typed.gains);
  }
  return gains;
}

TransparencyProblem<> problem_of(const Typed& typed) {
  TransparencyProblem<> problem;
  problem.plant.mass = number("--mass", typed.mass, "kg in [1e-6, 1e6]", 1e-6, 1e6);
  problem.plant.damping = number("--damping", typed.damping, "N s/m in [0, 1e6]", 0, 1e6);
  problem.wall.stiffness = number("--stiffness", typed.stiffness, "N/m in [1e-6, 1e9]", 1e-6, 1e9);
  problem.wall.damping = number("--wall-damping", typed.wall_damping, "N s/m in [0, 1e6]", 0, 1e6);
  problem.period = number("--period", typed.period, "seconds in [1e-6, 10]", 1e-6, 10);
  problem.hold = holds.at(typed.zoh);
  const auto parts = numbers("--uncertainty", typed.uncertainty, ",", "alpha,beta: two numbers");
  problem.uncertainty = {parts[0], parts[1]};
  check_as("--uncertainty", [&] { problem.uncertainty.check(); });
  problem.weight = first_order_weight(number("--weight", typed.weight, "rad/s in [1e-6, 1e9]", 1e-6, 1e9));
  return problem;
}

TransparencyTask task_of(const Typed& typed) {
  TransparencyTask task;
  task.problem = problem_of(typed);
  task.weight = *number_of(typed.weight);
  task.free = typed.free;
  task.gains = gains_of(typed);
  task.velocities = {VelocitySource::sampled, VelocitySource::backward_difference};
  if (!typed.velocity.empty()) {
    task.step_velocity = velocities.at(typed.velocity);
    task.velocities = {task.step_velocity};
  }
  if (!typed.cutoff.empty()) task.cutoff = number("--cutoff", typed.cutoff, "Hz in [1e-6, 1e9]", 1e-6, 1e9);
  task.delay = number("--delay", typed.delay, "seconds in [0, 1e3]", 0, 1e3);
  check_as("--delay", [&] { task.loop(task.step_velocity).check(); });
  task.radius = number("--radius", typed.radius, "a number in [0.001, 1]", 0.001, 1);
  if (!typed.step.empty()) {
    task.force = number("--step", typed.step, "N, not 0, of at most 1e6 in magnitude", -1e6, 1e6);
    if (*task.force == 0) refuse("--step", "a force other than 0", typed.step);
  }
  return task;
}

void check_outputs(const Typed& typed) {
  const std::string refusal = typed.json.empty() ? std::string{} : refusal_of_output(typed.json);
  if (!refusal.empty()) refuse("--json", refusal);
  if (typed.plot.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(typed.plot, error);
  if (error || !std::filesystem::is_directory(typed.plot)) refuse("--plot", "a folder that can be made", typed.plot);
}

// An empty value is none, and the subcommand has options of its own.
void refuse_strangers(const CLI::App& app) {
  const bool decoupled = !app.get_subcommands().empty();
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0) continue;
    if (decoupled) refuse(option->get_name(), "goes without decouple, or after it");
    if (!option->results().empty() && option->results().front().empty()) {
      refuse(option->get_name(), "accepts a value, not an empty one");
    }
  }
}

}  // namespace

TransparencyOptions parse_transparency_options(int argc, const char* const* argv) {
  CLI::App app{"How much of a virtual wall a hand feels through a device, and for which gains the loop is stable.",
               "transparency"};
  Typed typed;
  DecoupleOptions decouple_typed;
  add_options(app, typed);
  CLI::App* decouple = app.add_subcommand(
      "decouple", "A five-bar with and without disturbance observers: a force along x, the motion along y.");
  add_decouple_options(*decouple, decouple_typed);
  TransparencyOptions options;
  try {
    app.parse(argc, argv);
    refuse_strangers(app);
    if (decouple->parsed()) {
      options.decouple = decouple_typed;
      return options;
    }
    options.task = task_of(typed);
    check_outputs(typed);
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error);
    return options;
  }
  options.json = typed.json;
  options.plot = typed.plot;
  return options;
}

}  // namespace limpid::examples
