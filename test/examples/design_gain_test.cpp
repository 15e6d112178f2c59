// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <support/ask_program.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

namespace {

using limpid::test::Answer;
using limpid::test::ProgramRun;
using limpid::test::run_program;
using Json = nlohmann::json;

Answer ask(const std::string& arguments) { return limpid::test::ask_program("design_gain", arguments); }

void refused(const std::string& arguments, const std::string& option) {
  limpid::test::check_refused("design_gain", arguments, option);
}

}  // namespace

TEST_CASE("design_gain refuses wrong options and names them") {
  for (const std::string& command : {std::string("solve"), std::string("verify --gain -441.3,-12.12"),
                                     std::string("map --gain -441.3,-12.12"), std::string("robust")}) {
    for (const auto& [option, value] : {std::pair{"--tool", "0,0.1,1"},
                                        std::pair{"--tool", "0.1,0.1"},
                                        std::pair{"--tool", "0.1,-1,0"},
                                        std::pair{"--tool", "a,b,c"},
                                        std::pair{"--environment", "1100"},
                                        std::pair{"--environment", "-5,30"},
                                        std::pair{"--environment", "nan,30"},
                                        std::pair{"--rates", "-1,2"},
                                        std::pair{"--rates", "1"},
                                        std::pair{"--period", "0"},
                                        std::pair{"--period", "-0.1"},
                                        std::pair{"--period", "nan"},
                                        std::pair{"--period", "1/0"},
                                        std::pair{"--delay", "-1"},
                                        std::pair{"--delay", "99"},
                                        std::pair{"--a2", "0"},
                                        std::pair{"--a3", "zero"},
                                        std::pair{"--gamma", "0"},
                                        std::pair{"--theorem", "4"},
                                        std::pair{"--threads", "-1"},
                                        std::pair{"--json", "/"},
                                        std::pair{"--plot", "/no/such/folder/plot.svg"}}) {
      refused(command + " " + option + " " + value, option);
    }
  }
}

TEST_CASE("design_gain refuses gains, boxes and grids that are none") {
  for (const char* gain : {"1", "1,2,3", "1,x", "1,2,", "inf,0", ""})
    refused(std::string("verify --gain '") + gain + "'", "--gain");
  refused("verify", "--gain");
  refused("verify --theorem 3 --gain 1,2,3,4,5,6", "--gain");
  for (const char* box : {"2000:200,20:40", "200:2000", "200,2000,20,40", "-1e3:2000,20:40"}) {
    refused(std::string("robust --box ") + box, "--box");
  }
  for (const char* grid : {"200:100:2000", "200:0:2000,20:1:40", "200:-100:2000,20:1:40", "200:99:2000,20:1:40",
                           "200:1e-3:2000,20:1:40", "-200:100:2000,20:1:40"}) {
    refused(std::string("map --gain 1,2 --grid ") + grid, "--grid");
  }
}

TEST_CASE("design_gain refuses options of another command or theorem") {
  refused("", "subcommand");
  refused("solve --gain 1,2", "--gain");
  refused("robust --theorem 3", "--theorem");
  refused("solve --theorem delay", "--theorem");
  refused("map --theorem sampled", "--gain");
  refused("map --theorem 5", "--gain");
  refused("map --gain 1,2 --box 200:2000,20:40", "--box");
  refused("solve --theorem 3 --spline 4", "--spline");
  refused("solve --theorem 5 --criterion bound", "--criterion");
  refused("solve --unknown 1", "--unknown");
}

TEST_CASE("Table 6.4's gains: 399, 399 and 381 of 399 cells, all certified") {
  struct {
    const char* arguments;
    int feasible;
  } const cases[] = {{"--period 0.016 --gain -441.3,-12.12", 399},
                     {"--period 0.032 --gain -203.3,-5.15", 399},
                     {"--period 0.1 --gain -195.1,-4.89", 381}};
  for (const auto& which : cases) {
    const Answer answer = ask(std::string("map --theorem 3 --grid 200:100:2000,20:1:40 ") + which.arguments);
    CAPTURE(answer.run.output);
    CHECK(answer.json["cells"] == 399);
    CHECK(answer.json["feasible"] == which.feasible);
    CHECK(answer.json["sampled_stable"].is_number());
    CHECK(answer.json["delay_stable"] >= which.feasible);  // what the theorem proves
    REQUIRE(answer.json["list"].size() == 399);
    for (const auto& cell : answer.json["list"]) {
      CHECK(cell["certified"] == true);
      const bool outside =
          which.feasible == 381 && cell["stiffness"] == 200 && cell["damping"] >= 23;  // the notes' list
      CHECK(cell["feasible"] == !outside);
    }
    if (which.feasible == 381) CHECK(answer.run.mentions("k_e = 200 N/m: b_e = 23 to 40 N s/m"));
  }
}

TEST_CASE("margins of the notes' table, to a hundredth") {
  struct {
    const char* arguments;
    double margin;
  } const cases[] = {{"--theorem 2 --period 1/60 --environment 2000,45 --gain -753.2,-17.01", 0.0382},
                     {"--theorem 3 --period 1/60 --environment 2000,25 --gain -574.1,-7.260", 0.0302},
                     {"--theorem 3 --period 0.016 --environment 1100,30 --gain -441.3,-12.12", 0.0217},
                     {"--theorem 3 --period 0.032 --environment 1100,30 --gain -203.3,-5.15", 0.0237},
                     {"--theorem 3 --period 0.1 --environment 1100,30 --gain -195.1,-4.89", 0.0146}};
  for (const auto& which : cases) {
    const Answer answer = ask(std::string("verify ") + which.arguments);
    CHECK(answer.json["feasible"] == true);
    CHECK(answer.json["certified"] == true);
    CHECK(answer.json["margin"].get<double>() == doctest::Approx(which.margin).epsilon(0.01));
  }
}

TEST_CASE("a gain that Theorem 3 certifies and that is unstable sampled is called so in words") {
  const Answer answer =
      ask("verify --theorem 3 --gain -753.2,-17.01 --period 1/60 --environment 400,20 --tool 0.1,0.1,1");
  CHECK(answer.json["feasible"] == true);
  CHECK(answer.json["certified"] == true);
  CHECK(answer.json["sampled_radius"].get<double>() == doctest::Approx(1.017).epsilon(0.0005));
  CHECK(answer.json["delay_root"].get<double>() < 0);
  CHECK(
      answer.run.mentions("Theorem 3 certifies the continuous delay system, yet the sampled predictor is UNSTABLE "
                          "with radius 1.017"));
}

TEST_CASE("robust sampled gains come out as computed independently, and proved") {
  struct {
    const char* period;
    double radius;
  } const cases[] = {{"0.016", 0.632}, {"0.032", 0.568}, {"0.1", 0.376}, {"0.2", 0.200}};
  for (const auto& which : cases) {
    const Answer answer = ask(std::string("robust --box 200:2000,20:40 --period ") + which.period);
    CAPTURE(answer.run.output);
    CHECK(answer.json["gain"].size() == 2);
    CHECK(answer.json["proved"] == true);
    CHECK(answer.json["worst_radius"] <= which.radius + 0.002);
  }
}

TEST_CASE("Theorem 5 on the box: feasible at 16 and 32 ms, infeasible at 100 ms") {
  for (const char* period : {"0.016", "0.032", "0.1"}) {
    CAPTURE(period);
    const Answer answer = ask(std::string("solve --theorem 5 --tool 0.1,0.1,0 --box 200:2000,20:40 --rates 180000,2000 "
                                          "--period ") +
                              period);
    const bool feasible = std::string(period) != "0.1";
    CHECK(answer.json["feasible"] == feasible);
    CHECK(answer.json["certified"] == true);
    if (feasible) {
      CHECK(answer.json["gain"].size() == 6);
    } else {
      CHECK(answer.json["gain"].is_null());
      CHECK(answer.run.mentions("dual certificate"));
    }
  }
}

TEST_CASE("solve designs at a point what verify certifies") {
  for (const char* theorem : {"2", "3"}) {
    for (const char* criterion : {"margin", "bound", "radius", "first"}) {
      if (std::string(theorem) == "2" && std::string(criterion) == "bound") continue;
      CAPTURE(theorem);
      CAPTURE(criterion);
      const Answer answer = ask(std::string("solve --period 0.016 --theorem ") + theorem + " --criterion " + criterion);
      REQUIRE(answer.json["feasible"] == true);
      REQUIRE(answer.json["certified"] == true);
      std::ostringstream gain;
      gain.precision(17);
      gain << answer.json["gain"][0].get<double>() << ',' << answer.json["gain"][1].get<double>();
      const Answer again = ask(std::string("verify --period 0.016 --theorem ") + theorem + " --gain " + gain.str());
      CHECK(again.json["feasible"] == true);
      CHECK(again.json["certified"] == true);
      CHECK(again.json["margin"].get<double>() > 0);
    }
  }
}

TEST_CASE("the gain of smallest radius at a point has the radius that the notes state") {
  const Answer answer = ask("solve --theorem sampled --period 0.016");  // notes: -175.2, -.854 (.174)
  CHECK(answer.json["gain"][0].get<double>() == doctest::Approx(-175.2).epsilon(0.001));
  CHECK(answer.json["gain"][1].get<double>() == doctest::Approx(-0.854).epsilon(0.001));
  CHECK(answer.json["sampled_radius"].get<double>() == doctest::Approx(0.174).epsilon(0.005));
}

TEST_CASE("design_gain draws its map, or writes the values where gnuplot is absent") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_design_gain.svg";
  for (const char* arguments : {"map --gain -195.1,-4.89 --period 0.1", "robust --period 0.1"}) {
    const ProgramRun result = run_program("design_gain", arguments + std::string(" --plot ") + path.string());
    CAPTURE(result.output);
    CHECK(result.code == 0);
    const auto values = std::filesystem::path(path).replace_extension(".curves.csv");
    CHECK((std::filesystem::exists(path) || std::filesystem::exists(values)));
    std::filesystem::remove(path);
    std::filesystem::remove(values);
  }
}

TEST_CASE("a map of the sampled predictor counts what is proved stable, and of the delay system what is stable") {
  // From the notes: at b_e = 20 unstable sampled for k_e = 400 to 700, yet stable in continuous time.
  const std::string arguments = " --gain -753.2,-17.01 --period 1/60 --grid 400:100:700,20:10:30";
  const Json sampled = ask("map --theorem sampled" + arguments).json,
             delay = ask("map --theorem delay" + arguments).json;
  CHECK(sampled["feasible"] == 4);
  CHECK(sampled["certified"] == 8);
  CHECK(sampled["sampled_stable"] == 4);
  CHECK(delay["feasible"] == 8);
  CHECK(delay["certified"] == 0);  // computed, not proved
}

TEST_CASE("a B-spline of knots has a gain at each") {
  const Json json = ask("solve --theorem 5 --spline 2 --tool 0.1,0.1,0 --period 0.032").json;
  CHECK(json["feasible"] == true);
  CHECK(json["certified"] == true);
  CHECK(json["gain_at_knots"].size() == 4);
}

TEST_CASE("margins of Theorem 5 with the best gain, to a hundredth of the notes'") {
  for (const auto& [period, margin] : {std::pair{"0.016", 0.00658}, std::pair{"0.032", 2.5e-4}}) {
    const Answer answer = ask(std::string("solve --theorem 5 --tool 0.1,0.1,0 --period ") + period);
    CHECK(answer.json["margin"].get<double>() == doctest::Approx(margin).epsilon(0.01));
  }
}

TEST_CASE("a map does not depend on the number of threads") {
  const std::string arguments = "map --gain -753.2,-17.01 --period 1/60 --grid 200:300:2000,20:5:40 --threads ";
  const Json one = ask(arguments + "1").json;
  for (const char* threads : {"2", "7"}) CHECK(ask(arguments + threads).json == one);
}
