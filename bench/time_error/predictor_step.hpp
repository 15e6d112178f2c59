// SPDX-License-Identifier: MIT
#pragma once

#include "time_error/method.hpp"
#include "time_error/second_order_methods.hpp"

#include <limpid/core/second_order_step.hpp>

#include <cmath>
#include <cstddef>

namespace limpid::bench {

// A second of m x'' + b x' + k x = F in steps of 1 ms, F linear between them.
namespace second_order {

inline constexpr std::size_t steps = 1000;

/// What all scalars have to the last bit: in float, and made once.
struct Numbers {
  std::vector<float> kappa, beta, f;
};

/// What divides by the mass of 0.1 kg is given divided. Constant: k = 2000 N/m, b = 45 N s/m. Varying: other ones in
/// every step, by up to 16 % and 10 %.
[[gnu::noinline]] inline Numbers numbers_of(int axis, bool varying) {
  Numbers numbers;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t = 0.001 * static_cast<double>(i);
    const double k = 20'000 + (varying ? 64.0 * static_cast<double>(i * 37 % 101) - 3200 : 0);
    const double b = 450 + (varying ? 3.0 * static_cast<double>(i * 17 % 31) - 45 : 0);
    numbers.kappa.push_back(static_cast<float>(k / (1 + axis)));
    numbers.beta.push_back(static_cast<float>(b / (1 + axis)));
    numbers.f.push_back(static_cast<float>(100 * std::sin(12.5 * t + axis) + 30 * std::cos(60 * t)));
  }
  return numbers;
}

template <int Axes, typename Scalar>
struct Inputs {
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  std::vector<Vector> kappa, beta, f;
  Scalar h = Scalar(0.001F);

  explicit Inputs(bool varying) : kappa(steps + 1), beta(steps + 1), f(steps + 1) {
    for (int axis = 0; axis < Axes; ++axis) {
      const Numbers numbers = numbers_of(axis, varying);
      for (std::size_t i = 0; i <= steps; ++i) {
        kappa[i][axis] = Scalar(numbers.kappa[i]);
        beta[i][axis] = Scalar(numbers.beta[i]);
        f[i][axis] = Scalar(numbers.f[i]);
      }
    }
  }
};

template <typename Step, int Axes, typename Scalar>
class Runner {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  explicit Runner(bool varying) : varying_{varying}, in_{varying} { restart(); }

  Signals trajectory() {
    Signals signals;
    restart();
    for (std::size_t i = 0; i < steps; ++i) {
      advance(i);
      append(signals, x_);
    }
    return signals;
  }

  // Flat, or a source of this size meets the compiler's limits of inlining and measures those.
  [[gnu::flatten]] void run(long count) {
    if (varying_) {
      run_as<true>(count);
    } else {
      run_as<false>(count);
    }
  }

 private:
  template <bool varying>
  [[gnu::flatten]] void run_as(long count) {
    for (; count > 0; --count) {
      if constexpr (varying) step_.set(in_.kappa[at_], in_.beta[at_], in_.h);
      step_.advance(x_, v_, in_.f[at_], in_.f[at_ + 1]);
      benchmark::DoNotOptimize(x_);
      if (++at_ == steps) restart();
    }
  }

  void restart() {
    at_ = 0;
    x_ = v_ = Vector::Zero();
    step_.set(in_.kappa[0], in_.beta[0], in_.h);
  }

  void advance(std::size_t i) {
    if (varying_) step_.set(in_.kappa[i], in_.beta[i], in_.h);
    step_.advance(x_, v_, in_.f[i], in_.f[i + 1]);
  }

  bool varying_;
  Inputs<Axes, Scalar> in_;
  std::size_t at_ = 0;
  Vector x_, v_;
  Step step_;
};

template <int Axes>
std::vector<Method> methods(bool varying) {
  const Signals exact = Runner<OnLanes<ClosedForm, Axes, Fifty>, Axes, Fifty>(varying).trajectory();
  std::vector<Method> methods;
  const auto add_law = [&]<template <typename> class Law>(const char* name) {
    add(methods, name, false, exact, [=]<typename Scalar>(std::type_identity<Scalar>) {
      return Runner<OnLanes<Law, Axes, Scalar>, Axes, Scalar>(varying);
    });
  };
  add_law.template operator()<ExplicitEuler>("explicit Euler");
  add_law.template operator()<SemiImplicitEuler>("semi-implicit Euler");
  add_law.template operator()<Tustin>("Tustin");
  add_law.template operator()<RungeKutta4>("RK4");
  add(methods, "exact, series", true, exact, [=]<typename Scalar>(std::type_identity<Scalar>) {
    return Runner<SecondOrderStep<Axes, Scalar>, Axes, Scalar>(varying);
  });
  add_law.template operator()<ClosedForm>("exact, closed form");
  if constexpr (Axes == 1) add_law.template operator()<MatrixExponential>("exact, matrix exponential");
  return methods;
}

}  // namespace second_order

// A source for each number of axes.
[[nodiscard]] std::vector<Method> predictor_step_methods_1_axis(bool varying);
[[nodiscard]] std::vector<Method> predictor_step_methods_3_axes(bool varying);

}  // namespace limpid::bench
