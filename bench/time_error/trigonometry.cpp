// SPDX-License-Identifier: MIT
// Sine, cosine and arc tangent of three joints at a time.
#include "time_error/method.hpp"

#include <limpid/core/lane_math.hpp>
#include <limpid/core/lanes.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace limpid::bench {

namespace {

constexpr int joints = 3;
constexpr std::size_t count = 512;

/// Angles of +-3.5 rad, with multiples of pi/2 among them only by chance; inputs of all scalars to the last bit.
[[gnu::noinline]] float angle_of(std::size_t i, int joint) {
  const auto n = static_cast<double>((i * 3 + static_cast<std::size_t>(joint)) * 7919 % 10'007);
  return static_cast<float>(7 * n / 10'007 - 3.5);
}

template <typename Scalar>
using Vector = Eigen::Array<Scalar, joints, 1>;

template <typename Scalar>
std::vector<Vector<Scalar>> angles(int first) {
  std::vector<Vector<Scalar>> angles(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int joint = 0; joint < joints; ++joint) angles[i][joint] = Scalar(angle_of(i, first + joint));
  }
  return angles;
}

/// A method is a type with `operator()(inputs...)`, of one Vector or of two.
template <typename Function, typename Scalar>
class Runner {
 public:
  Signals trajectory() {
    Signals signals;
    for (std::size_t i = 0; i < count; ++i) append(signals, function_(a_[i], b_[i]));
    return signals;
  }

  // Flat, or a source of this size meets the compiler's limits of inlining and measures those.
  [[gnu::flatten]] void run(long steps) {
    for (; steps > 0; --steps) {
      benchmark::DoNotOptimize(a_[at_]);
      benchmark::DoNotOptimize(function_(a_[at_], b_[at_]));
      at_ = (at_ + 1) % count;
    }
  }

 private:
  Function function_;
  std::vector<Vector<Scalar>> a_ = angles<Scalar>(0), b_ = angles<Scalar>(5);
  std::size_t at_ = 0;
};

template <typename Scalar>
using Six = Eigen::Array<Scalar, 2 * joints, 1>;

template <typename Scalar>
struct SineCosineByLibm {
  Six<Scalar> operator()(const Vector<Scalar>& q, const Vector<Scalar>&) const noexcept {
    using std::cos, std::sin;
    return {sin(q[0]), sin(q[1]), sin(q[2]), cos(q[0]), cos(q[1]), cos(q[2])};
  }
};

template <typename Scalar>
struct SineCosineInLanes {
  Six<Scalar> operator()(const Vector<Scalar>& q, const Vector<Scalar>&) const noexcept {
    const auto [s, c] = sine_cosine(to_lanes<joints>(q));
    return {s[0], s[1], s[2], c[0], c[1], c[2]};
  }
};

/// pi, to the last bit of any scalar.
template <typename Scalar>
Scalar pi() {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return std::numbers::pi_v<Scalar>;
  } else {
    static const Scalar value = acos(Scalar(-1));
    return value;
  }
}

/// Taylor's polynomials of degrees 7 and 6 on +-pi/4, in lanes.
template <typename Scalar>
struct SineCosineByTaylor {
  Six<Scalar> operator()(const Vector<Scalar>& q, const Vector<Scalar>&) const noexcept {
    const auto angle = to_lanes<joints>(q);
    using Array = std::remove_const_t<decltype(angle)>;
    const Array quarters = (angle * (Scalar{2} / pi<Scalar>())).round(),
                x = angle - quarters * (pi<Scalar>() / Scalar{2});
    const Array z = x * x;
    const Array s = x * (one() - z * (one() / 6) * (one() - z * (one() / 20) * (one() - z * (one() / 42))));
    const Array c = one() - z * (one() / 2) * (one() - z * (one() / 12) * (one() - z * (one() / 30)));
    const Array turned = quarters - Scalar{4} * (quarters * (one() / 4)).floor();  // 0 to 3
    const Array sine =
        (turned == one()).select(c, (turned == Scalar{2}).select(-s, (turned == Scalar{3}).select(-c, s)));
    const Array cosine =
        (turned == one()).select(-s, (turned == Scalar{2}).select(-c, (turned == Scalar{3}).select(s, c)));
    return {sine[0], sine[1], sine[2], cosine[0], cosine[1], cosine[2]};
  }
  static Scalar one() noexcept { return Scalar{1}; }
};

template <typename Scalar>
struct ArcTangentByLibm {
  Vector<Scalar> operator()(const Vector<Scalar>& y, const Vector<Scalar>& x) const noexcept {
    using std::atan2;
    return {atan2(y[0], x[0]), atan2(y[1], x[1]), atan2(y[2], x[2])};
  }
};

template <typename Scalar>
struct ArcTangentInLanes {
  Vector<Scalar> operator()(const Vector<Scalar>& y, const Vector<Scalar>& x) const noexcept {
    return arc_tangent(to_lanes<joints>(y), to_lanes<joints>(x)).template head<joints>();
  }
};

/// Abramowitz and Stegun 4.4.49, to 2e-8 on [0, 1], in lanes.
template <typename Scalar>
struct ArcTangentByTable {
  Vector<Scalar> operator()(const Vector<Scalar>& up, const Vector<Scalar>& along) const noexcept {
    const auto y = to_lanes<joints>(up), x = to_lanes<joints>(along);
    using Array = std::remove_const_t<decltype(y)>;
    const Array a = y.abs(), b = x.abs(), t = a.min(b) / a.max(b), z = t * t;
    constexpr long c[] = {28'662'257,     -161'657'367,  429'096'138,   -752'896'400, 1'065'626'393,
                          -1'420'889'944, 1'999'355'085, -3'333'314'528};  // 1e-10; from the highest power
    const Scalar unit = Scalar{1} / Scalar(10'000'000'000L);
    Array sum = Array::Constant(Scalar(c[0]) * unit);
    for (int i = 1; i < 8; ++i) sum = sum * z + Scalar(c[i]) * unit;
    const Array first = t + t * z * sum, eighth = (a > b).select(pi<Scalar>() / Scalar{2} - first, first);
    const Array outer = (x < Scalar{0}).select(pi<Scalar>() - eighth, eighth);
    return Array((y < Scalar{0}).select(-outer, outer)).template head<joints>();
  }
};

template <template <typename> class Function>
void add_function(std::vector<Method>& methods, const std::string& name, bool is_default, const Signals& exact) {
  add(methods, name, is_default, exact,
      []<typename Scalar>(std::type_identity<Scalar>) { return Runner<Function<Scalar>, Scalar>(); });
}

std::vector<Method> sines_and_cosines() {
  const Signals exact = Runner<SineCosineByLibm<Fifty>, Fifty>().trajectory();
  std::vector<Method> methods;
  add_function<SineCosineInLanes>(methods, "lane_math", true, exact);
  add_function<SineCosineByLibm>(methods, "libm", false, exact);
  add_function<SineCosineByTaylor>(methods, "Taylor, degree 7, in lanes", false, exact);
  return methods;
}

std::vector<Method> arc_tangents() {
  const Signals exact = Runner<ArcTangentByLibm<Fifty>, Fifty>().trajectory();
  std::vector<Method> methods;
  add_function<ArcTangentInLanes>(methods, "lane_math", true, exact);
  add_function<ArcTangentByLibm>(methods, "libm", false, exact);
  add_function<ArcTangentByTable>(methods, "Abramowitz-Stegun 4.4.49, in lanes", false, exact);
  return methods;
}

}  // namespace

std::vector<Case> trigonometry_cases() {
  return {{"trigonometry", "sine and cosine of 3 angles", sines_and_cosines},
          {"trigonometry", "arc tangent of 3 points", arc_tangents}};
}

}  // namespace limpid::bench
