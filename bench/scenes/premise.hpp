// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>

#include <cmath>
#include <cstdint>
#include <string>

namespace limpid::bench {

/// What a scene is to be, or its cost is that of another one: what the loop says on every tick, and that the prediction
/// stays with the true tool.
struct Premise {
  Status may{};   ///< bits that a tick may have
  Status must{};  ///< bits that at least half the ticks have
};

/// Along the first axis: where something was, m, and how often it was in contact, x > 0.
struct Whereabouts {
  double lowest = 1e300, highest = -1e300;
  long in_contact = 0, ticks = 0;

  void see(double x) {
    lowest = !(x >= lowest) ? x : lowest;  // NaN too
    highest = !(x <= highest) ? x : highest;
    in_contact += x > 0;
    ++ticks;
  }
  [[nodiscard]] double contact() const { return static_cast<double>(in_contact) / static_cast<double>(ticks); }
};

/// What a run of the scene came to.
class Survey {
 public:
  explicit Survey(const Premise& premise) : premise_{premise} {}

  void see(double predicted, double truth, Status status) {
    predicted_.see(predicted);
    truth_.see(truth);
    seen_ |= status;
    unexpected_ = unexpected_ || has(status, static_cast<Status>(~static_cast<std::uint32_t>(premise_.may)));
    with_all_ += (status & premise_.must) == premise_.must;
  }

  /// What does not hold; empty where all does. The prediction may leave the tool's range by a tenth of it and 10 um,
  /// and be in contact for a twentieth of the time more or less.
  [[nodiscard]] std::string broken() const {
    const double slack = 1e-5 + (truth_.highest - truth_.lowest) / 10;
    std::string what;
    if (unexpected_) what += "a tick says " + describe(seen_) + "; ";
    if (2 * with_all_ < predicted_.ticks) what += "too few ticks say " + describe(premise_.must) + "; ";
    if (!(predicted_.lowest >= truth_.lowest - slack && predicted_.highest <= truth_.highest + slack))
      what += "predicted from " + std::to_string(predicted_.lowest) + " to " + std::to_string(predicted_.highest) +
              " m, true from " + std::to_string(truth_.lowest) + " to " + std::to_string(truth_.highest) + "; ";
    if (!(std::abs(predicted_.contact() - truth_.contact()) <= 0.05))
      what += "predicted in contact for " + std::to_string(predicted_.contact()) + " of the time, truly for " +
              std::to_string(truth_.contact()) + "; ";
    return what;
  }

 private:
  Premise premise_;
  Whereabouts predicted_, truth_;
  Status seen_{};
  bool unexpected_ = false;
  long with_all_ = 0;
};

}  // namespace limpid::bench
