// SPDX-License-Identifier: MIT
#pragma once

#include "usb/faults.hpp"
#include "usb/stream.hpp"

#include <string>
#include <vector>

namespace limpid::bench {

/// Something asked, and what is.
struct UsbFinding {
  std::string of;
  double is, asked;
  bool at_most;  ///< else at least

  [[nodiscard]] bool met() const { return at_most ? is <= asked : is >= asked; }  // not where it is NaN
};

/// Everything, and how many times the machine held the emulator up.
struct UsbResults {
  StreamFigures stream;
  std::vector<FaultRow> faults;
};

/// Of those seconds and runs in which the machine did not hold the emulator up; a finding that has none is missed.
[[nodiscard]] std::vector<UsbFinding> findings_of(const UsbResults& results);

void print(const UsbResults& results);
void print(const std::vector<UsbFinding>& findings);

[[nodiscard]] std::string as_csv(const UsbResults& results);  ///< a line for each run of each fault
/// Seconds of the stream, costs, runs of the faults, findings.
[[nodiscard]] std::string as_json(const UsbResults& results, const std::vector<UsbFinding>& findings);

}  // namespace limpid::bench
