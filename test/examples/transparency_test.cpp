// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <support/ask_program.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using limpid::test::Answer;
using limpid::test::ProgramRun;
using limpid::test::run_program;
using Json = nlohmann::json;

Answer ask(const std::string& arguments) { return limpid::test::ask_program("transparency", arguments); }

void refused(const std::string& arguments, const std::string& option) {
  limpid::test::check_refused("transparency", arguments, option);
}

void agrees(const Json& actual, double expected, double part) {
  CAPTURE(expected);
  REQUIRE(actual.is_number());
  CHECK(std::abs(actual.get<double>() - expected) <= part * std::abs(expected));
}

struct Row {
  double gain, index, norm, peak;
};

void check_table(const Json& table, const std::vector<Row>& rows, double part) {
  REQUIRE(table.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CAPTURE(rows[i].gain);
    CHECK(table[i]["gain"] == rows[i].gain);
    agrees(table[i]["index"], rows[i].index, part);
    agrees(table[i]["norm"], rows[i].norm, part);
    if (rows[i].peak > 0) agrees(table[i]["peak"], rows[i].peak, part);
  }
}

void check_optimum(const Json& json, const Row& expected, double lower, double upper) {
  agrees(json["optimum"]["gain"], expected.gain, 1e-10);
  agrees(json["optimum"]["index"], expected.index, 1e-12);
  agrees(json["optimum"]["norm"], expected.norm, 1e-10);
  agrees(json["robust_interval"][0], lower, 1e-10);
  agrees(json["robust_interval"][1], upper, 1e-10);
}

const Json& with_gain(const Json& rows, double gain) {
  for (const Json& row : rows) {
    if (row["gain"] == gain) return row;
  }
  FAIL("no row of the gain " << gain);
  return rows;
}

}  // namespace

TEST_CASE("transparency refuses wrong options and names them") {
  for (const auto& [option, value] : {std::pair{"--mass", "0"},
                                      std::pair{"--mass", "nan"},
                                      std::pair{"--damping", "-1"},
                                      std::pair{"--stiffness", "0"},
                                      std::pair{"--stiffness", "stiff"},
                                      std::pair{"--wall-damping", "-1"},
                                      std::pair{"--period", "0"},
                                      std::pair{"--period", "1/0"},
                                      std::pair{"--uncertainty", "0.5"},
                                      std::pair{"--uncertainty", "1,0.5"},
                                      std::pair{"--uncertainty", "0.5,1.1"},
                                      std::pair{"--uncertainty", "-0.5,0.5"},
                                      std::pair{"--weight", "0"},
                                      std::pair{"--zoh", "D"},
                                      std::pair{"--gains", "1,,2"},
                                      std::pair{"--gains", "1,x"},
                                      std::pair{"--gains", "-1"},
                                      std::pair{"--velocity", "guessed"},
                                      std::pair{"--delay", "-0.001"},
                                      std::pair{"--delay", "0.032"},
                                      std::pair{"--cutoff", "0"},
                                      std::pair{"--radius", "0"},
                                      std::pair{"--radius", "1.5"},
                                      std::pair{"--step", "0"},
                                      std::pair{"--step", "hard"},
                                      std::pair{"--step", "''"},
                                      std::pair{"--json", "/"},
                                      std::pair{"--plot", "/dev/null/figures"},
                                      std::pair{"--mass", "0.01 decouple"},
                                      std::pair{"--unknown", "1"}}) {
    refused(std::string(option) + " " + value, option);
  }
}

TEST_CASE("hold A: table to twelve digits, optimum and interval to ten") {
  const Answer answer = ask("--gains 1,5,15,25");
  // J of 25: by quadrature to 30 digits too, 4.1798767950806585013
  check_table(answer.json["table"],
              {{1, 11.4502039315255990, 2.88003732010331321, 324.633677204834},
               {5, 4.54058480457420385, 0.637979213407597270, 1409.36187992891},
               {15, 4.14262618593060922, 0.965681356703101768, 2270.76721661778},
               {25, 4.17987679508065850, 1.65616748868802401, 2622.01740138534}},
              1e-12);
  check_optimum(answer.json, {15.27121744926739, 4.14256383021572894, 0.978005402210356626, 0}, 2.185632671966743,
                15.74267111136963);
}

TEST_CASE("hold B: the norm is not the 0.5 of low and high frequencies") {
  const Answer answer = ask("--zoh B --gains 1,5,15,25");
  check_table(answer.json["table"],
              {{1, 12.272143925619093, 3.1533889322855985, 0},
               {5, 4.5785645434983596, 0.62063337092701205, 0},
               {15, 4.1633320390470858, 0.70204621002269551, 0},
               {25, 4.1946568521380908, 0.78783751798074784, 0}},
              1e-12);
  check_optimum(answer.json, {15.67444141443214, 4.16296810522759617, 0.708150582835712069, 0}, 2.258559121209099,
                54.94852373251878);
}

TEST_CASE("hold C: optimum and norms to the digits that are known") {
  const Answer answer = ask("--zoh C --gains 1,15 --velocity sampled");
  // the root of dJ/dB_c by quadrature to 20 digits; a search for the least J in double comes to 15.495497577
  agrees(answer.json["optimum"]["gain"], 15.4954976021, 1e-10);
  // the reference stops at 3e6 rad/s, where 1e4/(pi 3e6) is left
  agrees(answer.json["optimum"]["index"], 4.13626216696 + 1e4 / (std::acos(-1.0) * 3e6), 1e-9);
  CHECK(std::abs(answer.json["table"][0]["norm"].get<double>() - 3.16979089) < 0.5e-8);
  CHECK(std::abs(answer.json["table"][1]["norm"].get<double>() - 0.90446097) < 0.5e-8);
}

TEST_CASE("--free finds both gains, and all else is said of that stiffness gain") {
  const Json json = ask("--free").json;
  CHECK(std::abs(json["optimum"]["gain"].get<double>() - 7.80) < 0.005);
  CHECK(std::abs(json["optimum"]["stiffness_gain"].get<double>() - 5352) < 0.5);
  CHECK(std::abs(json["optimum"]["index"].get<double>() - 3.815) < 0.0005);
  CHECK(json["stiffness_gain"] == json["optimum"]["stiffness_gain"]);
}

TEST_CASE("the steps of the paper: overshoot, settling, and x to 1e-4 mm") {
  struct {
    double gain, overshoot, settling;
    std::array<double, 5> millimetres;
  } const cases[] = {{1, 0.777, 0.154, {-0.2498, -4.9105, -8.8838, -2.0423, -6.1179}},
                     {15, 0, 0.058, {-0.2498, -1.3828, -2.4505, -3.7483, -4.8302}}};
  const Json json = ask("--step -5").json;
  CHECK(json["step_velocity"] == "difference");
  for (const auto& which : cases) {
    CAPTURE(which.gain);
    const Json& step = with_gain(json["step"], which.gain);
    CHECK(std::abs(step["overshoot"].get<double>() - which.overshoot) < 0.0005);
    CHECK(std::abs(step["settling"].get<double>() - which.settling) < 1e-9);
    for (std::size_t i = 0; i < 5; ++i) {
      CAPTURE(i);
      CHECK(std::abs(1e3 * step["points"][i]["position"].get<double>() - which.millimetres[i]) < 1e-4);
    }
    CHECK(std::abs(step["trace"]["position"].back().get<double>() + 0.005) < 1e-6);
    CHECK(std::abs(step["trace"]["force"].back().get<double>() + 5) < 1e-3);
  }
}

TEST_CASE("a step of a loop that is not stable does not settle") {
  const Answer answer = ask("--step -5 --gains 25");
  const Json& step = with_gain(answer.json["step"], 25);
  CHECK(step["settling"].is_null());
  CHECK(step["overshoot"].is_null());
  CHECK(answer.run.mentions("does not settle"));
}

TEST_CASE("the sampled loop is stable for the gains that are known, nominal and at half the mass") {
  struct {
    const char* arguments;
    double lower, upper, robust_upper;
  } const cases[] = {{"--velocity sampled", 0.478, 20.000, 10.0}, {"--velocity difference", 0.504, 19.004, 8.96}};
  for (const auto& which : cases) {
    const Json json = ask(which.arguments).json;
    CHECK(std::abs(json["sampled_interval"][0].get<double>() - which.lower) < 0.0005);
    CHECK(std::abs(json["sampled_interval"][1].get<double>() - which.upper) < 0.0005);
    agrees(json["robust_sampled_interval"][1], which.robust_upper, 1e-3);  // three digits, and what is left unproved
    CHECK(json["robust_sampled_interval"][0] > json["sampled_interval"][0]);
  }
}

TEST_CASE("a sample of delay narrows the gains, and an interval that does not exist is null") {
  const Json sampled = ask("--velocity sampled --delay 0.001").json;
  CHECK(std::abs(sampled["sampled_interval"][0].get<double>() - 1.60) < 0.005);
  CHECK(std::abs(sampled["sampled_interval"][1].get<double>() - 9.39) < 0.005);
  const Answer difference = ask("--velocity difference --delay 0.001");
  CHECK(std::abs(difference.json["sampled_interval"][0].get<double>() - 1.88) < 0.005);
  CHECK(std::abs(difference.json["sampled_interval"][1].get<double>() - 6.54) < 0.005);
  CHECK(difference.json["robust_sampled_interval"].is_null());
  CHECK(difference.json["offered"].is_null());
  CHECK(difference.run.mentions("none to offer"));
}

TEST_CASE("B_c = 15 is called not robustly stable when sampled, with mass and radius, and a gain that is, offered") {
  const Answer answer = ask("");
  CHECK(answer.run.mentions("B_c = 15 is not robustly stable when sampled at mass 0.005 kg"));
  CHECK(answer.run.mentions("the optimum B_c = 15.2712 is not robustly stable when sampled at mass 0.005 kg"));
  CHECK(answer.run.mentions("the best gain that is"));
  struct {
    const char* velocity;
    double radius;
  } const cases[] = {{"sampled", 2.03}, {"difference", 1.26}};
  for (const auto& which : cases) {
    CAPTURE(which.velocity);
    const Json& judged = answer.json["sampled"][which.velocity];
    const Json& fifteen = with_gain(judged["gains"], 15);
    CHECK(fifteen["proved"] == false);
    CHECK(fifteen["mass"].get<double>() == doctest::Approx(0.005));
    agrees(fifteen["radius"], which.radius, 5e-3);  // at the worst damping, the reference's at the nominal one
    const Json& offered = judged["offered"];
    CHECK(offered["proved"] == true);
    CHECK(offered["radius"] < 1);
    CHECK(offered["norm"] <= 1);
    CHECK(offered["gain"] <= judged["robust_sampled_interval"][1]);
    // J falls up to its optimum at 15.27: the best is at the upper end
    agrees(offered["gain"], judged["robust_sampled_interval"][1], 1e-5);
  }
}

TEST_CASE("the optimum itself is offered where it is robustly stable") {
  const Answer answer = ask("--uncertainty 0.1,0.1 --velocity sampled");
  CHECK(answer.json["offered"]["gain"] == answer.json["optimum"]["gain"]);
  CHECK(answer.json["sampled"]["sampled"]["optimum"]["proved"] == true);
  CHECK(answer.run.mentions("is the optimum: B_c = 15.2712"));
}

TEST_CASE("a radius below one leaves that margin") {
  const Json json = ask("--radius 0.9").json;
  CHECK(json["offered"]["proved"] == true);
  CHECK(json["offered"]["radius"] < 0.9);
  CHECK(json["offered"]["gain"] < 9.9);
}

TEST_CASE("where no gain is stable the words and the figures say so") {
  const Answer answer = ask("--period 0.01");
  for (const char* interval : {"robust_interval", "sampled_interval", "robust_sampled_interval", "offered"}) {
    CHECK(answer.json[interval].is_null());
  }
  CHECK(answer.json["optimum"]["gain"].is_null());
  CHECK(answer.json["table"][0]["norm"].is_null());
  CHECK(answer.run.mentions("for no gain"));
}

TEST_CASE("transparency draws the paper's figures, or writes the curves where gnuplot is absent") {
  const auto folder = std::filesystem::temp_directory_path() / "limpid_transparency";
  std::filesystem::remove_all(folder);
  const ProgramRun result = run_program("transparency", "--step -5 --plot " + folder.string());
  CAPTURE(result.output);
  CHECK(result.code == 0);
  for (const char* figure : {"figure_4", "figure_7", "figure_8", "figure_9", "figure_10"}) {
    CAPTURE(figure);
    const bool drawn = std::filesystem::exists(folder / (std::string(figure) + ".svg"));
    CHECK((drawn || std::filesystem::exists(folder / (std::string(figure) + ".curves.csv"))));
  }
  std::filesystem::remove_all(folder);
}
