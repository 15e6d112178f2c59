// SPDX-License-Identifier: MIT
#include "usb/report.hpp"

#include "usb/summary.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <sstream>

namespace limpid::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double longest_ms = 25;        // until a fault is stated, and until there is no torque
constexpr double longest_killed = 21;    // the device's watchdog, and a frame
constexpr double longest_call_ns = 1e3;  // p99.9 of read and of write

double per(double number, double of) { return of > 0 ? number / of : std::numeric_limits<double>::quiet_NaN(); }

double ns(Duration duration) { return static_cast<double>(duration.count()); }

double allowed(const FaultRow& row) { return row.name == "SIGKILL" ? longest_killed : longest_ms; }

std::string words(std::string_view text) { return std::string(text); }

void add_stream(std::vector<UsbFinding>& findings, const StreamFigures& stream) {
  const auto [sum, seconds] = sum_of(stream, false);
  const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
  findings.push_back({"states a second", per(number(sum.states), static_cast<double>(seconds)), 980, false});
  findings.push_back({"states that the first tick after them used, or a newer one, %",
                      100 * per(number(sum.states - sum.late), number(sum.states)), 99.9, false});
  findings.push_back({"torn states", seconds > 0 ? number(sum.torn) : per(0, 0), 0, true});
  findings.push_back({"damaged frames", seconds > 0 ? number(sum.damaged) : per(0, 0), 0, true});
  findings.push_back({"read, p99.9, ns", ns(stream.read.calm.quantile(0.999)), longest_call_ns, true});
  findings.push_back({"write, p99.9, ns", ns(stream.write.calm.quantile(0.999)), longest_call_ns, true});
}

void add_faults(std::vector<UsbFinding>& findings, const FaultRow& row) {
  const auto calm = count_of(row, [](const FaultRun& run) { return !run.held_up; });
  const auto expected = count_of(row, [&](const FaultRun& run) { return !run.held_up && is_expected(row, run); });
  const auto restarted = count_of(row, [](const FaultRun& run) { return !run.held_up && run.restarted; });
  const auto percent = [&](std::size_t count) {
    return 100 * per(static_cast<double>(count), static_cast<double>(calm));
  };
  findings.push_back(
      {words(row.name) + ": " + (row.borne() ? "borne" : "ends as expected") + ", %", percent(expected), 100, false});
  findings.push_back({words(row.name) + ": starts again, %", percent(restarted), 100, false});
  if (row.borne()) return;
  if (row.stated) {
    findings.push_back(
        {words(row.name) + ": stated, worst, ms", spread_of(row, &FaultRun::to_stated, false).worst, longest_ms, true});
  }
  findings.push_back({words(row.name) + ": no torque, worst, ms", spread_of(row, &FaultRun::to_zero, false).worst,
                      allowed(row), true});
}

void print_call(const char* name, const LatencyHistogram& of) {
  std::printf("  %-14s p50 %.0f, p99 %.0f, p99.9 %.0f, longest %.0f ns of %llu\n", name, ns(of.quantile(0.5)),
              ns(of.quantile(0.99)), ns(of.quantile(0.999)), ns(of.max()), static_cast<unsigned long long>(of.count()));
}

void print_seconds(const char* name, const StreamFigures& stream, bool with_pauses) {
  const auto [sum, seconds] = sum_of(stream, with_pauses);
  const auto count = [](std::uint64_t number) { return static_cast<unsigned long long>(number); };
  const auto states = static_cast<double>(sum.states);
  std::printf("  %s, %zu: %.1f states/s, %.3f %% used in time (%llu late), %llu replaced by newer ones, torn %llu, ",
              name, seconds, per(states, static_cast<double>(seconds)),
              100 * per(static_cast<double>(sum.states - sum.late), states), count(sum.late),
              count(sum.states - std::min(sum.states, sum.taken)), count(sum.torn));
  std::printf("damaged %llu, lost %llu (at the device %llu), ticks missed %llu, faults %llu, pauses %llu\n",
              count(sum.damaged), count(sum.lost), count(sum.replaced), count(sum.misses), count(sum.faults),
              count(sum.pauses));
}

std::string stated_by(const FaultRow& row) {
  std::map<std::string_view, int> counts;
  for (const FaultRun& run : row.runs) {
    if (run.stated != UsbFault::none) ++counts[describe(run.stated)];
  }
  std::ostringstream text;
  for (const auto& [name, count] : counts) text << (text.tellp() > 0 ? "; " : "") << count << " x " << name;
  return counts.empty() ? (row.borne() ? "borne" : "nobody is left") : text.str();
}

void print_spread(const FaultRow& row, std::optional<Duration> FaultRun::*took) {
  const Spread calm = spread_of(row, took, false), all = spread_of(row, took, true);
  if (all.count == 0) {
    std::printf(" %29s", "-");
  } else {
    std::printf(" %6.2f %6.2f | %6.2f %6.2f", calm.median, calm.worst, all.median, all.worst);
  }
}

Json in_ms(const std::optional<Duration>& duration) { return duration ? Json(1e3 * in_seconds(*duration)) : Json{}; }

Json quantiles(const LatencyHistogram& of) {
  return {{"p50", ns(of.quantile(0.5))},
          {"p99", ns(of.quantile(0.99))},
          {"p99.9", ns(of.quantile(0.999))},
          {"max", ns(of.max())}};
}

Json quantiles(const CallCost& of) { return {{"all", quantiles(of.all)}, {"undisturbed", quantiles(of.calm)}}; }

Json in_json(const StreamSecond& second) {
  return {{"states", second.states},
          {"read", second.taken},
          {"late", second.late},
          {"torn", second.torn},
          {"damaged", second.damaged},
          {"lost", second.lost},
          {"lost_at_device", second.replaced},
          {"misses", second.misses},
          {"faults", second.faults},
          {"pauses", second.pauses}};
}

}  // namespace

std::vector<UsbFinding> findings_of(const UsbResults& results) {
  std::vector<UsbFinding> findings;
  if (!results.stream.seconds.empty()) add_stream(findings, results.stream);
  for (const FaultRow& row : results.faults) add_faults(findings, row);
  return findings;
}

void print(const UsbResults& results) {
  if (!results.stream.seconds.empty()) {
    std::printf("stream at 1 kHz\n");
    print_seconds("all seconds", results.stream, true);
    print_seconds("those without a pause", results.stream, false);
    print_call("read", results.stream.read.all);
    print_call("  undisturbed", results.stream.read.calm);
    print_call("write", results.stream.write.all);
    print_call("  undisturbed", results.stream.write.calm);
    print_call("arithmetic", results.stream.same.all);
    print_call("  undisturbed", results.stream.same.calm);
    print_call("age of a state", results.stream.age);
    print_call("late ticks", results.stream.lateness);
  }
  if (results.faults.empty()) return;
  std::printf(
      "faults; ms from the onset, median and worst: of runs that the machine did not hold up | of all\n"
      "%-20s %4s %7s %9s  %-29s %-29s\n",
      "fault", "runs", "held up", "restarts", "  until it is stated", "  until there is no torque");
  for (const FaultRow& row : results.faults) {
    std::printf("%-20s %4zu %7zu %4zu/%-4zu", words(row.name).c_str(), row.runs.size(),
                count_of(row, [](const FaultRun& run) { return run.held_up; }),
                count_of(row, [](const FaultRun& run) { return run.restarted; }), row.runs.size());
    print_spread(row, &FaultRun::to_stated);
    print_spread(row, &FaultRun::to_zero);
    std::printf("  %s", stated_by(row).c_str());
    if (row.without_torque > 0) std::printf("; %zu more attempts had no torque to take away", row.without_torque);
    std::printf("\n");
  }
}

void print(const std::vector<UsbFinding>& findings) {
  std::size_t missed = 0;
  for (const UsbFinding& finding : findings) {
    if (finding.met()) continue;
    ++missed;
    std::printf("missed: %s: %.4g, asked: at %s %.4g\n", finding.of.c_str(), finding.is,
                finding.at_most ? "most" : "least", finding.asked);
  }
  std::printf("%zu of %zu findings met\n", findings.size() - missed, findings.size());
}

std::string as_csv(const UsbResults& results) {
  std::ostringstream text;
  text << "fault,run,began,stated,stated_ms,no_torque_ms,restarted,held_up\n";
  for (const FaultRow& row : results.faults) {
    int number = 0;
    for (const FaultRun& run : row.runs) {
      const auto ms = [](const auto& took) { return took ? std::to_string(1e3 * in_seconds(*took)) : std::string(); };
      text << row.name << ',' << ++number << ',' << run.began << ',' << describe(run.stated) << ',' << ms(run.to_stated)
           << ',' << ms(run.to_zero) << ',' << run.restarted << ',' << run.held_up << '\n';
    }
  }
  return text.str();
}

std::string as_json(const UsbResults& results, const std::vector<UsbFinding>& findings) {
  Json json{{"stream", {{"seconds", Json::array()}}}, {"faults", Json::object()}, {"findings", Json::array()}};
  for (const StreamSecond& second : results.stream.seconds) json["stream"]["seconds"].push_back(in_json(second));
  json["stream"]["read_ns"] = quantiles(results.stream.read);
  json["stream"]["write_ns"] = quantiles(results.stream.write);
  json["stream"]["arithmetic_ns"] = quantiles(results.stream.same);
  json["stream"]["age_ns"] = quantiles(results.stream.age);
  json["stream"]["lateness_ns"] = quantiles(results.stream.lateness);
  for (const FaultRow& row : results.faults) {
    Json& entry = json["faults"][words(row.name)];
    entry["attempts_without_torque"] = row.without_torque;
    Json& runs = entry["runs"];
    for (const FaultRun& run : row.runs) {
      runs.push_back({{"began", run.began},
                      {"stated", describe(run.stated)},
                      {"stated_ms", in_ms(run.to_stated)},
                      {"no_torque_ms", in_ms(run.to_zero)},
                      {"restarted", run.restarted},
                      {"held_up", run.held_up}});
    }
  }
  for (const UsbFinding& finding : findings) {
    json["findings"].push_back({{"of", finding.of},
                                {"is", finding.is},
                                {"asked", finding.asked},
                                {"at_most", finding.at_most},
                                {"met", finding.met()}});
  }
  return json.dump(2) + '\n';
}

}  // namespace limpid::bench
