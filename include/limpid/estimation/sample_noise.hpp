// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/estimation/noise_levels.hpp>

#include <Eigen/Core>

namespace limpid {

/// How noisy x, v and F_e of a tissue's samples are, learnt from their innovations; and the covariance of what a force
/// that no law has does to x and v from one sample to the next.
/// @realtime  no allocation, no throw for built-in scalars; some thirty logarithms and exponentials a sample
template <Real Scalar = double>
class SampleNoise {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  /// What x and v at the end of an interval have of a constant force of 1 N over it: m/N, m/(N s).
  struct Gains {
    Scalar x{0}, v{0};
  };

  /// @param deviation  of that force, N
  explicit SampleNoise(const Scalar& deviation) noexcept : process_{deviation * deviation} {}

  [[nodiscard]] const Scalar& x_variance() const noexcept { return x_.variance(); }
  [[nodiscard]] const Scalar& v_variance() const noexcept { return v_.variance(); }
  [[nodiscard]] const Scalar& force_variance() const noexcept { return force_.variance(); }

  /// @param y          measured less predicted
  /// @param predicted  covariance of the prediction itself
  void observe(const Vector& y, const Matrix& predicted, const Gains& gains) noexcept {
    const Matrix Q = process(gains);
    x_.observe(y[0], predicted(0, 0) + Q(0, 0));
    v_.observe(y[1], predicted(1, 1) + Q(1, 1));
    force_.observe(y[2], predicted(2, 2));
  }

  /// Of the force that no law has.
  [[nodiscard]] Matrix process(const Gains& gains) const noexcept {
    const Scalar more = Scalar(105) / Scalar(100);  // it is not constant: what x and v have of it is not one number
    Matrix Q = Matrix::Zero();
    Q(0, 0) = process_ * more * gains.x * gains.x;
    Q(1, 1) = process_ * more * gains.v * gains.v;
    Q(0, 1) = Q(1, 0) = process_ * gains.x * gains.v;
    return Q;
  }

  /// That and the measurements' noise.
  [[nodiscard]] Matrix weights(const Gains& gains) const noexcept {
    Matrix W = process(gains);
    W(0, 0) += x_.variance();
    W(1, 1) += v_.variance();
    W(2, 2) += force_.variance();
    return W;
  }

 private:
  Scalar process_;
  NoiseLevels<6, Scalar> x_{{Scalar(1e-8), Scalar(1e-7), Scalar(5e-7), Scalar(1.5e-6), Scalar(3e-6), Scalar(1e-5)},
                            Scalar(98) / Scalar(100),
                            Scalar{1}};
  NoiseLevels<5, Scalar> v_{
      {Scalar(1e-6), Scalar(1e-5), Scalar(3e-5), Scalar(1e-4), Scalar(3e-4)}, Scalar(98) / Scalar(100), Scalar{1}};
  NoiseLevels<6, Scalar> force_{{Scalar(1e-4), Scalar(1e-3), Scalar(3e-3), Scalar(1e-2), Scalar(3e-2), Scalar(1e-1)},
                                Scalar(98) / Scalar(100)};
};

}  // namespace limpid
