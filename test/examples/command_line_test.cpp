// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <support/run_program.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace {

using limpid::test::ProgramRun;

ProgramRun run(const std::string& program, const std::string& arguments) {
  return limpid::test::run_program(program, arguments);
}

void refused(const std::string& arguments, const std::string& option) {
  CAPTURE(arguments);
  const ProgramRun result = run("palpate", arguments);
  CAPTURE(result.output);
  CHECK(result.code != 0);
  CHECK(result.mentions(option));
}

}  // namespace

TEST_CASE("palpate refuses wrong options and names them") {
  refused("--sample-period 0", "--sample-period");
  refused("--sample-period nan", "--sample-period");
  refused("--sample-period 0.0001", "--sample-period");
  refused("--stiffness -5", "--stiffness");
  refused("--stiffness abc", "--stiffness");
  refused("--predictor future", "--predictor");
  refused("--environment jelly", "--environment");
  refused("--tool 0,0.1,0", "--tool");
  refused("--tool 0.1,0.1", "--tool");
  refused("--gain 1,2,3", "--gain");
  refused("--start 1,2", "--start");
  refused("--rate 0", "--rate");
  refused("--delay -1", "--delay");
  refused("--delay 9", "--delay");
  refused("--duration 100", "--duration");
  refused("--operator robot", "--operator");
  refused("--operator hand", "--operator");
  refused("--operator hand 0.3,5", "--operator");
  refused("--operator hand 0,5,300", "--operator");
  refused("--operator hand 0.3,-5,300", "--operator");
  refused("--operator force 0.3,5,300", "--operator");
  refused("--unknown 1", "--unknown");
}

TEST_CASE("palpate refuses options that contradict each other") {
  refused("--force-sine 1,1 --force-raised-cosine 1,1", "--force-");
  refused("--force-scale 0.05", "--force");
  refused("--depth 0.003", "--depth");
  refused("--exponent 1.5", "--exponent");
  refused("--stiffness 1,2", "--stiffness");
  refused("--environment smooth-bilinear --stiffness 400", "--stiffness");
  refused("--known --start 1100,30", "--start");
  refused("--predictor hold --known", "--known");
  refused("--predictor hold,ideal --gain 1,2", "--gain");
  refused("--predictor all,hold", "--predictor");
  refused("--operator hand 0.3,5,300 --playback", "--playback");
}

TEST_CASE("palpate refuses to write two outputs to one file, however its path is spelt") {
  const auto folder = std::filesystem::temp_directory_path() / "limpid_one_file";
  std::filesystem::create_directory(folder);
  const std::string path = (folder / "a").string();
  for (const std::string& other :
       {path, (folder / "." / "a").string(), (folder / ".." / "limpid_one_file" / "a").string()}) {
    refused("--json " + path + " --csv " + other, "--csv");
  }
  std::filesystem::create_symlink(path, folder / "b");
  refused("--csv " + path + " --plot " + (folder / "b").string(), "--plot");
  std::filesystem::remove_all(folder);
}

TEST_CASE("palpate says where a recording is broken") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_broken_recording.csv";
  std::ofstream(path) << "time,force\n0,1\n0.02,two\n";
  const ProgramRun result = run("palpate", "--force " + path.string());
  std::filesystem::remove(path);
  CHECK(result.code != 0);
  CHECK(result.mentions("line 3, column 2"));
}

TEST_CASE("palpate writes the figures of every predictor as JSON") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_palpate.json";
  const ProgramRun result = run("palpate", "--duration 3 --json " + path.string());
  CAPTURE(result.output);
  REQUIRE(result.code == 0);
  const nlohmann::json json = nlohmann::json::parse(std::ifstream(path));
  std::filesystem::remove(path);
  CHECK(json.contains("settings"));
  CHECK(json["tick_ns"].contains("p99.9"));
  for (const char* predictor : {"hold", "model", "ideal"}) {
    CAPTURE(predictor);
    const auto& entry = json["predictors"][predictor];
    for (const char* error : {"prediction_error", "total_error"}) {
      CHECK(entry[error]["max"].is_number());
      CHECK(entry[error]["l2"].is_number());
    }
    for (const char* change : {"prediction_max", "prediction_l2", "total_max", "total_l2"}) {
      CHECK(entry["change"][change].is_number());
    }
  }
  CHECK(json["predictors"]["hold"]["change"]["total_l2"] == 0.0);
}

TEST_CASE("palpate accounts for the energy of a hand, for every predictor") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_palpate_hand.json";
  const ProgramRun result = run("palpate", "--duration 3 --operator hand 0.3,5,300 --json " + path.string());
  CAPTURE(result.output);
  REQUIRE(result.code == 0);
  const nlohmann::json json = nlohmann::json::parse(std::ifstream(path));
  std::filesystem::remove(path);
  CHECK(json["settings"]["operator"] == "hand");
  CHECK(json["operator"]["mass"] == 0.3);
  CHECK(json["operator"]["damping"] == 5.0);
  CHECK(json["operator"]["stiffness"] == 300.0);
  for (const char* predictor : {"hold", "model", "ideal"}) {
    CAPTURE(predictor);
    const auto& energy = json["predictors"][predictor]["energy"];
    double held = 0;
    for (const char* part : {"kinetic", "elastic", "dissipated", "delivered"}) held += energy[part].get<double>();
    CHECK(energy["work"].get<double>() > 0);
    CHECK(held == doctest::Approx(energy["work"].get<double>()).epsilon(1e-9));
  }
}

TEST_CASE("palpate draws its plot, or says that gnuplot is absent and writes the curves") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_palpate.svg";
  const ProgramRun result = run("palpate", "--duration 2 --plot " + path.string());
  CAPTURE(result.output);
  CHECK(result.code == 0);
  const auto curves = std::filesystem::path(path).replace_extension(".csv");
  CHECK((std::filesystem::exists(path) || std::filesystem::exists(curves)));
  std::filesystem::remove(path);
  std::filesystem::remove(curves);
}

TEST_CASE("reproduce refuses sections that it does not know and cases where there are none") {
  for (const char* arguments :
       {"", "--section 9.9", "--section 6.1.1 --case 2", "--section 6.1.4 --case 10", "--section 6.2.2 --force-peak 3",
        "--section 7.1 --force-peak 0", "--section 7.1 --force no_such_file.csv"}) {
    CAPTURE(arguments);
    CHECK(run("reproduce", arguments).code != 0);
  }
}

TEST_CASE("reproduce lists its figures with what is printed") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_reproduce.json";
  REQUIRE(run("reproduce", "--section 6.1.2 --json " + path.string()).code == 0);
  const nlohmann::json json = nlohmann::json::parse(std::ifstream(path));
  std::filesystem::remove(path);
  REQUIRE(json.is_array());
  for (const auto& figure : json) {
    for (const char* field : {"name", "ours", "printed", "unit"}) CHECK(figure.contains(field));
  }
}

TEST_CASE("reproduce lists its runs, every predictor's errors and their change beside what is printed") {
  const auto path = std::filesystem::temp_directory_path() / "limpid_reproduce_runs.json";
  REQUIRE(run("reproduce", "--section 6.2.1 --json " + path.string()).code == 0);
  const nlohmann::json json = nlohmann::json::parse(std::ifstream(path));
  std::filesystem::remove(path);
  CHECK_FALSE(json["notes"].empty());
  CHECK_FALSE(json["figures"].empty());
  REQUIRE(json["runs"].size() == 1);
  const auto& row = json["runs"][0];
  CHECK(row["printed"]["l2_change"] == -0.26);
  REQUIRE(row["runs"].size() == 3);
  CHECK_FALSE(row["runs"][0].contains("change"));  // hold
  for (std::size_t i = 1; i < 3; ++i) {
    const auto& with = row["runs"][i];
    const double ratio = with["total_error"]["l2"].get<double>() / row["runs"][0]["total_error"]["l2"].get<double>();
    CHECK(with["change"]["l2_change"].get<double>() == doctest::Approx(ratio - 1));  // (3.38)
  }
}
