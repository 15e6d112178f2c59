// SPDX-License-Identifier: MIT
#include <omni/emulated_machine.hpp>

#include <doctest/doctest.h>

using limpid::test::run_program;
using limpid::test::with_omni;

TEST_CASE("omni_info lists the Omni, tells its state, and leaves its motors off") {
  const auto run = with_omni("--docked", "omni_info", "");
  CAPTURE(run.program.output);
  CHECK(run.program.code == 0);
  CHECK(run.program.mentions("1-1  1209:0001  Omni behind a bridge board"));
  CHECK(run.program.mentions("states/s"));
  CHECK(run.program.mentions("docked yes, angles known"));
  CHECK(run.program.mentions("damaged 0"));
  REQUIRE(run.omni.is_object());
  CHECK(run.omni["motors_were_on"] == false);
  CHECK(run.omni["commands_invalid"] == 0);
}

TEST_CASE("an Omni that was not docked has no angles yet") {
  const auto run = with_omni("", "omni_info", "");
  CHECK(run.program.code == 0);
  CHECK(run.program.mentions("docked no, angles unknown until it is docked"));
}

TEST_CASE("damaged frames are counted") {
  const auto run = with_omni("--fault corrupt:5@0.5", "omni_info", "");
  CAPTURE(run.program.output);
  CHECK(!run.program.mentions("damaged 0"));  // of the five those that a waiting transfer took
}

TEST_CASE("a board of another number is found by it") {
  const std::string board = "--vendor " + std::to_string(0x1234) + " --product " + std::to_string(0xabcd);
  CHECK(with_omni(board, "omni_info", "--id 1234:abcd").program.code == 0);
  const auto unknown = with_omni(board, "omni_info", "").program;
  CHECK(unknown.code == 1);
  CHECK(unknown.mentions("nothing that limpid knows"));
}

TEST_CASE("a Touch is refused in words") {
  const auto run =
      with_omni("--vendor " + std::to_string(0x0301) + " --product " + std::to_string(0x2988), "omni_info", "");
  CHECK(run.program.code == 1);
  CHECK(run.program.mentions("0301:2988  3D Systems Touch: not served"));
  CHECK(run.program.mentions("the vendor's USB protocol is not documented"));
}

TEST_CASE("omni_info tells a Falcon, which is no Omni") {
  const auto run =
      with_omni("--vendor " + std::to_string(0x0403) + " --product " + std::to_string(0xcb48), "omni_info", "");
  CHECK(run.program.code == 1);
  CHECK(run.program.mentions("Novint Falcon"));
}

TEST_CASE("without an Omni omni_info and omni_log say so") {
  for (const char* name : {"omni_info", "omni_log"}) {
    const auto program = run_program(name, "--id fffe:fffe");
    CHECK(program.code == 1);
    CHECK(program.mentions("fffe:fffe to be plugged in"));
  }
}

TEST_CASE("wrong options are refused by name") {
  const auto wrong = [](const std::string& arguments, const std::string& word) {
    const auto program = run_program("omni_info", arguments);
    CAPTURE(program.output);
    CHECK(program.code != 0);
    CHECK(program.mentions(word));
  };
  wrong("--id 12:34", "--id");
  wrong("--id 1209-0001", "--id");
  wrong("--id 120g:0001", "--id");
  wrong("--calibration /nonexistent.json", "/nonexistent.json");
}
