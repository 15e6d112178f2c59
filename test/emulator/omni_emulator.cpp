// SPDX-License-Identifier: MIT
// omni_emulator [options] -- PROGRAM ARGS...: runs a program on a machine with an emulated Omni on its USB.
#include "child_process.hpp"
#include "emulated_omni.hpp"
#include "timed_event.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <iostream>
#include <numbers>

using namespace limpid;
using namespace limpid::emulator;
using Json = nlohmann::ordered_json;

namespace {

struct Options {
  EmulatedOmni::Settings omni{};
  std::vector<double> force{};  // N, Hz
  Eigen::Vector3d axis{0, 0, -1};
  double kill_after = 0, terminate_after = 0;  // s
  std::vector<TimedEvent> events{};
  std::string summary{};
  std::vector<std::string> program{};
};

void add_vector(CLI::App& app, const std::string& name, Eigen::Vector3d& vector, const std::string& text) {
  const auto assign = [&vector](const std::vector<double>& values) {
    vector = Eigen::Vector3d(values[0], values[1], values[2]);
  };
  app.add_option_function<std::vector<double>>(name, assign, text)->delimiter(',')->expected(3);
}

void add_options(CLI::App& app, Options& options) {
  EmulatedOmni::Settings& omni = options.omni;
  app.add_option("--path", omni.path, "Where it is plugged in, bus-port[.port...]")->capture_default_str();
  app.add_option("--vendor", omni.vendor, "Its USB vendor");
  app.add_option("--product", omni.product, "Its USB product");
  add_vector(app, "--q0", omni.arm.q0, "Joint angles at the start, rad, as 0,0.785,-1.25");
  add_vector(app, "--home", omni.arm.home, "Device joint angles where its counts are zero, rad");
  add_vector(app, "--full-scale", omni.arm.full_scale, "Command torques at u = 1, N m");
  const std::map<std::string, OperatorCoupling> couplings{{"on_arm", OperatorCoupling::on_arm},
                                                          {"playback", OperatorCoupling::playback}};
  app.add_option("--coupling", omni.arm.coupling, "Whether the operator's force acts on the arm")
      ->transform(CLI::CheckedTransformer(couplings));
  const std::map<std::string, Realism> realisms{{"ideal", Realism::ideal}, {"realistic", Realism::realistic}};
  app.add_option("--realism", omni.arm.realism, "How much of the arm is simulated")
      ->transform(CLI::CheckedTransformer(realisms));
  app.add_flag("--docked", omni.docked, "The stylus is in its dock");
  app.add_option("--force", options.force, "Operator: a raised cosine from motors first on, AMPLITUDE,HZ in N, Hz")
      ->delimiter(',')
      ->expected(2);
  add_vector(app, "--axis", options.axis, "Along which it goes, base frame; 0,0,-1 by default");
  app.add_option("--kill-after", options.kill_after, "s until the program is killed; how long torque lasts is told");
  app.add_option("--terminate-after", options.terminate_after, "s until the program gets SIGTERM");
  const auto add_event = [&options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const auto event = TimedEvent::parse(text);
      if (!event) throw CLI::ValidationError("--fault", "expected " + TimedEvent::expected() + ", got " + text);
      options.events.push_back(*event);
    }
  };
  app.add_option_function<std::vector<std::string>>("--fault", add_event, TimedEvent::expected());
  app.add_option("--summary", options.summary, "File for the summary, JSON; standard output without");
  app.add_option("program", options.program, "The program and its arguments")->required();
}

EmulatedArm::Force raised_cosine(double amplitude, double frequency, const Eigen::Vector3d& axis) {
  return [=](double t) -> Eigen::Vector3d {
    return axis.normalized() * (amplitude / 2 * (1 - std::cos(2 * std::numbers::pi * frequency * t)));
  };
}

Json in_json(const Eigen::Vector3d& vector) { return {vector[0], vector[1], vector[2]}; }
Json in_ms(Duration duration) { return 1e3 * in_seconds(duration); }

Json in_json(const OmniSnapshot& seen) {
  return {{"frames", seen.frames},
          {"frames_taken", seen.frames_taken},
          {"frames_replaced", seen.frames_replaced},
          {"commands", seen.commands},
          {"commands_invalid", seen.commands_invalid},
          {"commands_refused", seen.commands_refused},
          {"dac_out_of_range", seen.dac_out_of_range},
          {"watchdog_ms", seen.watchdog},
          {"watchdog_trips", seen.watchdog_trips},
          {"watchdog_trips_with_torque", seen.watchdog_trips_with_torque},
          {"motors_were_on", seen.motors_since.has_value()},
          {"motors_on", seen.motors_on},
          {"flags", seen.flags},
          {"boots", seen.boots},
          {"torque", in_json(seen.torque)},
          {"largest_torque", in_json(seen.largest_torque)},
          {"q", in_json(seen.joints.q)},
          {"qdot", in_json(seen.joints.qdot)},
          {"tip", in_json(seen.tip)},
          {"pauses", seen.pauses}};
}

std::atomic<int> asked_to_end = 0;  // NOLINT: a signal's

// A program's run: what happens at which time, and what came of it.
class Run {
 public:
  explicit Run(const Options& options) : options_{options}, omni_{bus_, options.omni}, child_{options.program} {
    std::stable_sort(options_.events.begin(), options_.events.end(),
                     [](const TimedEvent& a, const TimedEvent& b) { return a.at < b.at; });
  }

  int finish() {
    while (!child_.ended()) {
      step(in_seconds(steady_now() - start_));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (!killed_) end_ = steady_now();
    wait_for_motors();
    const OmniSnapshot seen = omni_.snapshot();
    Json summary = in_json(seen);
    summary["exit_code"] = *child_.ended();
    const bool had_torque = seen.motors_until && *seen.motors_until >= end_;
    summary["torque_after_end_ms"] = seen.motors_on ? Json{} : had_torque ? in_ms(*seen.motors_until - end_) : Json(0);
    if (killed_) summary["torque_at_kill"] = in_json(torque_at_kill_);
    print(summary);
    return killed_ ? (seen.motors_on ? 1 : 0) : *child_.ended();
  }

 private:
  void step(double t) {
    if (const int number = asked_to_end.exchange(0); number != 0) child_.signal(number);
    for (; next_ < options_.events.size() && options_.events[next_].at <= t; ++next_)
      options_.events[next_].apply(omni_);
    if (options_.terminate_after > 0 && t >= options_.terminate_after && !std::exchange(terminated_, true))
      child_.signal(SIGTERM);
    if (options_.kill_after > 0 && t >= options_.kill_after && !std::exchange(killed_, true)) {
      torque_at_kill_ = omni_.snapshot().torque;
      end_ = steady_now();
      child_.signal(SIGKILL);
    }
  }

  // A watchdog may be as long as a second.
  void wait_for_motors() const {
    for (int i = 0; i < 2000 && omni_.snapshot().motors_on; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  void print(const Json& summary) const {
    if (options_.summary.empty()) {
      std::cout << summary.dump(2) << '\n';
    } else {
      std::ofstream(options_.summary) << summary.dump(2) << '\n';
    }
  }

  Options options_;
  EmulatedBus bus_{};
  EmulatedOmni omni_;
  ChildProcess child_;
  Time start_ = steady_now(), end_{};
  std::size_t next_ = 0;  // event
  bool terminated_ = false, killed_ = false;
  Eigen::Vector3d torque_at_kill_ = Eigen::Vector3d::Zero();
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs a program on a machine with an emulated Omni on its USB, and tells what the Omni saw.");
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  if (!options.force.empty()) options.omni.arm.force = raised_cosine(options.force[0], options.force[1], options.axis);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, [](int which) { asked_to_end = which; });
  try {
    return Run(options).finish();
  } catch (const std::exception& error) {
    std::cerr << "omni_emulator: " << error.what() << '\n';
    return 125;
  }
}
