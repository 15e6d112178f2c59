// SPDX-License-Identifier: MIT
#pragma once

#include <support/maximum.hpp>

#include <Eigen/Core>

#include <cmath>
#include <ostream>

namespace limpid::test {

/// The largest error of many trials and the trial that made it; NaN is the largest of all.
class Worst {
 public:
  void see(double error, int trial) {
    if (error <= error_ || std::isnan(error_)) return;
    error_ = error;
    trial_ = trial;
  }
  /// By its largest entry.
  template <typename Derived>
  void see(const Eigen::DenseBase<Derived>& error, int trial) {
    see(static_cast<double>(largest_entry(error)), trial);
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
