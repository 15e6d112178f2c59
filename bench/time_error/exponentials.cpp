// SPDX-License-Identifier: MIT
// Powers, exponentials and logarithms of three axes at a time, as environments ask for them.
#include "time_error/method.hpp"

#include <limpid/core/lane_exponential.hpp>
#include <limpid/core/lane_power.hpp>
#include <limpid/core/lanes.hpp>

#include <cmath>
#include <cstddef>

namespace limpid::bench {

namespace {

constexpr int axes = 3;
constexpr std::size_t count = 512;

template <typename Scalar>
using Vector = Eigen::Array<Scalar, axes, 1>;

/// From above 0 to 1; inputs of all scalars to the last bit.
[[gnu::noinline]] float share_of(std::size_t i, int axis) {
  const auto n = static_cast<double>((i * 3 + static_cast<std::size_t>(axis)) * 7919 % 10'007 + 1);
  return static_cast<float>(n / 10'008);
}

template <typename Scalar>
std::vector<Vector<Scalar>> shares() {
  std::vector<Vector<Scalar>> shares(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < axes; ++axis) shares[i][axis] = Scalar(share_of(i, axis));
  }
  return shares;
}

/// A method is a type with `operator()(values)`.
template <typename Function, typename Scalar>
class Runner {
 public:
  Signals trajectory() {
    Signals signals;
    for (const Vector<Scalar>& each : of_) append(signals, function_(each));
    return signals;
  }

  // Flat, as a predictor is, and for the reason that trigonometry.cpp gives.
  [[gnu::flatten]] void run(long steps) {
    for (; steps > 0; --steps) {
      benchmark::DoNotOptimize(of_[at_]);
      benchmark::DoNotOptimize(function_(of_[at_]));
      at_ = (at_ + 1) % count;
    }
  }

 private:
  Function function_;
  std::vector<Vector<Scalar>> of_ = shares<Scalar>();
  std::size_t at_ = 0;
};

/// N - 1 of Hunt and Crossley's tissue in section 7.1.2, the same in all scalars.
template <typename Scalar>
Scalar exponent() {
  return Scalar(0.3f);
}

template <typename Scalar>
struct PowerInLanes {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept { return power(x, exponent<Scalar>()); }
};

template <typename Scalar>
struct PowerByLibm {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept {
    using std::pow;
    const Scalar p = exponent<Scalar>();
    return {pow(x[0], p), pow(x[1], p), pow(x[2], p)};
  }
};

/// What one writes without thought of rounding: the logarithm's is multiplied by as much as it is larger than one.
template <typename Scalar>
struct PowerByLogarithm {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept {
    return exponential(Vector<Scalar>(exponent<Scalar>() * logarithm(x)));
  }
};

template <typename Scalar>
struct PowerByEigen {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept {
    const auto lanes = to_lanes<axes>(x);
    using Array = std::remove_const_t<decltype(lanes)>;
    return Array(lanes.pow(Array::Constant(exponent<Scalar>()))).template head<axes>();
  }
};

template <typename Scalar>
struct ExponentialInLanes {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept { return exponential(Vector<Scalar>(-x)); }
};

template <typename Scalar>
struct ExponentialByLibm {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept {
    using std::exp;
    return {exp(-x[0]), exp(-x[1]), exp(-x[2])};
  }
};

template <typename Scalar>
struct ExponentialByEigen {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept {
    const auto lanes = to_lanes<axes>(x);
    using Array = std::remove_const_t<decltype(lanes)>;
    return Array((-lanes).exp()).template head<axes>();
  }
};

template <typename Scalar>
struct LogarithmInLanes {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept { return logarithm_of_one_plus(x); }
};

template <typename Scalar>
struct LogarithmByLibm {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept {
    using std::log1p;
    return {log1p(x[0]), log1p(x[1]), log1p(x[2])};
  }
};

template <typename Scalar>
struct LogarithmByEigen {
  Vector<Scalar> operator()(const Vector<Scalar>& x) const noexcept {
    const auto lanes = to_lanes<axes>(x);
    using Array = std::remove_const_t<decltype(lanes)>;
    return Array(lanes.log1p()).template head<axes>();
  }
};

template <template <typename> class Function>
void add_function(std::vector<Method>& methods, const std::string& name, bool is_default, const Signals& exact) {
  add(methods, name, is_default, exact,
      []<typename Scalar>(std::type_identity<Scalar>) { return Runner<Function<Scalar>, Scalar>(); });
}

template <template <typename> class InLanes, template <typename> class ByLibm, template <typename> class ByEigen>
std::vector<Method> three_ways(const std::string& header) {
  const Signals exact = Runner<ByLibm<Fifty>, Fifty>().trajectory();
  std::vector<Method> methods;
  add_function<InLanes>(methods, header, true, exact);
  add_function<ByLibm>(methods, "libm", false, exact);
  add_function<ByEigen>(methods, "Eigen's packets, in lanes", false, exact);
  return methods;
}

std::vector<Method> powers() {
  std::vector<Method> methods = three_ways<PowerInLanes, PowerByLibm, PowerByEigen>("lane_power");
  add_function<PowerByLogarithm>(methods, "exp(p ln x), in lanes", false,
                                 Runner<PowerByLibm<Fifty>, Fifty>().trajectory());
  return methods;
}

}  // namespace

std::vector<Case> exponential_cases() {
  return {{"power", "3 depths to the power of 0.3", powers},
          {"exponential", "exponentials of 3 depths",
           [] { return three_ways<ExponentialInLanes, ExponentialByLibm, ExponentialByEigen>("lane_exponential"); }},
          {"exponential", "ln(1 + x) of 3 exponentials",
           [] { return three_ways<LogarithmInLanes, LogarithmByLibm, LogarithmByEigen>("lane_exponential"); }}};
}

}  // namespace limpid::bench
