// SPDX-License-Identifier: MIT
#pragma once

#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <benchmark/benchmark.h>

#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace limpid::bench {

using test::Fifty;

using Signal = std::vector<Fifty>;    ///< of one quantity, at the instants of a run
using Signals = std::vector<Signal>;  ///< of all that a method is judged by

/// One way to do something in one scalar.
struct Method {
  std::string name, scalar;
  bool is_default = false;          ///< what the library does unless told otherwise
  double truncation_error = 0;      ///< of the method in 50 digits against the exact solution, relative
  double rounding_error = 0;        ///< of the method in its scalar against itself in 50 digits, relative
  std::function<void(long)> run{};  ///< so many steps
};

/// A place where there is a choice, on one set of inputs; its methods are made, and their errors found, when asked for.
struct Case {
  std::string place, name;
  std::function<std::vector<Method>()> methods;
};

/// Largest over the signals: |of - from| over the largest of |scale|. Infinite where one is not finite.
[[nodiscard]] inline double difference(const Signals& of, const Signals& from, const Signals& scale) {
  double largest = 0;
  for (std::size_t s = 0; s < of.size(); ++s) {
    Fifty error = 0, size = 0;
    for (std::size_t i = 0; i < of[s].size(); ++i) {
      const Fifty here = abs(of[s][i] - from[s][i]);
      if (!isfinite(here)) return std::numeric_limits<double>::infinity();
      error = test::maximum(error, here);
      size = test::maximum(size, Fifty(abs(scale[s][i])));
    }
    largest = test::maximum(largest, static_cast<double>(Fifty(error / size)));
  }
  return largest;
}

template <typename Scalar>
[[nodiscard]] std::string scalar_name() {
  if constexpr (std::is_same_v<Scalar, float>) return "float";
  if constexpr (std::is_same_v<Scalar, double>) return "double";
  if constexpr (std::is_same_v<Scalar, long double>) return "long double";
}

/// Adds a method in every built-in scalar.
/// @param exact  the exact solution, in 50 digits
/// @param make   of a scalar's std::type_identity makes what has `trajectory()`, from inputs that all scalars share to
///               the last bit, and `run(steps)`
template <typename Make>
void add(std::vector<Method>& methods, const std::string& name, bool is_default, const Signals& exact, Make make) {
  const Signals limit = make(std::type_identity<Fifty>{}).trajectory();
  const double truncation = difference(limit, exact, exact);
  const auto in = [&]<typename Scalar>(std::type_identity<Scalar> scalar) {
    const double rounding = difference(make(scalar).trajectory(), limit, exact);
    methods.push_back({name, scalar_name<Scalar>(), is_default, truncation, rounding,
                       [runner = make(scalar)](long steps) mutable { runner.run(steps); }});
  };
  in(std::type_identity<float>{});
  in(std::type_identity<double>{});
  in(std::type_identity<long double>{});
}

/// Appends the axes of `values`, each to a signal of its own.
template <typename Values>
void append(Signals& signals, const Values& values) {
  signals.resize(static_cast<std::size_t>(values.size()));
  for (std::size_t i = 0; i < signals.size(); ++i) signals[i].push_back(Fifty(values(static_cast<Eigen::Index>(i))));
}

// One source each, for the compiler's sake.
[[nodiscard]] std::vector<Case> predictor_step_cases();
[[nodiscard]] std::vector<Case> nonlinear_step_cases();
[[nodiscard]] std::vector<Case> least_squares_cases();
[[nodiscard]] std::vector<Case> velocity_cases();
[[nodiscard]] std::vector<Case> observer_cases();
[[nodiscard]] std::vector<Case> trigonometry_cases();
[[nodiscard]] std::vector<Case> exponential_cases();
[[nodiscard]] std::vector<Case> omni_cases();
[[nodiscard]] std::vector<Case> whole_tick_cases();

}  // namespace limpid::bench
