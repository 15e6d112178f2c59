// SPDX-License-Identifier: MIT
// A UsbOmni in a loop at 1 kHz with a live emulated Omni behind the real libusb: what a minute of it loses and costs,
// and how long each fault takes to be stated and to leave the motors without torque. Fails where a figure asked is
// missed.
#include "usb/faults.hpp"
#include "usb/report.hpp"
#include "usb/stream.hpp"

#include <limpid/loop/realtime/realtime_thread.hpp>

#include <CLI/CLI.hpp>
#include <common/output_file.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

namespace {

using namespace limpid::bench;

struct Options {
  int seconds = 60, repeats = 20, priority = 0;
  std::string csv, json;
  bool as_host = false;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("--seconds", options.seconds, "of the stream; 0: none")->check(CLI::Range(0, 86'400));
  app.add_option("--repeats", options.repeats, "of each fault; 0: none")->check(CLI::Range(0, 10'000));
  app.add_option("--priority", options.priority,
                 "of SCHED_FIFO for all its threads, the emulated device's, too; 0: none")
      ->check(CLI::Range(0, 99));
  app.add_option("--csv", options.csv, "file for the runs of the faults")->check(limpid::examples::refusal_of_output);
  app.add_option("--json", options.json, "file for the stream's seconds, costs, runs and findings")
      ->check(limpid::examples::refusal_of_output);
  app.add_flag("--as-host", options.as_host, "")->group("");  // what is killed
}

int run(const Options& options) {
  if (options.as_host) return hold_until_killed();
  const limpid::RealtimeThread thread({.priority = options.priority});  // later threads are as this one is
  for (const std::string& sentence : thread.grants().refused) std::printf("refused: %s\n", sentence.c_str());
  const UsbResults results{options.seconds > 0 ? measure_stream(options.seconds) : StreamFigures{},
                           measure_faults(options.repeats)};
  const auto findings = findings_of(results);
  print(results);
  print(findings);
  if (!options.csv.empty()) limpid::examples::write_file(options.csv, as_csv(results));
  if (!options.json.empty()) limpid::examples::write_file(options.json, as_json(results, findings));
  const bool measured = options.seconds == 0 || !results.stream.seconds.empty();
  if (!measured) std::printf("missed: the stream did not start\n");
  return measured && std::ranges::all_of(findings, &UsbFinding::met) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("A UsbOmni against an emulated Omni: what it loses, what it costs, and how its faults end");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "usb: %s\n", error.what());
    return 1;
  }
}
