// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

namespace limpid::test {

/// The largest error of many trials and the trial that made it; NaN is the largest of all.
class Worst {
 public:
  void see(double error, int trial) {
    if (error <= error_) return;
    error_ = error;
    trial_ = trial;
  }
  [[nodiscard]] double error() const { return error_; }
  friend std::ostream& operator<<(std::ostream& out, const Worst& worst) {
    return out << worst.error_ << " at trial " << worst.trial_;
  }

 private:
  double error_ = 0;
  int trial_ = 0;
};

}  // namespace limpid::test
