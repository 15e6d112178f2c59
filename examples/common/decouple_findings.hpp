// SPDX-License-Identifier: MIT
// What `decouple` finds; included by its sources.
#pragma once

#include "chart.hpp"
#include "decouple.hpp"
#include "decouple_device.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

inline constexpr std::array coupling_cutoffs{5.0, 10.0, 20.0, 50.0, 100.0, 200.0};  // of the table, Hz

struct CouplingRow {
  QKind kind;
  double limit;  // Hz
  std::array<std::optional<double>, coupling_cutoffs.size()> ratios;
};

struct SimulatedRun {
  DecoupleRun what;
  DecoupleTrace trace;
};

struct DecoupleFindings {
  ObservedPlant<2> plant;
  double without = 0;  // |vy/vx| of the linear device without observers
  std::vector<CouplingRow> table;
  std::vector<SimulatedRun> runs;
};

[[nodiscard]] std::string device_of(const DecoupleRun& what);
[[nodiscard]] std::string observer_of(const DecoupleRun& what);

[[nodiscard]] nlohmann::ordered_json as_json(const DecoupleOptions& options, const DecoupleFindings& findings);
[[nodiscard]] Chart chart_of(const DecoupleOptions& options, const DecoupleFindings& findings);

}  // namespace limpid::examples
