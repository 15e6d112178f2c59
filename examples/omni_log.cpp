// SPDX-License-Identifier: MIT
// Records an Omni's states to CSV at the device's rate, its motors off: move it by hand.
#include "common/option_checks.hpp"
#include "common/usb_omni_log.hpp"
#include "common/usb_omni_options.hpp"
#include "common/usb_words.hpp"

#include <limpid/loop/realtime/stop_on_signal.hpp>

#include <chrono>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

using namespace limpid;
using namespace limpid::examples;

namespace {

struct Options {
  UsbOmniOptions omni{};
  double duration = 0;  // s; 0: until a signal
  std::string output{};
};

int record(const Options& options) {
  std::ofstream file;
  if (!options.output.empty()) file.open(options.output, std::ios::trunc);
  std::ostream& out = options.output.empty() ? std::cout : file;
  const auto write = [&](const std::string& text) {
    out << text << std::flush;
    if (!out) throw std::runtime_error("expected to write the rows, got an error of the file");
  };
  std::stop_source stop;
  const StopOnSignal on_signal(stop);
  UsbOmni omni(options.omni.reading_only());
  write(omni_record_header());
  const Duration duration = options.duration > 0 ? from_seconds(options.duration) : Duration::max();
  const OmniLogLosses losses = log_omni(omni, duration, stop, write);
  std::cerr << losses.rows << " rows; lost: " << omni.counters()[UsbCount::lost] << " on the way, " << losses.unread
            << " not read in time, " << losses.unwritten << " not written in time\n"
            << examples::describe(omni.counters());
  if (losses.rows == 0) throw std::runtime_error("expected states of the Omni, got none");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Records an Omni's states to CSV at the device's rate, its motors off.");
  Options options;
  add_usb_omni_options(app, options.omni);
  app.add_option("--duration", options.duration, "s; until Ctrl-C without")->check(within(0, 1e6));
  app.add_option("--output", options.output, "File for the rows, CSV; standard output without")->check(output());
  CLI11_PARSE(app, argc, argv);
  try {
    return record(options);
  } catch (const std::exception& error) {
    std::cerr << "omni_log: " << error.what() << '\n';
    return 1;
  }
}
