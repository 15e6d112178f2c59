// SPDX-License-Identifier: MIT
#pragma once

#include "time_error/method.hpp"

#include "tick/library_tick.hpp"

#include <chrono>
#include <cstddef>

namespace limpid::bench {

// The tick of three axes: composed, the same calls by hand, and as one would write it first.
namespace whole_tick {

inline constexpr std::size_t ticks = 1000;

/// Inputs and settings that all scalars have to the last bit.
inline StraightforwardTick::Settings settings() {
  auto s = TickParts<double>::settings();
  const auto round = [](auto& values) { values = values.template cast<float>().template cast<double>().eval(); };
  for (auto* vector : {&s.lower, &s.upper, &s.initial, &s.initial_gain}) round(*vector);
  for (auto* vector : {&s.wall, &s.Lambda, &s.Kd}) round(*vector);
  for (auto* vector : {&s.Gamma, &s.theta0}) round(*vector);
  for (double* value : {&s.tool.mass, &s.tool.damping, &s.tool.stiffness, &s.alpha, &s.nu, &s.rho_M, &s.L1, &s.L2}) {
    *value = static_cast<float>(*value);
  }
  return s;
}

template <typename Scalar>
const std::vector<TickInput<3, Scalar>>& inputs() {
  static const std::vector<TickInput<3, Scalar>> all = [] {
    std::vector<TickInput<3, Scalar>> made;
    for (const auto& in : tick_inputs<float>()) made.push_back(in.template cast<Scalar>());
    return made;
  }();
  return all;
}

template <typename Tick, typename Scalar>
class Runner {
 public:
  Signals trajectory() {
    Signals signals;
    for (std::size_t i = 0; i < ticks; ++i) append(signals, torque(i));
    return signals;
  }

  void run(long steps) {
    for (; steps > 0; --steps) {
      benchmark::DoNotOptimize(torque(at_));
      ++at_;
    }
  }

 private:
  auto torque(std::size_t i) {
    const auto& in = inputs<Scalar>();
    return tick_(static_cast<Time::rep>(i) * std::chrono::milliseconds{1}, in[i % in.size()]);
  }

  Tick tick_;
  std::size_t at_ = 0;
};

template <typename Scalar>
struct ByHand {
  HandWrittenTick<Scalar> tick{settings()};
  auto operator()(Time now, const TickInput<3, Scalar>& in) {
    return tick.step(now, in.F_h, in.F_h, in.tool, in.device).torque;
  }
};

template <typename Scalar>
struct Composed {
  using Loop = decltype(composed_tick<Scalar>());
  Loop tick = composed_tick<Scalar>(settings());
  auto operator()(Time now, const TickInput<3, Scalar>& in) {
    const auto [torque, status] = tick.step(now, in.F_h, in.F_h, in.tool, in.device);
    return torque;
  }
};

template <typename Tick, typename Scalar>
[[nodiscard]] Method method_of(const char* name, bool is_default, const Signals& exact) {
  using Form = Runner<Tick, Scalar>;
  return {name,
          scalar_name<Scalar>(),
          is_default,
          0,
          difference(Form().trajectory(), exact, exact),
          [runner = Form()](long steps) mutable { runner.run(steps); }};
}

template <typename Scalar>
[[nodiscard]] std::vector<Method> methods_in(const Signals& exact) {
  return {method_of<Composed<Scalar>, Scalar>("composed", true, exact),
          method_of<ByHand<Scalar>, Scalar>("by hand", false, exact)};
}

// A source each: in one they would take minutes.
[[nodiscard]] Signals in_50_digits();
[[nodiscard]] std::vector<Method> in_float(const Signals& exact);
[[nodiscard]] std::vector<Method> in_double(const Signals& exact);
[[nodiscard]] std::vector<Method> in_long_double(const Signals& exact);

}  // namespace whole_tick

}  // namespace limpid::bench
