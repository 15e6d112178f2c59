// SPDX-License-Identifier: MIT
#include "transparency_findings.hpp"
#include "words.hpp"

#include <cmath>
#include <string>

namespace limpid::examples {

namespace {

std::string settings_of(const TransparencyTask& task, const TransparencyFindings& findings) {
  const auto& [m, b] = task.problem.plant;
  const auto& [K, B] = task.problem.wall;
  const auto& [alpha, beta] = task.problem.uncertainty;
  return words("device %.6g kg +-%.4g %%, %.6g N s/m +-%.4g %%; wall %.6g N/m, %.6g N s/m\n", m, 100 * alpha, b,
               100 * beta, K, B) +
         words("T = %.6g s, hold %s, w1 = %.6g/(s + %.6g), K_c = %.8g N/m\n\n", task.problem.period,
               std::string(describe(task.problem.hold)).c_str(), task.weight, task.weight, findings.K_c);
}

std::string frequency(double peak) { return std::isfinite(peak) ? words("at %.5g rad/s", peak) : "at high frequency"; }

std::string describe(const GainFigures& figures) {
  return words("B_c = %.6g N s/m, J = %.6g, ||L|| = %.4g ", figures.gain.B_c, figures.index, figures.norm) +
         frequency(figures.peak);
}

std::string describe(const GainInterval<>& interval) {
  if (!std::isfinite(interval.upper)) return words("B_c from %.6g N s/m on", interval.lower);
  return words("B_c from %.6g to %.6g N s/m", interval.lower, interval.upper);
}

std::string words_of_model(const TransparencyFindings& findings) {
  std::string said = "optimum: ";
  said += findings.optimum ? describe(*findings.optimum) : "none, no gain of the search has a finite index J";
  said += "\n||L|| <= 1, (17): ";
  said += findings.robust.empty() ? "for no gain" : describe(findings.robust);
  said += words("\n\n%10s %14s %12s %14s\n", "B_c", "J", "||L||", "peak, rad/s");
  for (const GainFigures& row : findings.table) {
    if (std::isfinite(row.norm)) {
      said += words("%10.6g %14.8g %12.6g %14.8g\n", row.gain.B_c, row.index, row.norm, row.peak);
    } else {
      said += words("%10.6g   not stable with this hold\n", row.gain.B_c);
    }
  }
  return said;
}

std::string describe(const HapticPlant<>& plant) {
  return words("mass %.6g kg, damping %.6g N s/m", plant.mass, plant.damping);
}

std::string describe(const TransparencyTask& task, const SampledVerdict& found, const char* what) {
  const std::string gain = what + words("B_c = %.6g ", found.gain);
  const char* bounded = task.radius < 1 ? "below the asked radius" : "robustly stable";
  switch (found.verdict) {
    case Verdict::feasible:
      return gain + words("is %s when sampled, proved; largest radius found %.6g at ", bounded, found.radius) +
             describe(found.plant) + '\n';
    case Verdict::infeasible:
      return gain + words("is not %s when sampled at ", bounded) + describe(found.plant) +
             words(": spectral radius %.6g\n", found.radius);
    default:
      return gain +
             words("is neither proved nor refuted to be %s when sampled; largest radius found %.6g at ", bounded,
                   found.radius) +
             describe(found.plant) + '\n';
  }
}

std::string words_of_offer(const TransparencyTask& task, const SampledFindings& sampled) {
  if (!sampled.offered) {
    return "no gain is proved robustly stable when sampled and has ||L|| <= 1 and a finite J: none to offer\n";
  }
  const auto& [figures, verdict] = *sampled.offered;
  const bool optimal = sampled.optimum && sampled.optimum->gain == verdict.gain;
  std::string said = "the best gain that is, and has ||L|| <= 1";
  said += (optimal ? ", is the optimum: " : ": ") + describe(figures) + '\n';
  said += words("  its largest radius is %.6g, at ", verdict.radius) + describe(verdict.plant);
  if (!optimal && task.radius == 1) said += "; --radius asks for a margin";
  return said + '\n';
}

std::string words_of_loop(const TransparencyTask& task, const SampledFindings& sampled) {
  const bool measured = sampled.velocity == VelocitySource::sampled;
  std::string said = std::string("\nsampled loop, velocity ") + (measured ? "measured" : "by backward difference");
  if (task.delay > 0) said += words(", %.6g s late", task.delay);
  if (std::isfinite(task.cutoff)) said += words(", low-pass %.6g Hz", task.cutoff);
  const std::string held = task.radius < 1 ? words("radius below %.6g", task.radius) : "stable";
  said += ":\n" + held + " for the nominal device: ";
  said += sampled.nominal.empty() ? "for no gain" : describe(sampled.nominal);
  said += "\nproved " + held + " for every mass and damping of the box: ";
  said += (sampled.robust.empty() ? "for no gain" : describe(sampled.robust)) + "\n";
  if (sampled.robust.empty() && !sampled.found.empty()) {
    said += "  (not refuted on a grid of plants, nor proved: " + describe(sampled.found) + ")\n";
  }
  if (sampled.optimum) said += describe(task, *sampled.optimum, "the optimum ");
  for (const SampledVerdict& gain : sampled.gains) said += describe(task, gain, "");
  return said + words_of_offer(task, sampled);
}

std::string words_of_steps(const TransparencyTask& task, const TransparencyFindings& findings) {
  std::string said = words("\nstep of %.6g N, nominal device, sampled, velocity %s; x in mm at\n%10s %10s %10s",
                           *task.force, task.step_velocity == VelocitySource::sampled ? "measured" : "by difference",
                           "B_c", "overshoot", "2 %, ms");
  for (const double time : StepResponse::times) said += words("%7.4g ms", 1e3 * time);
  said += '\n';
  for (const StepResponse& step : findings.steps) {
    said += words("%10.6g ", step.gain);
    said += std::isfinite(step.settling) ? words("%8.1f %% %10.4g", 100 * step.overshoot, 1e3 * step.settling)
                                         : words("%21s", "does not settle");
    for (const double x : step.points) said += std::isfinite(x) ? words("%10.4f", 1e3 * x) : words("%10s", "-");
    said += '\n';
  }
  return said;
}

}  // namespace

std::string words_of(const TransparencyTask& task, const TransparencyFindings& findings) {
  std::string said = settings_of(task, findings) + words_of_model(findings);
  for (const SampledFindings& sampled : findings.sampled) said += words_of_loop(task, sampled);
  if (task.force) said += words_of_steps(task, findings);
  return said;
}

}  // namespace limpid::examples
