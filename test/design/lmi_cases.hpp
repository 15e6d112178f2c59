// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi.hpp>

#include <Eigen/Core>

namespace limpid::test {

inline Eigen::Matrix2d matrix(double a, double b, double c, double d) {
  Eigen::Matrix2d A;
  A << a, b, c, d;
  return A;
}

/// A'P + P A < 0 and P > 0.
struct Lyapunov {
  Lmi<> lmi{};
  LmiExpression<> P = lmi.symmetric("P", 2);

  explicit Lyapunov(const Eigen::Matrix2d& A) {
    lmi.require(A.transpose() * P + P * A < 0);
    lmi.require(P > 0);
  }
};

}  // namespace limpid::test
