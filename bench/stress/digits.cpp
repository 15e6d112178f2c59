// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <stress/fifty_digits.hpp>

#include <cstdio>

namespace limpid::stress {

namespace {

template <typename Scalar>
bool print_errors(const char* scalar, std::uint64_t ticks) {
  const LawErrors errors = law_errors<Scalar>(ticks);
  std::printf(
      "(k, b, c) in %s, %.3g ticks: Gamma %s; errors against 50 digits, parts of the box: k %.2g, b %.2g, c %.2g; "
      "Gamma %.2g\n",
      scalar, double(ticks), errors.definite ? "definite" : "NOT DEFINITE", errors.theta[0], errors.theta[1],
      errors.theta[2], errors.Gamma);
  return errors.definite;
}

}  // namespace

bool print_law_errors(std::uint64_t ticks) {
  const bool in_float = print_errors<float>("float", ticks);
  return print_errors<double>("double", ticks) && in_float;
}

}  // namespace limpid::stress
