// SPDX-License-Identifier: MIT
// A light tool in tissue with a smooth corner, three axes, in ticks of 1 ms: how the force beside its tangent is
// taken over a step, against the motion by extrapolation in 50 digits.
#include "time_error/method.hpp"

#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/prediction/nonlinear_step.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace limpid::bench {

namespace {

constexpr int axes = 3;
constexpr std::size_t ticks = 150;

/// How the remainder g = w(h) is taken: `early` g at the start of the step and `late` g at its end, in sixths.
struct Way {
  int early, late, corrections, parts;
};

constexpr Way linear(int corrections, int parts = 1) { return {0, 6, corrections, parts}; }
constexpr Way matched(int corrections, int parts = 1) { return {-1, 5, corrections, parts}; }

// F_h / m, what all scalars have to the last bit: in float, and made once.
[[gnu::noinline]] float push(std::size_t tick, int axis) {
  const double s = std::sin(0.02 * static_cast<double>(tick));
  return static_cast<float>((30 + 10 * axis) * s * s + 10);
}

template <typename Scalar>
class Runner {
 public:
  using State = detail::LaneMotion<axes, Scalar>;
  using Model = detail::LaneModel<axes, Scalar>;
  using Array = Lanes<axes, Scalar>;
  using Env = SmoothBilinear<axes, Scalar>;

  explicit Runner(const Way& way) : way_{way} {
    theta_.col(0).setConstant(Scalar(500));
    theta_.col(1).setConstant(Scalar(2000));
    theta_.col(2).setConstant(Scalar(4));
    for (std::size_t i = 0; i <= ticks; ++i) {
      for (int axis = 0; axis < axes; ++axis) pushed_[i][axis] = Scalar(push(i, axis));
      for (int lane = axes; lane < pushed_[i].size(); ++lane) pushed_[i][lane] = pushed_[i][axes - 1];
    }
    restart();
  }

  Signals trajectory() {
    Signals signals;
    restart();
    for (std::size_t i = 0; i < ticks; ++i) {
      tick(i);
      append(signals, from_lanes<axes>(at_.x));
    }
    return signals;
  }

  /// The same by the modified midpoint rule in 2, 4, ... 2 `columns` steps a tick, extrapolated to none.
  Signals extrapolated() {
    Signals signals;
    restart();
    for (std::size_t i = 0; i < ticks; ++i) {
      extrapolate(i);
      append(signals, from_lanes<axes>(at_.x));
    }
    return signals;
  }

  [[gnu::flatten]] void run(long count) {
    for (; count > 0; --count) {
      tick(next_);
      benchmark::DoNotOptimize(at_);
      if (++next_ == ticks) restart();
    }
  }

 private:
  void restart() {
    next_ = 0;
    at_ = {};
    here_ = model(at_);
  }

  [[nodiscard]] Model model(const State& at) const {
    const auto x = from_lanes<axes>(at.x), v = from_lanes<axes>(at.v);
    const auto [force, tangent] = environment_.response(theta_, x, v);
    const typename Env::Vector rest = force - tangent.stiffness * x - tangent.damping * v;
    return {to_lanes<axes>(tangent.stiffness) * per_mass_, to_lanes<axes>(tangent.damping) * per_mass_,
            to_lanes<axes>(rest) * -per_mass_};
  }

  void tick(std::size_t i) {
    const Array slope = (pushed_[i + 1] - pushed_[i]) / Scalar(way_.parts);
    for (int part = 0; part < way_.parts; ++part) {
      step(pushed_[i] + slope * Scalar(part), pushed_[i] + slope * Scalar(part + 1), h_ / Scalar(way_.parts));
      here_ = model(at_);
    }
  }

  void step(const Array& f0, const Array& f1, const Scalar& h) {
    response_.set_lanes(here_.kappa, here_.beta, h);
    const Array start = f0 + here_.constant, end = f1 + here_.constant;
    const State from = at_;
    response_.advance_lanes(at_.x, at_.v, start, end);
    for (int correction = 0; correction < way_.corrections; ++correction) {
      const Model there = model(at_);
      const Array sixth = ((there.constant - here_.constant) - (there.kappa - here_.kappa) * at_.x -
                           (there.beta - here_.beta) * at_.v) /
                          Scalar{6};
      at_ = from;
      response_.advance_lanes(at_.x, at_.v, start + sixth * Scalar(way_.early), end + sixth * Scalar(way_.late));
    }
  }

  [[nodiscard]] State slope(const State& at, const Array& f) const {
    const Model m = model(at);
    return {at.v, f + m.constant - m.kappa * at.x - m.beta * at.v};
  }

  void extrapolate(std::size_t i) {
    constexpr std::size_t columns = 10;
    std::array<State, columns> row;
    for (std::size_t c = 0; c < columns; ++c) {
      const int n = 2 * static_cast<int>(c + 1);
      const Scalar h = h_ / Scalar(n);
      const auto force = [&](int k) { return Array(pushed_[i] + (pushed_[i + 1] - pushed_[i]) * (Scalar(k) / n)); };
      State before = at_, now = at_ + slope(at_, force(0)) * h;
      for (int k = 1; k < n; ++k) {
        const State after = before + slope(now, force(k)) * (Scalar{2} * h);
        before = now;
        now = after;
      }
      row[c] = (before + now + slope(now, force(n)) * h) * (Scalar{1} / Scalar{2});
      for (std::size_t back = c; back > 0; --back) {  // Aitken and Neville, in h^2
        const Scalar ratio = Scalar(static_cast<long>((c + 1) * (c + 1))) / Scalar(static_cast<long>(back * back));
        row[back - 1] = row[back] + (row[back] - row[back - 1]) * (Scalar{1} / (ratio - Scalar{1}));
      }
    }
    at_ = row[0];
  }

  Way way_;
  Env environment_{{.depth = Scalar(0.0028F), .sharpness = Scalar(20)}};
  typename Env::Theta theta_;
  Scalar per_mass_{10}, h_ = Scalar(0x1p-10F);
  std::array<Array, ticks + 1> pushed_;  // m/s^2
  std::size_t next_ = 0;
  State at_;
  Model here_;
  SecondOrderStep<axes, Scalar> response_;
};

std::vector<Method> methods() {
  const Signals exact = Runner<Fifty>(linear(0)).extrapolated();
  std::vector<Method> methods;
  const auto add_way = [&](const char* name, const Way& way) {
    add(methods, name, way.early != 0 && way.corrections == 1 && way.parts == 1, exact,
        [=]<typename Scalar>(std::type_identity<Scalar>) { return Runner<Scalar>(way); });
  };
  add_way("tangent alone", linear(0));
  add_way("linear, 1 correction", linear(1));
  add_way("linear, 2 corrections", linear(2));
  add_way("linear, 3 corrections", linear(3));
  add_way("moments, 1 correction", matched(1));
  add_way("moments, 2 corrections", matched(2));
  add_way("moments, 3 corrections", matched(3));
  add_way("tangent alone, 4 substeps", linear(0, 4));
  add_way("linear, 2 corrections, 2 substeps", linear(2, 2));
  add_way("moments, 1 correction, 2 substeps", matched(1, 2));
  return methods;
}

}  // namespace

std::vector<Case> nonlinear_step_cases() {
  return {{"nonlinear step", "smooth bilinear, 3 axes", [] { return methods(); }}};
}

}  // namespace limpid::bench
