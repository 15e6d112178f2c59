// SPDX-License-Identifier: MIT
// The velocity of three axes at 1 kHz: from an encoder's counts, against the true one; and (5.3) by its
// discretisations, against the filter in continuous time on an input linear between ticks.
#include "time_error/method.hpp"
#include "time_error/velocity_methods.hpp"

#include <limpid/signal/adaptive_window_velocity.hpp>
#include <limpid/signal/filtered_derivative.hpp>
#include <limpid/signal/low_pass.hpp>

#include <chrono>
#include <cmath>
#include <cstddef>

namespace limpid::bench {

namespace {

constexpr int axes = 3;
constexpr std::size_t ticks = 1000;
constexpr float resolution = 0x1p-14F;  // 61 um; the Omni's is 55
constexpr std::size_t settling = 200;   // ticks that are not counted: all filters start at rest

/// Of a hand at 1 Hz, with a tremor: m and m/s.
struct Motion {
  Signals x{axes}, v{axes};
};

const Motion& motion() {
  static const Motion motion = [] {
    Motion made;
    for (std::size_t i = 0; i < ticks; ++i) {
      for (int axis = 0; axis < axes; ++axis) {
        const Fifty t = Fifty(static_cast<long>(i)) / 1000, slow = Fifty(25) / 4 * t + axis,
                    fast = Fifty(25) * t + axis;
        made.x[static_cast<std::size_t>(axis)].push_back(sin(slow) / 32 + sin(fast) / 512);
        made.v[static_cast<std::size_t>(axis)].push_back(cos(slow) * 25 / 128 + cos(fast) * 25 / 512);
      }
    }
    return made;
  }();
  return motion;
}

enum class Reading { counts, smooth };

template <typename Scalar>
std::vector<Eigen::Array<Scalar, axes, 1>> read(Reading reading) {
  std::vector<Eigen::Array<Scalar, axes, 1>> inputs(ticks);
  for (std::size_t i = 0; i < ticks; ++i) {
    for (int axis = 0; axis < axes; ++axis) {
      const Fifty& x = motion().x[static_cast<std::size_t>(axis)][i];
      const Fifty counted = round(Fifty(x / resolution)) * resolution;
      inputs[i][axis] = Scalar(static_cast<float>(reading == Reading::counts ? counted : x));
    }
  }
  return inputs;
}

template <typename Filter, typename Scalar>
class Runner {
 public:
  Runner(Reading reading, const Filter& filter) : in_{read<Scalar>(reading)}, filter_{filter}, start_{filter} {}

  Signals trajectory() {
    Signals signals;
    for (std::size_t i = 0; i < ticks; ++i) {
      const auto y = value_of(filter_.update(static_cast<Time::rep>(i) * std::chrono::milliseconds{1}, in_[i]));
      if (i >= settling) append(signals, y);
    }
    return signals;
  }

  // Flat, or a source of this size meets the compiler's limits of inlining and measures those.
  [[gnu::flatten]] void run(long count) {
    for (; count > 0; --count) {
      benchmark::DoNotOptimize(filter_.update(static_cast<Time::rep>(at_) * std::chrono::milliseconds{1}, in_[at_]));
      if (++at_ < ticks) continue;
      at_ = 0;
      filter_ = start_;
    }
  }

 private:
  template <typename Output>
  static auto value_of(const Output& output) {
    if constexpr (requires { output.value; }) {
      return output.value;
    } else {
      return output;
    }
  }

  std::vector<Eigen::Array<Scalar, axes, 1>> in_;
  Filter filter_, start_;
  std::size_t at_ = 0;
};

template <typename Scalar>
FilteredDerivative<axes, Scalar> filter_5_3(const Scalar& tau) {
  return FilteredDerivative<axes, Scalar>({.time_constant = tau});
}

template <typename Scalar>
AdaptiveWindowVelocity<axes, 16, Scalar> adaptive_window(WindowFit fit) {
  using Window = AdaptiveWindowVelocity<axes, 16, Scalar>;
  return Window({.band = Window::Vector::Constant(Scalar(resolution)), .fit = fit});
}

/// Difference behind the library's low-pass.
template <typename Scalar>
struct SmoothedDifference {
  using Vector = Eigen::Array<Scalar, axes, 1>;
  Difference<axes, Scalar> difference{};
  LowPass<axes, Scalar> low_pass{{.cutoff = Scalar(4)}};

  auto update(Time now, const Vector& u) noexcept { return low_pass.update(now, difference.update(now, u)); }
};

Signals settled(const Signals& signals) {
  Signals rest;
  for (const Signal& signal : signals) rest.emplace_back(signal.begin() + settling, signal.end());
  return rest;
}

template <typename Make>
void add_filter(std::vector<Method>& methods, const std::string& name, bool is_default, const Signals& exact,
                Reading reading, Make make) {
  add(methods, name, is_default, exact, [=]<typename Scalar>(std::type_identity<Scalar> scalar) {
    const auto filter = make(scalar);
    return Runner<std::remove_const_t<decltype(filter)>, Scalar>(reading, filter);
  });
}

std::vector<Method> from_counts() {
  const Signals exact = settled(motion().v);
  std::vector<Method> methods;
  const auto filter = [&](const std::string& name, bool is_default, auto make) {
    add_filter(methods, name, is_default, exact, Reading::counts, make);
  };
  filter("(5.3), 4 Hz", false, []<typename S>(std::type_identity<S>) { return filter_5_3<S>(S(398) / S(10'000)); });
  filter("(5.3), 20 Hz", true, []<typename S>(std::type_identity<S>) { return FilteredDerivative<axes, S>(); });
  filter("(5.3), 80 Hz", false, []<typename S>(std::type_identity<S>) { return filter_5_3<S>(S(199) / S(100'000)); });
  filter("difference, low-pass of 4 Hz", false,
         []<typename S>(std::type_identity<S>) { return SmoothedDifference<S>(); });
  filter("difference", false, []<typename S>(std::type_identity<S>) { return Difference<axes, S>(); });
  filter("adaptive window, best fit", false,
         []<typename S>(std::type_identity<S>) { return adaptive_window<S>(WindowFit::best); });
  filter("adaptive window, end fit", false,
         []<typename S>(std::type_identity<S>) { return adaptive_window<S>(WindowFit::end); });
  filter("observer, third order", false,
         []<typename S>(std::type_identity<S>) { return ThirdOrderObserver<axes, S>(S(1) / S(125)); });
  return methods;
}

/// (5.3) in continuous time on the input's chords.
Signals exact_filter() {
  const auto in = read<Fifty>(Reading::smooth);
  const Fifty tau = Fifty(398) / 10'000, h = Fifty(1) / 1000, decay = exp(Fifty(-h / tau));
  Signals signals(axes);
  for (int axis = 0; axis < axes; ++axis) {
    Fifty y = 0;
    for (std::size_t i = 1; i < ticks; ++i) {
      const Fifty slope = (in[i][axis] - in[i - 1][axis]) / h;
      y = slope + decay * (y - slope);
      if (i >= settling) signals[static_cast<std::size_t>(axis)].push_back(y);
    }
  }
  return signals;
}

std::vector<Method> discretisations() {
  const Signals exact = exact_filter();
  std::vector<Method> methods;
  const auto filter = [&](const std::string& name, bool is_default, auto make) {
    add_filter(methods, name, is_default, exact, Reading::smooth, make);
  };
  filter("exact", true, []<typename S>(std::type_identity<S>) { return filter_5_3<S>(S(398) / S(10'000)); });
  filter("explicit Euler", false, []<typename S>(std::type_identity<S>) {
    return RuledDerivative<Rule::explicit_euler, axes, S>(S(398) / S(10'000));
  });
  filter("implicit Euler", false, []<typename S>(std::type_identity<S>) {
    return RuledDerivative<Rule::implicit_euler, axes, S>(S(398) / S(10'000));
  });
  filter("Tustin", false,
         []<typename S>(std::type_identity<S>) { return RuledDerivative<Rule::tustin, axes, S>(S(398) / S(10'000)); });
  return methods;
}

}  // namespace

std::vector<Case> velocity_cases() {
  return {{"velocity", "from counts, against the true velocity", from_counts},
          {"velocity", "filter (5.3), against continuous time", discretisations}};
}

}  // namespace limpid::bench
