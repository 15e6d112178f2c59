// SPDX-License-Identifier: MIT
// The thesis's simulations, and its experiments in simulation, with the printed gains; printed values beside ours.
#include "common/output_file.hpp"
#include "common/section.hpp"
#include "common/section_run_report.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

namespace {

using namespace limpid::examples;
using Json = nlohmann::ordered_json;

SectionReport run_section(const std::string& section, std::optional<int> number, const std::string& force,
                          double peak) {
  const auto press = [&] { return force.empty() ? press_like_force() : recorded_force(force, 1); };
  if (section == "5.2.7") return section_5_2_7();
  if (section == "6.1.1") return section_6_1_1();
  if (section == "6.1.2") return section_6_1_2();
  if (section == "6.1.3") return section_6_1_3();
  if (section == "6.2.1") return section_6_2_1();
  if (section == "6.2.2") return section_6_2_2();
  if (section == "7.1") return section_7_1(press(), peak);
  if (section == "7.2") return section_7_2(press(), peak);
  return section_6_1_4(number);
}

void print(const SectionReport& report) {
  std::cout << report.title << '\n';
  for (const std::string& note : report.notes) std::cout << "# " << note << '\n';
  print_runs(std::cout, report.runs);
  if (!report.cases.empty()) {
    std::printf("%-6s %20s %20s\n", "case", "bound (printed)", "L2 (printed)");
    for (const CaseComparison& which : report.cases) {
      std::printf("%-6d %9.1f %% (%.1f %%) %9.1f %% (%.1f %%)\n", which.number, 100 * which.bound_change,
                  100 * which.printed_bound_change, 100 * which.l2_change, 100 * which.printed_l2_change);
    }
  }
  for (const Comparison& figure : report.figures) {
    std::printf("%-72s %12.4g", figure.name.c_str(), figure.ours);
    if (figure.printed) std::printf("  printed %.4g", *figure.printed);
    std::printf(" %s%s%s\n", figure.unit.c_str(), figure.remark.empty() ? "" : "  # ", figure.remark.c_str());
  }
  std::fflush(stdout);
}

Json as_json(const SectionReport& report) {
  Json figures = Json::array(), cases = Json::array();
  for (const Comparison& figure : report.figures) {
    Json entry{{"name", figure.name}, {"ours", figure.ours}, {"printed", nullptr}, {"unit", figure.unit}};
    if (figure.printed) entry["printed"] = *figure.printed;
    if (!figure.remark.empty()) entry["remark"] = figure.remark;
    figures.push_back(entry);
  }
  for (const CaseComparison& which : report.cases) {
    cases.push_back(
        {{"case", which.number},
         {"bound_change", which.bound_change},
         {"l2_change", which.l2_change},
         {"printed", {{"bound_change", which.printed_bound_change}, {"l2_change", which.printed_l2_change}}}});
  }
  if (!report.runs.empty()) {
    return {{"notes", report.notes}, {"runs", runs_as_json(report.runs)}, {"figures", figures}};
  }
  if (report.cases.empty()) return figures;
  return {{"cases", cases}, {"figures", figures}};
}

void write_charts(const std::string& folder, const SectionReport& report) {
  std::filesystem::create_directories(folder);
  const auto draw_all = [&](const auto& plots) {
    for (const auto& plot : plots) {
      const auto path = std::filesystem::path(folder) / (plot.first + ".svg");
      std::cout << "plot: " << draw(plot.second, path.string()) << '\n';
    }
  };
  draw_all(report.charts);
  draw_all(report.heat_maps);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "The thesis's simulations, and its experiments in simulation, with the printed gains; printed values beside "
      "ours.",
      "reproduce"};
  std::string section, force, json, plot;
  int number = 0;
  double peak = 10;  // 7.1
  app.add_option("--section", section, "of the thesis")
      ->required()
      ->check(CLI::IsMember({"5.2.7", "6.1.1", "6.1.2", "6.1.3", "6.1.4", "6.2.1", "6.2.2", "7.1", "7.2"}));
  CLI::Option* one = app.add_option("--case", number, "one row of Table 6.5 (6.1.4)")->check(CLI::Range(1, 9));
  CLI::Option* recorded =
      app.add_option("--force", force,
                     "operator's force, 7.1 and 7.2: CSV of time, force; default: smooth presses, drawn by hand")
          ->check(CLI::ExistingFile);
  CLI::Option* scaled = app.add_option("--force-peak", peak, "7.1 and 7.2: the force is scaled to this, N; default 10")
                            ->check(CLI::Range(0.1, 100.0));
  app.add_option("--json", json, "write the figures here");
  app.add_option("--plot", plot, "draw the thesis's figures into this folder (SVG)");
  try {
    app.parse(argc, argv);
    if (one->count() > 0 && section != "6.1.4") {
      throw CLI::ValidationError("--case", "goes with --section 6.1.4, got " + section);
    }
    for (const CLI::Option* option : {recorded, scaled}) {
      if (option->count() == 0 || section.front() == '7') continue;
      throw CLI::ValidationError(option->get_name(), "goes with --section 7.1 and 7.2, got " + section);
    }
    const std::string refusal = json.empty() ? std::string{} : refusal_of_output(json);
    if (!refusal.empty()) throw CLI::ValidationError("--json", refusal);
    const SectionReport report =
        run_section(section, one->count() > 0 ? std::optional<int>(number) : std::nullopt, force, peak);
    print(report);
    if (!json.empty()) {
      write_file(json, as_json(report).dump(2) + '\n');
      std::cout << "figures: " << json << '\n';
    }
    if (!plot.empty()) write_charts(plot, report);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << "reproduce: " << error.what() << '\n';
    return 1;
  }
}
