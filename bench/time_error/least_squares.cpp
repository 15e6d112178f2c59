// SPDX-License-Identifier: MIT
// Two parameters of three axes, (4.44)-(4.46), by all forms of Gamma; ticks of 1 ms.
#include "time_error/method.hpp"

#include <limpid/estimation/projection_rls.hpp>

#include "time_error/least_squares_methods.hpp"

#include <cmath>
#include <cstddef>

namespace limpid::bench {

namespace {

constexpr int axes = 3;
constexpr std::size_t ticks = 2000;
constexpr float dt = 0.001F, alpha = 2, nu = 0.01F;

/// What all scalars have to the last bit: in float, and made once.
struct Numbers {
  std::vector<float> x, v, F;
};

/// k = 800 N/m and b = 33 N s/m, pressed at 2 Hz or hardly moved, and a force beside it that no parameter explains.
[[gnu::noinline]] Numbers numbers_of(int axis, bool weak) {
  Numbers numbers;
  for (std::size_t i = 0; i < ticks; ++i) {
    const double t = 0.001 * static_cast<double>(i), w = 12.5, angle = w * t + axis, moved = weak ? 1e-6 : 0.005;
    numbers.x.push_back(static_cast<float>(0.005 - moved * std::cos(angle)));
    numbers.v.push_back(static_cast<float>(moved * w * std::sin(angle)));
    numbers.F.push_back(static_cast<float>(800 * (0.005 - moved * std::cos(angle)) + 33 * moved * w * std::sin(angle) +
                                           0.1 * std::sin(77 * t)));
  }
  return numbers;
}

template <typename Scalar>
struct Inputs {
  using Vector = Eigen::Array<Scalar, axes, 1>;
  using Theta = Eigen::Array<Scalar, axes, 2>;
  std::vector<Theta> phi{ticks};
  std::vector<Vector> F{ticks};
  Theta initial, gain, bound;

  explicit Inputs(bool weak) {
    for (int axis = 0; axis < axes; ++axis) {
      const Numbers numbers = numbers_of(axis, weak);
      for (std::size_t i = 0; i < ticks; ++i) {
        phi[i](axis, 0) = Scalar(numbers.x[i]);
        phi[i](axis, 1) = Scalar(numbers.v[i]);
        F[i][axis] = Scalar(numbers.F[i]);
      }
    }
    initial.col(0).setConstant(Scalar(1100));
    initial.col(1).setConstant(Scalar(30));
    gain.col(0).setConstant(Scalar(1e9F));
    gain.col(1).setConstant(Scalar(8e6F));
    bound.setConstant(Scalar(1e30F));
  }
};

/// The library's, with a box and a limit of the gain that it does not meet.
template <typename Scalar>
struct Library : ProjectionRLS<2, axes, Scalar> {
  using Base = ProjectionRLS<2, axes, Scalar>;
  using Theta = typename Base::Theta;

  Library(const Theta& initial, const Theta& gain, const Theta& bound, const Scalar& forgetting, const Scalar& n)
      : Base(settings(initial, gain, bound, forgetting, n)) {}

  static typename Base::Settings settings(const Theta& initial, const Theta& gain, const Theta& bound,
                                          const Scalar& forgetting, const Scalar& n) {
    typename Base::Settings s;
    s.lower = -bound;
    s.upper = bound;
    s.initial = initial;
    s.initial_gain = gain;
    s.forgetting = forgetting;
    s.normalisation = n;
    s.gain_limit = Scalar(1e30F);
    return s;
  }
};

template <typename Array>
using UD = UDFactors<2, Array>;

template <typename Estimator, typename Scalar>
class Runner {
 public:
  explicit Runner(bool weak) : in_{weak}, estimator_{start()} {}

  Signals trajectory() {
    Signals signals;
    for (std::size_t i = 0; i < ticks; ++i) {
      (void)estimator_.update(Scalar(dt), in_.phi[i], in_.F[i]);
      append(signals, estimator_.theta().reshaped());
    }
    return signals;
  }

  // Flat, or a source of this size meets the compiler's limits of inlining and measures those.
  [[gnu::flatten]] void run(long count) {
    for (; count > 0; --count) {
      (void)estimator_.update(Scalar(dt), in_.phi[at_], in_.F[at_]);
      benchmark::DoNotOptimize(estimator_);
      if (++at_ < ticks) continue;
      at_ = 0;
      estimator_ = start();
    }
  }

 private:
  [[gnu::noinline]] Estimator start() const {
    return Estimator(in_.initial, in_.gain, in_.bound, Scalar(alpha), Scalar(nu));
  }

  Inputs<Scalar> in_;
  Estimator estimator_;
  std::size_t at_ = 0;
};

/// The exact solution, by Gamma's inverse and the law's equation as printed with exponentials.
Signals exact_solution(bool weak) {
  const Inputs<Fifty> in(weak);
  const Fifty t(dt), a(alpha), n(nu), p = a * n, T = exp(Fifty(a * t));
  Signals signals(2 * axes);
  for (int axis = 0; axis < axes; ++axis) {
    Fifty k = in.initial(axis, 0), b = in.initial(axis, 1);
    Fifty P11 = 1 / in.gain(axis, 0), P22 = 1 / in.gain(axis, 1), P12 = 0;
    for (std::size_t i = 0; i < ticks; ++i) {
      const Fifty x = in.phi[i](axis, 0), v = in.phi[i](axis, 1), det = P11 * P22 - P12 * P12;
      const Fifty g1 = (P22 * x - P12 * v) / det, g2 = (P11 * v - P12 * x) / det, s = x * g1 + v * g2;
      const Fifty target = s * (T - 1) / a;
      Fifty l = target / (1 + n * s);
      for (int newton = 0; newton < 8 && s > 0; ++newton) {  // from a bound, each time with twice the digits
        const Fifty whole = exp(l), part = exp(Fifty(p * l));
        l -= ((whole - part) / (1 - p) + n * s * (part - 1) / p - target) /
             ((whole - p * part) / (1 - p) + n * s * part);
      }
      const Fifty u = s > 0 ? Fifty((exp(l) - 1) / s) : Fifty((T - 1) / a);
      const Fifty factor = (k * x + b * v - in.F[i][axis]) * u / (1 + s * u);
      k -= g1 * factor;
      b -= g2 * factor;
      P11 = (P11 + u * x * x) / T;
      P22 = (P22 + u * v * v) / T;
      P12 = (P12 + u * x * v) / T;
      signals[static_cast<std::size_t>(axis)].push_back(k);
      signals[static_cast<std::size_t>(axes + axis)].push_back(b);
    }
  }
  return signals;
}

template <Gathering gathering, template <typename> class Form>
void add_form(std::vector<Method>& methods, const std::string& name, const Signals& exact, bool weak) {
  add(methods, name, false, exact, [=]<typename Scalar>(std::type_identity<Scalar>) {
    return Runner<LeastSquares<Form, gathering, axes, Scalar>, Scalar>(weak);
  });
}

std::vector<Method> methods(bool weak) {
  const Signals exact = exact_solution(weak);
  std::vector<Method> methods;
  add(methods, "exact law, UD, box", true, exact,
      [=]<typename Scalar>(std::type_identity<Scalar>) { return Runner<Library<Scalar>, Scalar>(weak); });
  add_form<Gathering::exact, UD>(methods, "exact law, UD", exact, weak);
  add_form<Gathering::exact, FullCovariance>(methods, "exact law, full", exact, weak);
  add_form<Gathering::exact, SymmetricCovariance>(methods, "exact law, symmetric", exact, weak);
  add_form<Gathering::exact, SquareRoot>(methods, "exact law, square root", exact, weak);
  add_form<Gathering::per_sample, UD>(methods, "per-sample law, UD", exact, weak);
  add_form<Gathering::per_sample, FullCovariance>(methods, "per-sample law, full", exact, weak);
  add_form<Gathering::per_sample, SymmetricCovariance>(methods, "per-sample law, symmetric", exact, weak);
  add_form<Gathering::per_sample, SquareRoot>(methods, "per-sample law, square root", exact, weak);
  add(methods, "law by Euler", false, exact, [=]<typename Scalar>(std::type_identity<Scalar>) {
    return Runner<IntegratedLeastSquares<false, axes, Scalar>, Scalar>(weak);
  });
  add(methods, "law by RK4", false, exact, [=]<typename Scalar>(std::type_identity<Scalar>) {
    return Runner<IntegratedLeastSquares<true, axes, Scalar>, Scalar>(weak);
  });
  return methods;
}

}  // namespace

std::vector<Case> least_squares_cases() {
  return {{"least squares", "press, 3 axes", [] { return methods(false); }},
          {"least squares", "hardly moved, 3 axes", [] { return methods(true); }}};
}

}  // namespace limpid::bench
