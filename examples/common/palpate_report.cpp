// SPDX-License-Identifier: MIT
#include "palpate_report.hpp"

#include "chart.hpp"
#include "output_file.hpp"
#include "palpate_json.hpp"
#include "trace_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <sstream>

namespace limpid::examples {

namespace {

template <typename... Values>
std::string text(const char* format, Values... values) {
  char line[160];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

std::string change(double with, double without) {
  return without > 0 ? text("%+.1f %%", 100 * relative_change(with, without)) : "-";
}

// m and m/s mixed, as (3.35) prints them.
void print_errors(std::ostream& out, const char* what, const std::vector<PalpationRun>& runs,
                  ErrorNorms<3> PalpationResult::*which) {
  const PalpationResult* hold = hold_of(runs);
  out << text("%-18s %12s %10s %12s %10s\n", what, "max", "change", "L2", "change");
  for (const PalpationRun& run : runs) {
    const Norms<> error = (run.result.*which).total();
    const bool compared = hold != nullptr && &run.result != hold;
    const Norms<> reference = compared ? (hold->*which).total() : Norms<>{};
    out << text("  %-16s %12.4g %10s %12.4g %10s\n", name(run.predictor), error.max,
                compared ? change(error.max, reference.max).c_str() : "", error.l2,
                compared ? change(error.l2, reference.l2).c_str() : "");
  }
}

void print_ticks(std::ostream& out, const std::vector<PalpationRun>& runs) {
  out << text("%-18s %12s %10s %12s %10s\n", "tick, ns", "p50", "p99", "p99.9", "max");
  for (const PalpationRun& run : runs) {
    const LatencyHistogram& tick = run.result.tick;
    const auto ns = [&](double p) { return static_cast<long>(tick.quantile(p).count()); };
    out << text("  %-16s %12ld %10ld %12ld %10ld\n", name(run.predictor), ns(0.5), ns(0.99), ns(0.999),
                static_cast<long>(tick.max().count()));
  }
}

void print_live(std::ostream& out, const LiveReport& live) {
  out << describe(live.loop) << live.samples << " samples of the tissue; ";
  if (live.without_force > 0) {
    out << live.without_force << " ticks without its force, since it gave none for too long\n";
  } else {
    out << "its force was there all the time\n";
  }
  const LiveDeviceReport& device = live.device;
  if (device.calls.count() == 0) return;
  out << text("device: %.1f states a second, %.3f %% of them used in their tick; %llu lost, %llu damaged\n",
              device.states_per_second, 100 * device.used_in_their_tick, static_cast<unsigned long long>(device.lost),
              static_cast<unsigned long long>(device.damaged))
      << text("its calls in a tick, ns: p50 %ld, p99 %ld, p99.9 %ld, max %ld\n",
              static_cast<long>(device.calls.quantile(0.5).count()),
              static_cast<long>(device.calls.quantile(0.99).count()),
              static_cast<long>(device.calls.quantile(0.999).count()), static_cast<long>(device.calls.max().count()));
  if (!device.fault.empty()) out << "device: " << device.fault << "; motors off\n";
}

// Section 3.5: a change counts where people can feel it.
void print_verdict(std::ostream& out, const std::vector<PalpationRun>& runs) {
  const PalpationResult* hold = hold_of(runs);
  if (hold == nullptr) return;
  for (const PalpationRun& run : runs) {
    if (&run.result == hold) continue;
    const double difference = relative_change(run.result.total.total().l2, hold->total.total().l2);
    const char* verdict = !significant(difference) ? "below what can be felt"
                          : difference < 0         ? "felt as better than hold"
                                                   : "felt as worse than hold";
    out << name(run.predictor)
        << text(": total L2 error %+.1f %%, %s (Weber's fraction is %g %%)\n", 100 * difference, verdict,
                100 * weber_threshold);
  }
}

// Work = kinetic + elastic + dissipated + delivered: what the hand did, and where that went.
void print_energies(std::ostream& out, const std::vector<PalpationRun>& runs) {
  out << text("%-18s %10s %10s %10s %10s %10s\n", "hand's energy, J", "work", "kinetic", "elastic", "dissipated",
              "delivered");
  for (const PalpationRun& run : runs) {
    const HandEnergy<>& of = run.result.energy;
    out << text("  %-16s %10.3g %10.3g %10.3g %10.3g %10.3g\n", name(run.predictor), of.work, of.kinetic, of.elastic,
                of.dissipated, of.delivered);
  }
}

// With a hand the force and the tool under it are each predictor's own.
std::string as_csv(const Scene& scene, const std::vector<PalpationRun>& runs) {
  std::ostringstream out;
  out.precision(12);
  out << (scene.hand ? "time_s,intention_N" : "time_s,force_N,ideal_m");
  for (const PalpationRun& run : runs) {
    if (scene.hand) out << ',' << name(run.predictor) << "_force_N," << name(run.predictor) << "_ideal_m";
    for (const char* column : {"predicted_m", "tip_m", "prediction_error", "total_error"}) {
      out << ',' << name(run.predictor) << '_' << column;
    }
  }
  out << '\n';
  for (std::size_t i = 0; i < runs.front().result.trace.size(); ++i) {
    const TracePoint& first = runs.front().result.trace[i];
    out << first.time << ',' << first.intention;
    if (!scene.hand) out << ',' << first.ideal;
    for (const PalpationRun& run : runs) {
      const TracePoint& point = run.result.trace[i];
      if (scene.hand) out << ',' << point.force << ',' << point.ideal;
      out << ',' << point.predicted << ',' << point.tip << ',' << point.prediction_error << ',' << point.total_error;
    }
    out << '\n';
  }
  return out.str();
}

Chart palpation_chart(const Scene& scene, const std::vector<PalpationRun>& runs) {
  const std::vector<TracePoint>& first = runs.front().result.trace;
  Chart chart{text("%s, sampled every %g s, seen %g s later", name(scene.tissue.kind), in_seconds(scene.period),
                   in_seconds(scene.delay)),
              {{"operator's force",
                "time (s)",
                "F_h (N)",
                {curve(scene.hand ? "intention" : "force", first, &TracePoint::intention)}},
               {"motion along the press axis", "time (s)", "x (m)", {}},
               {"prediction error (3.35)", "time (s)", "|e|", {}, true},
               {"total error (3.35)", "time (s)", "|e_tot|", {}, true}}};
  if (!scene.hand) chart.panels[1].curves.push_back(curve("virtual tool", first, &TracePoint::ideal));
  for (const PalpationRun& run : runs) {
    const std::string who = name(run.predictor);
    const auto add = [&](std::size_t panel, const std::string& title, double TracePoint::*signal) {
      Curve drawn = curve(title, run.result.trace, signal);
      drawn.colour = static_cast<int>(run.predictor) + 2;  // the same in every panel
      drawn.dashed = run.predictor == PredictorKind::ideal;
      chart.panels[panel].curves.push_back(std::move(drawn));
    };
    if (scene.hand) {
      add(0, who, &TracePoint::force);
      add(1, "virtual tool, " + who, &TracePoint::ideal);
    }
    add(1, "tip, " + who, &TracePoint::tip);
    if (run.predictor != PredictorKind::ideal) add(2, who, &TracePoint::prediction_error);
    add(3, who, &TracePoint::total_error);
  }
  return chart;
}

}  // namespace

const PalpationResult* hold_of(const std::vector<PalpationRun>& runs) {
  const auto found = std::find_if(runs.begin(), runs.end(),
                                  [](const PalpationRun& run) { return run.predictor == PredictorKind::hold; });
  return found == runs.end() ? nullptr : &found->result;
}

void print_table(std::ostream& out, const Scene& scene, const std::vector<PalpationRun>& runs) {
  out << scene.force.description << " on " << name(scene.tissue.kind) << ", "
      << text("%g s at %g Hz; sampled every %g s, seen %g s later\n", in_seconds(scene.duration),
              1 / in_seconds(scene.tick), in_seconds(scene.period), in_seconds(scene.delay));
  if (scene.hand) {
    out << text("intended by a hand of %g kg that grips with %g N s/m and %g N/m\n", scene.hand->mass,
                scene.hand->damping, scene.hand->stiffness);
  }
  print_errors(out, "prediction error", runs, &PalpationResult::prediction);
  print_errors(out, "total error", runs, &PalpationResult::total);
  if (scene.hand) print_energies(out, runs);
  print_ticks(out, runs);
  print_verdict(out, runs);
  for (const PalpationRun& run : runs) {
    if (run.result.live) print_live(out, *run.result.live);
  }
  for (const PalpationRun& run : runs) {
    if (run.result.status != Status::ok) out << name(run.predictor) << ": " << describe(run.result.status) << '\n';
  }
}

bool report_faults(std::ostream& out, const std::vector<PalpationRun>& runs) {
  bool any = false;
  for (const PalpationRun& run : runs) {
    if (!has(run.result.status, Status::fault)) continue;
    any = true;
    out << "palpate: " << name(run.predictor) << ": the safety limiter latched a fault (" << describe(run.result.status)
        << "); its figures hold for an arm without torque\n";
  }
  return any;
}

void write_outputs(std::ostream& out, const PalpateOptions& options, const std::vector<PalpationRun>& runs,
                   const PalpationResult* hold) {
  if (!options.json.empty()) {
    write_file(options.json, as_json(options.scene, runs, hold));
    out << "figures: " << options.json << '\n';
  }
  if (!options.csv.empty()) {
    write_file(options.csv, as_csv(options.scene, runs));
    out << "signals: " << options.csv << '\n';
  }
  if (!options.plot.empty()) out << "plot: " << draw(palpation_chart(options.scene, runs), options.plot) << '\n';
}

}  // namespace limpid::examples
