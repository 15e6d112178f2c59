// SPDX-License-Identifier: MIT
#include "design_options.hpp"

#include "option_values.hpp"
#include "output_file.hpp"

#include <limpid/design/sampled_polynomial.hpp>

#include <map>

namespace limpid::examples {

namespace {

// As typed; what is absent takes its default from the rest.
struct Typed {
  std::string theorem = "3", criterion = "margin", tool = "0.1,0.1,1", environment = "1100,30", box = "200:2000,20:40",
              rates = "180000,2000", period = "1/60", delay, gain, grid = "200:100:2000,20:1:40", json, plot;
  std::string a2 = "0.4694", a3 = "0.00898", gamma = "100";
  int knots = 0, threads = 0;
};

const std::map<std::string, DesignTheorem> theorems{{"2", DesignTheorem::two},
                                                    {"3", DesignTheorem::three},
                                                    {"5", DesignTheorem::five},
                                                    {"sampled", DesignTheorem::sampled},
                                                    {"delay", DesignTheorem::delay}};
const std::map<std::string, DesignCriterion> criteria{{"first", DesignCriterion::first},
                                                      {"margin", DesignCriterion::margin},
                                                      {"bound", DesignCriterion::bound},
                                                      {"radius", DesignCriterion::radius}};

const char* help_of_theorem(DesignCommand command) {
  switch (command) {
    case DesignCommand::solve:
      return "2, 3: a gain by the matrix inequality (4.17), (4.31), at --environment or, with --box, with common "
             "matrices over the box; 5: a scheduled gain L0 + L1 k_e + L2 b_e over the box, (4.51); sampled: the gain "
             "of smallest spectral radius of the sampled predictor, in closed form";
    case DesignCommand::verify:
      return "2, 3: the inequality at --environment or, with --box, with common matrices over the box; 5: over the "
             "box; sampled: proof that the sampled predictor is stable, at a point or over the box; delay: the "
             "rightmost root of the continuous delay system";
    case DesignCommand::map:
      return "2, 3: the inequality in each cell, with --gain or, without it, for any gain; 5: one set of variables, "
             "found at --environment, tested in every cell, section 4.4.1; sampled, delay: stability in each cell";
    case DesignCommand::robust:
      return "sampled, the only one: the gain of smallest worst spectral radius over the box, with a proof";
  }
  return "";
}

// Shared by all, so that one list of them serves every command; a theorem takes of them what it needs.
void add_shared(CLI::App& app, Typed& typed) {
  const auto add = [&](const char* option, std::string& to, const char* help) {
    app.add_option(option, to, help)->capture_default_str();
  };
  add("--tool", typed.tool, "M,B,K: kg, N s/m, N/m");
  add("--environment", typed.environment, "K,B of the tissue, N/m, N s/m");
  add("--box", typed.box, "K1:K2,B1:B2 of the tissue, N/m, N s/m; where given, the box is asked about");
  add("--rates", typed.rates, "K',B' of theorem 5: fastest change, N/m/s, N s/m/s");
  add("--period", typed.period, "T_d, s; also as a fraction");
  app.add_option("--delay", typed.delay, "of the sampled predictor, s; default: the period");
  add("--a2", typed.a2, "M2 = a2 M1");
  add("--a3", typed.a3, "M3 = a3 M1, s");
  add("--gamma", typed.gamma, "of (4.31); a pure scale");
  app.add_option("--json", typed.json, "write the figures here");
  app.add_option("--plot", typed.plot, "draw the regions here (SVG)");
  app.add_option("--threads", typed.threads, "that work at once; 0: as many as the machine has")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

void add_theorem(CLI::App& app, Typed& typed, DesignCommand command) {
  app.add_option("--theorem", typed.theorem, help_of_theorem(command))
      ->check(command == DesignCommand::robust  ? CLI::IsMember({"sampled"})
              : command == DesignCommand::solve ? CLI::IsMember({"2", "3", "5", "sampled"})
                                                : CLI::IsMember({"2", "3", "5", "sampled", "delay"}));
}

CLI::Option* add_gain(CLI::App& app, Typed& typed) {
  return app.add_option("--gain", typed.gain, "L1,L2 (N/m, N s/m); six numbers: L0, L1, L2 of theorem 5 by rows");
}

void add_commands(CLI::App& app, Typed& typed) {
  CLI::App* solve = app.add_subcommand("solve", "Design a gain, with a certificate or a proof that there is none.");
  CLI::App* verify = app.add_subcommand("verify", "Judge a gain: inequality, sampled system, continuous system.");
  CLI::App* map = app.add_subcommand("map", "Judge a gain on a grid of tissues.");
  CLI::App* robust =
      app.add_subcommand("robust", "The gain of smallest worst spectral radius over a box, proved over all of it.");
  add_theorem(*solve, typed, DesignCommand::solve);
  solve
      ->add_option("--criterion", typed.criterion,
                   "of 2 and 3, which of the feasible gains: largest margin, smallest error bound, smallest sampled "
                   "radius, or the first one found")
      ->check(CLI::IsMember({"margin", "bound", "radius", "first"}))
      ->capture_default_str();
  solve->add_option("--spline", typed.knots, "of 5: KNOTS of B-splines in the place of an affine dependence")
      ->check(CLI::Range(2, 8));
  add_theorem(*verify, typed, DesignCommand::verify);
  add_gain(*verify, typed)->required();
  add_theorem(*map, typed, DesignCommand::map);
  add_gain(*map, typed);
  map->add_option("--grid", typed.grid, "K1:DK:K2,B1:DB:B2, both ends included")->capture_default_str();
  add_theorem(*robust, typed, DesignCommand::robust);
  add_gain(*robust, typed)->description("L1,L2 (N/m, N s/m) to be judged, where none is to be sought");
  for (CLI::App* command : {solve, verify, map, robust}) add_shared(*command, typed);
  app.require_subcommand(1);
}

Tool<1> tool_of(const Typed& typed) {
  const auto m = numbers("--tool", typed.tool, ",,", "M,B,K: three numbers");
  Tool<1> tool{.mass = m[0], .damping = m[1], .stiffness = m[2]};
  check_as("--tool", [&] { tool.check(); });
  if (tool.mass < 1e-6) refuse("--tool", "a mass of 1e-6 kg or more", typed.tool);
  return tool;
}

TissueBox<> box_of(const Typed& typed) {
  const auto b = numbers("--box", typed.box, ":,:", "K1:K2,B1:B2");
  TissueBox<> box{{b[0], b[2]}, {b[1], b[3]}};
  check_as("--box", [&] { box.check(); });
  return box;
}

Grid<> grid_of(const Typed& typed) {
  const auto g = numbers("--grid", typed.grid, "::,::", "K1:DK:K2,B1:DB:B2");
  Grid<> grid{{g[0], g[1], g[2]}, {g[3], g[4], g[5]}};
  check_as("--grid", [&] { grid.check(); });
  if (grid.size() > 4'000'000) refuse("--grid", "at most 4e6 cells", std::to_string(grid.size()));
  return grid;
}

void take_gain(DesignTask& task, const Typed& typed) {
  const auto two = numbers_of(typed.gain, ","), six = numbers_of(typed.gain, ",,,,,");
  if (!two && !six) refuse("--gain", "two or six numbers with commas between", typed.gain);
  const auto all = numbers("--gain", typed.gain, two ? "," : ",,,,,", "numbers");
  task.scheduled = six.has_value();
  if (task.scheduled && task.theorem != DesignTheorem::five) {
    refuse("--gain", "six numbers with --theorem 5 only; two with", name(task.theorem));
  }
  AffineGain<> gain;
  gain.L0 << all[0], all[1];
  if (task.scheduled) {
    gain.L1 << all[2], all[3];
    gain.L2 << all[4], all[5];
  }
  task.gain = gain;
}

bool is_given(const CLI::App& command, const char* option) {
  const CLI::Option* found = command.get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

void refuse_strangers(const CLI::App& command, const DesignTask& task) {
  const auto given = [&](const char* option) { return is_given(command, option); };
  if (given("--spline") && task.theorem != DesignTheorem::five) {
    refuse("--spline", std::string("goes with --theorem 5, got ") + name(task.theorem));
  }
  const bool of_schedule = task.criterion == DesignCriterion::margin || task.criterion == DesignCriterion::first;
  if (given("--criterion") && task.theorem == DesignTheorem::five && !of_schedule) {
    refuse("--criterion", "accepts margin or first with --theorem 5");
  }
  if (given("--criterion") && task.theorem == DesignTheorem::sampled) {
    refuse("--criterion", "goes with --theorem 2, 3 or 5, got sampled");
  }
  const bool of_any_gain = task.theorem == DesignTheorem::two || task.theorem == DesignTheorem::three;
  if (!given("--gain") && task.command == DesignCommand::map && !of_any_gain) {
    refuse("--gain", std::string("is needed by map with --theorem ") + name(task.theorem));
  }
  if (given("--box") && task.command == DesignCommand::map) {
    refuse("--box", "goes with solve, verify and robust; map takes --grid");
  }
}

DesignTask task_of(const CLI::App& command, const Typed& typed) {
  static const std::map<std::string, DesignCommand> commands{{"solve", DesignCommand::solve},
                                                             {"verify", DesignCommand::verify},
                                                             {"map", DesignCommand::map},
                                                             {"robust", DesignCommand::robust}};
  DesignTask task;
  task.command = commands.at(command.get_name());
  task.theorem = theorems.at(task.command == DesignCommand::robust ? "sampled" : typed.theorem);
  task.criterion = criteria.at(typed.criterion);
  refuse_strangers(command, task);
  task.design.tool = tool_of(typed);
  task.design.T_d = number("--period", typed.period, "seconds in [1e-6, 1e3]", 1e-6, 1e3);
  task.delay =
      !is_given(command, "--delay") ? task.design.T_d : number("--delay", typed.delay, "seconds in [0, 1e3]", 0, 1e3);
  const SampledSystem<> sampled{.tool = task.design.tool, .period = task.design.T_d, .delay = task.delay};
  check_as("--delay", [&] { sampled.check(); });
  task.design.a2 = number("--a2", typed.a2, "a number other than 0", -1e9, 1e9);
  task.design.a3 = number("--a3", typed.a3, "a number other than 0, s", -1e9, 1e9);
  if (task.design.a2 == 0) refuse("--a2", "a number other than 0", typed.a2);
  if (task.design.a3 == 0) refuse("--a3", "a number other than 0, s", typed.a3);
  task.gamma = number("--gamma", typed.gamma, "a number in [1e-12, 1e12]", 1e-12, 1e12);
  const auto e = numbers("--environment", typed.environment, ",", "K,B: two numbers");
  task.environment = {e[0], e[1]};
  check_as("--environment", [&] { task.design.check(task.environment); });
  task.box = box_of(typed);
  check_as("--box", [&] { task.design.check(task.box.lower); });
  const auto r = numbers("--rates", typed.rates, ",", "K',B': two numbers");
  task.rates = {r[0], r[1]};
  check_as("--rates", [&] { task.rates.check(); });
  task.grid = grid_of(typed);
  check_as("--grid", [&] { task.design.check(task.grid[0]); });
  if (is_given(command, "--gain")) take_gain(task, typed);
  task.knots = typed.knots;
  task.threads = typed.threads;
  const bool box_typed = command.count("--box") > 0;
  const bool point_typed = task.command != DesignCommand::robust && command.count("--environment") > 0;
  task.over_box =
      box_typed || task.command == DesignCommand::robust || (task.theorem == DesignTheorem::five && !point_typed);
  return task;
}

}  // namespace

const char* name(DesignTheorem theorem) {
  switch (theorem) {
    case DesignTheorem::two:
      return "2";
    case DesignTheorem::three:
      return "3";
    case DesignTheorem::five:
      return "5";
    case DesignTheorem::sampled:
      return "sampled";
    default:
      return "delay";
  }
}

DesignOptions parse_design_options(int argc, const char* const* argv) {
  CLI::App app{"Gains of the predictor, (4.12): designed, verified and mapped, with certificates.", "design_gain"};
  Typed typed;
  add_commands(app, typed);
  DesignOptions options;
  try {
    app.parse(argc, argv);
    const CLI::App& command = *app.get_subcommands().front();
    options.task = task_of(command, typed);
    for (const char* output : {"--json", "--plot"}) {
      if (command.count(output) == 0) continue;
      const std::string refusal = refusal_of_output(std::string(output) == "--json" ? typed.json : typed.plot);
      if (!refusal.empty()) refuse(output, refusal);
    }
    if (!typed.json.empty() && !typed.plot.empty() && is_same_file(typed.json, typed.plot))
      refuse("--json, --plot", "different files", typed.json);
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error);
    return options;
  }
  options.json = typed.json;
  options.plot = typed.plot;
  return options;
}

}  // namespace limpid::examples
