// SPDX-License-Identifier: MIT
// The Omni's kinematics and regressor: the library's against the equations as they are printed.
#include "time_error/method.hpp"
#include "time_error/printed_omni.hpp"

#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include <cmath>
#include <cstddef>

namespace limpid::bench {

namespace {

constexpr std::size_t count = 256;

/// Values that all scalars have to the last bit.
struct Numbers {
  float q[3], rate[3], reference[3], acceleration[3];
};

enum class Workspace { inner, outstretched };

/// Poses within the limits, or with the elbow almost straight, where the arc cosine of (3.5) is badly conditioned.
[[gnu::noinline]] Numbers numbers_of(std::size_t i, Workspace workspace) {
  const double a = 0.0245 * static_cast<double>(i);
  Numbers n{};
  const bool inner = workspace == Workspace::inner;
  const double q2 = inner ? 0.6 + 0.2 * std::cos(2 * a) : 0.3 + 0.1 * std::cos(2 * a);
  const double q3 = inner ? -1.3 + 0.6 * std::sin(3 * a) : -0.3 + 0.04 * std::sin(3 * a);
  const double q[3] = {0.8 * std::sin(a), q2, q3};
  for (int j = 0; j < 3; ++j) {
    n.q[j] = static_cast<float>(q[j]);
    n.rate[j] = static_cast<float>(std::sin(5 * a + j));
    n.reference[j] = static_cast<float>(std::cos(4 * a + j));
    n.acceleration[j] = static_cast<float>(9 * std::sin(2 * a + 2 * j));
  }
  return n;
}

template <typename Scalar>
struct Inputs {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  Vector q, x, rate, reference, acceleration;
};

template <typename Scalar>
Eigen::Matrix<Scalar, 3, 1> vector_of(const float (&values)[3]) {
  return {Scalar(values[0]), Scalar(values[1]), Scalar(values[2])};
}

/// The tips' positions are rounded to float, too, and then inputs.
template <typename Scalar>
std::vector<Inputs<Scalar>> inputs(Workspace workspace) {
  std::vector<Inputs<Scalar>> inputs;
  for (std::size_t i = 0; i < count; ++i) {
    const Numbers n = numbers_of(i, workspace);
    const Eigen::Matrix<Fifty, 3, 1> tip = Omni<Fifty>().at(vector_of<Fifty>(n.q)).position();
    const float x[3] = {static_cast<float>(tip[0]), static_cast<float>(tip[1]), static_cast<float>(tip[2])};
    inputs.push_back({vector_of<Scalar>(n.q), vector_of<Scalar>(x), vector_of<Scalar>(n.rate),
                      vector_of<Scalar>(n.reference), vector_of<Scalar>(n.acceleration)});
  }
  return inputs;
}

template <typename Function, typename Scalar>
class Runner {
 public:
  explicit Runner(Workspace workspace) : in_{inputs<Scalar>(workspace)} {}

  Signals trajectory() {
    Signals signals;
    for (const auto& in : in_) append(signals, function_(in).reshaped());
    return signals;
  }

  // Flat, or a source of this size meets the compiler's limits of inlining and measures those.
  [[gnu::flatten]] void run(long steps) {
    for (; steps > 0; --steps) {
      benchmark::DoNotOptimize(in_[at_]);
      benchmark::DoNotOptimize(function_(in_[at_]));
      at_ = (at_ + 1) % count;
    }
  }

 private:
  Function function_;
  std::vector<Inputs<Scalar>> in_;
  std::size_t at_ = 0;
};

/// Joints, rates and accelerations of a tip's motion.
template <typename Scalar>
struct InverseByLibrary {
  OmniKinematics<Scalar> kinematics{Omni<Scalar>()};
  Eigen::Matrix<Scalar, 3, 3> operator()(const Inputs<Scalar>& in) const noexcept {
    const auto motion = kinematics.inverse(in.x, in.rate, in.acceleration);
    Eigen::Matrix<Scalar, 3, 3> columns;
    columns.col(0) = motion.q;
    columns.col(1) = motion.qdot;
    columns.col(2) = motion.qddot;
    return columns;
  }
};

template <typename Scalar>
struct InverseAsPrinted {
  Eigen::Matrix<Scalar, 3, 3> operator()(const Inputs<Scalar>& in) const noexcept {
    return PrintedOmni<Scalar>().inverse(in.x, in.rate, in.acceleration);
  }
};

/// J and J'.
template <typename Scalar>
struct JacobiansByLibrary {
  Omni<Scalar> robot{};
  Eigen::Matrix<Scalar, 3, 6> operator()(const Inputs<Scalar>& in) const noexcept {
    const auto pose = robot.at(in.q);
    Eigen::Matrix<Scalar, 3, 6> both;
    both.template leftCols<3>() = pose.jacobian();
    both.template rightCols<3>() = pose.jacobian_dot(in.rate);
    return both;
  }
};

template <typename Scalar>
struct JacobiansAsPrinted {
  Eigen::Matrix<Scalar, 3, 6> operator()(const Inputs<Scalar>& in) const noexcept {
    Eigen::Matrix<Scalar, 3, 6> both;
    both.template leftCols<3>() = PrintedOmni<Scalar>().jacobian(in.q);
    both.template rightCols<3>() = PrintedOmni<Scalar>().jacobian_dot(in.q, in.rate);
    return both;
  }
};

/// phi_r theta and phi_r' delta.
template <typename Scalar>
struct ProductsByLibrary {
  Omni<Scalar> robot{};
  typename Omni<Scalar>::Parameters theta = Omni<Scalar>::table_5_2();
  Eigen::Matrix<Scalar, 12, 1> operator()(const Inputs<Scalar>& in) const noexcept {
    const auto pose = robot.at(in.q);
    Eigen::Matrix<Scalar, 12, 1> both;
    both.template head<3>() = pose.torque(theta, in.rate, in.reference, in.acceleration);
    both.template tail<9>() = pose.adaptation_direction(in.rate, in.reference, in.acceleration, in.rate - in.reference);
    return both;
  }
};

template <typename Scalar>
struct ProductsAsPrinted {
  typename Omni<Scalar>::Parameters theta = Omni<Scalar>::table_5_2();
  Eigen::Matrix<Scalar, 12, 1> operator()(const Inputs<Scalar>& in) const noexcept {
    const auto phi_r = PrintedOmni<Scalar>().regressor(in.q, in.rate, in.reference, in.acceleration);
    Eigen::Matrix<Scalar, 12, 1> both;
    both.template head<3>() = phi_r * theta;
    both.template tail<9>() = phi_r.transpose() * (in.rate - in.reference);
    return both;
  }
};

template <template <typename> class Library, template <typename> class Printed>
std::vector<Method> methods(Workspace workspace) {
  const Signals exact = Runner<Printed<Fifty>, Fifty>(workspace).trajectory();
  std::vector<Method> methods;
  add(methods, "library", true, exact,
      [=]<typename Scalar>(std::type_identity<Scalar>) { return Runner<Library<Scalar>, Scalar>(workspace); });
  add(methods, "as printed", false, exact,
      [=]<typename Scalar>(std::type_identity<Scalar>) { return Runner<Printed<Scalar>, Scalar>(workspace); });
  return methods;
}

}  // namespace

std::vector<Case> omni_cases() {
  return {{"Omni", "inverse motion", [] { return methods<InverseByLibrary, InverseAsPrinted>(Workspace::inner); }},
          {"Omni", "inverse motion, elbow almost straight",
           [] { return methods<InverseByLibrary, InverseAsPrinted>(Workspace::outstretched); }},
          {"Omni", "J and J'", [] { return methods<JacobiansByLibrary, JacobiansAsPrinted>(Workspace::inner); }},
          {"Omni", "torque and adaptation direction",
           [] { return methods<ProductsByLibrary, ProductsAsPrinted>(Workspace::inner); }}};
}

}  // namespace limpid::bench
