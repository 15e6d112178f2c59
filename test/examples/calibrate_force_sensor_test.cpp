// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <support/ask_program.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace {

using limpid::test::Answer;
using limpid::test::ProgramRun;
using limpid::test::run_program;
using Json = nlohmann::json;

Answer ask(const std::string& arguments) { return limpid::test::ask_program("calibrate_force_sensor", arguments); }

void refused(const std::string& arguments, const std::string& option) {
  limpid::test::check_refused("calibrate_force_sensor", arguments, option);
}

// A CSV for as long as it lives.
class File {
 public:
  explicit File(const std::string& text)
      : path_{(std::filesystem::temp_directory_path() / ("limpid_weights_" + std::to_string(::getpid()) + ".csv"))
                  .string()} {
    std::ofstream(path_) << text;
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// What it says of a file of weights that it refuses.
void refused_file(const std::string& text, const std::string& expected) {
  const File file(text);
  const ProgramRun result = run_program("calibrate_force_sensor", file.path());
  CAPTURE(result.output);
  CHECK(result.code != 0);
  CHECK(result.mentions(file.path() + ": " + expected));
}

double entry(const Json& matrix, int row, int column) {
  return matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].get<double>();
}

// Sensitivities 100, -200 and 50, 10 counts of z on x, offset 1, 2, 3; a newton either way.
const std::string exact =
    "dx,dy,dz,load_N,cx,cy,cz\n"
    "1,0,0,1,101,2,3\n"
    "-2,0,0,1,-99,2,3\n"
    "# by hand\n"
    "0,1,0,1,1,-198,3\n"
    "0,1,0,-1,1,202,3\n"
    "\n"
    "0,0,1,1,11,2,53\n"
    "0,0,-1,1,-9,2,-47\r\n";

}  // namespace

TEST_CASE("calibrate_force_sensor finds the matrix of exact weights") {
  const File file(exact);
  const Json json = ask(file.path()).json;
  // the inverse of (100 0 10; 0 -200 0; 0 0 50)
  const double expected[3][3] = {{0.01, 0, -0.002}, {0, -0.005, 0}, {0, 0, 0.02}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      CHECK(std::abs(entry(json["newtons_per_count"], i, j) - expected[i][j]) < 1e-15);  // roundings of 0.02
    }
    CHECK(std::abs(json["offset"][static_cast<std::size_t>(i)].get<double>() - (i + 1)) < 1e-12);
    CHECK(json["residual"]["largest"][static_cast<std::size_t>(i)] < 1e-13);
  }
  CHECK(std::abs(json["cross_talk"].get<double>() - 0.1) < 1e-12);  // x shows 10 counts of a newton along z
  CHECK(json["loads"] == 6);
  CHECK(json["lever_arm"] == 0);
  CHECK(!json.contains("truth"));
}

TEST_CASE("calibrate_force_sensor --simulate shows the truth beside what it found") {
  const Answer answer = ask("--simulate --noise 0.05 --seed 4");
  const Json& json = answer.json;
  CHECK(answer.run.mentions("the simulated sensor's own matrix"));
  CHECK(json["loads"] == 72);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double error = entry(json["newtons_per_count"], i, j) - entry(json["truth"]["newtons_per_count"], i, j);
      CHECK(std::abs(error) < 5 * entry(json["deviation"], i, j));
    }
    // 0.05 N by the root of 100 frames, with the other channels' noise at most 1.4 times that; 72 loads: to a tenth
    const double rms = json["residual"]["rms"][static_cast<std::size_t>(i)];
    CHECK(rms > 0.8 * 0.005);
    CHECK(rms < 1.4 * 1.3 * 0.005);
  }
  CHECK(json["cross_talk"] > 0.8);
  CHECK(json["truth"]["cross_talk_left"] < 0.01);
}

TEST_CASE("calibrate_force_sensor reads the weights that it simulated, with a lever too") {
  const File file("");
  std::filesystem::remove(file.path());
  const Json simulated = ask("--simulate --lever-arm 0.02 --csv " + file.path()).json;
  const Json read = ask(file.path() + " --lever-arm 0.02").json;
  CHECK(read["loads"] == simulated["loads"]);
  CHECK(simulated["truth"]["cross_talk_left"] < 0.01);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double there = entry(simulated["newtons_per_count"], i, j);
      CHECK(std::abs(entry(read["newtons_per_count"], i, j) - there) < 1e-12);  // directions are normalised anew
    }
  }
}

TEST_CASE("calibrate_force_sensor says what is wrong with a file, and where") {
  const std::string head = "dx,dy,dz,load_N,cx,cy,cz\n";
  refused_file(head + "1,0,0,abc,1,2,3\n", "line 2, load: expected a finite number, got \"abc\"");
  refused_file(head + "1,0,0,1,1,2,nan\n", "line 2, cz: expected a finite number, got \"nan\"");
  refused_file(head + "# c\n1,0,,1,1,2,3\n", "line 3, dz: expected a finite number, got nothing");
  refused_file(head + "1,0,0,1,1,2\n", "line 2, columns: expected 7: dx, dy, dz, load, cx, cy, cz, got \"6\"");
  refused_file(head + "0,0,0,1,1,2,3\n", "line 2, dx, dy, dz: expected a direction of the load, got \"0, 0, 0\"");
  refused_file(head + "1,0,0,1e5,1,2,3\n", "line 2, load: expected N of at most 1e4 in magnitude, got \"1e5\"");
  refused_file(head + "1,0,0,1,1,2,70000\n", "line 2, cz: expected counts within 65536 of 0, got \"70000\"");
  refused_file(head + head, "line 2, dx: expected a finite number, got \"dx\"");
}

TEST_CASE("calibrate_force_sensor says why weights do not give a matrix") {
  refused_file("", "expected 5 loads or more, got 0");
  refused_file("1,0,0,1,1,2,3\n1,0,0,2,1,2,3\n", "expected 5 loads or more, got 2");
  refused_file("1,0,0,1,1,0,0\n1,0,0,2,2,0,0\n0,1,0,1,0,1,0\n0,1,0,2,0,2,0\n0,0,0,0,0,0,0\n",
               "expected loads in three directions");
  std::string mute = exact;
  for (std::size_t at = 0; (at = mute.find(",53", at)) != std::string::npos;) mute.replace(at, 3, ",3");
  for (std::size_t at = 0; (at = mute.find(",-47", at)) != std::string::npos;) mute.replace(at, 4, ",3");
  refused_file(mute, "expected counts that tell forces apart");
}

TEST_CASE("calibrate_force_sensor refuses wrong options and names them") {
  refused("", "weights");
  refused("/no/such.csv", "weights");
  refused("--simulate --noise -1", "--noise");
  refused("--simulate --frames 0", "--frames");
  refused("--simulate --frames 1.5", "--frames");
  refused("--simulate --seed x", "--seed");
  refused("--simulate --lever-arm -1", "--lever-arm");
  refused("--simulate --condition 1", "--condition");
  refused("--simulate --json /no/such/folder/c.json", "--json");
  const File file(exact);
  refused(file.path() + " --simulate", "weights");
  refused(file.path() + " --noise 1", "--noise");
  refused(file.path() + " --json " + file.path(), "--json");
}
