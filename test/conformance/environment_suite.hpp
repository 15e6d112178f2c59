// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/environment/environment.hpp>
#include <support/no_allocation.hpp>

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <limits>
#include <random>

namespace limpid::test {

/// Where an environment is put to the test.
template <Environment E>
struct EnvironmentRange {
  using Scalar = typename EnvironmentTraits<E>::Scalar;

  Scalar deepest;             ///< |x| up to this, m
  Scalar fastest;             ///< |v| up to this, m/s
  EnvironmentTheta<E> lower;  ///< parameters from
  EnvironmentTheta<E> upper;  ///< to
};

/// A random contact within a range; the seed is shown with a failure.
template <Environment E>
class RandomContact {
 public:
  using Scalar = typename EnvironmentTraits<E>::Scalar;

  RandomContact(const EnvironmentRange<E>& range, unsigned seed) : range_{range}, random_{seed} {}

  void draw() {
    for (int axis = 0; axis < EnvironmentTraits<E>::axes; ++axis) {
      x[axis] = range_.deepest * uniform(-1, 1);
      v[axis] = range_.fastest * uniform(-1, 1);
      for (int i = 0; i < EnvironmentTraits<E>::parameters; ++i) {
        theta(axis, i) = range_.lower(axis, i) + (range_.upper(axis, i) - range_.lower(axis, i)) * uniform(0, 1);
      }
    }
  }

  EnvironmentVector<E> x, v;
  EnvironmentTheta<E> theta;

 private:
  Scalar uniform(double low, double high) { return Scalar(std::uniform_real_distribution<double>(low, high)(random_)); }

  EnvironmentRange<E> range_;
  std::mt19937 random_;
};

/// force(theta) = phi' theta + force(0), with a phi that knows nothing of theta: linear in theta. A unilateral one has
/// that force or none.
template <Environment E>
void check_force_is_linear_in_theta(const E& e, const EnvironmentRange<E>& range) {
  using Traits = EnvironmentTraits<E>;
  using Scalar = typename Traits::Scalar;
  using Theta = EnvironmentTheta<E>;
  // each side sums the same N + 1 terms, in its own order, from terms of a few roundings each
  const Scalar roundings = Scalar(4 * (Traits::parameters + 2)) * std::numeric_limits<Scalar>::epsilon();
  RandomContact<E> at(range, 20170601);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    at.draw();
    const Theta terms = Traits::regressor(e, at.x, at.v) * at.theta;
    const EnvironmentVector<E> known = Traits::force(e, Theta::Zero(), at.x, at.v);
    const EnvironmentVector<E> force = Traits::force(e, at.theta, at.x, at.v);
    const EnvironmentVector<E> size = terms.abs().rowwise().sum() + known.abs();
    for (int axis = 0; axis < Traits::axes; ++axis) {
      using std::abs;
      const Scalar miss = abs(Scalar(force[axis] - terms.row(axis).sum() - known[axis]));
      const bool released = !Traits::bilateral && force[axis] == Scalar{0};
      REQUIRE((miss <= roundings * size[axis] || released));
    }
  }
}

/// The tangent is the derivative of the force. Central differences with a step of cbrt(epsilon) of the range: their
/// error is some epsilon^(2/3) of the third derivative, which 50 digits make negligible against sqrt(epsilon) = 3e-25.
template <Environment E>
void check_tangent_is_the_derivative(const E& e, const EnvironmentRange<E>& range) {
  using Traits = EnvironmentTraits<E>;
  using Scalar = typename Traits::Scalar;
  using Vector = EnvironmentVector<E>;
  using std::sqrt, std::cbrt;
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  RandomContact<E> at(range, 19690720);
  for (int i = 0; i < 50; ++i) {
    CAPTURE(i);
    at.draw();
    const Tangents<Traits::axes, Scalar> tangent = Traits::tangent(e, at.theta, at.x, at.v);
    for (int axis = 0; axis < Traits::axes; ++axis) {
      const auto difference = [&](const Scalar& step, bool of_position) {
        Vector ahead = of_position ? at.x : at.v, behind = ahead;
        ahead[axis] += step;
        behind[axis] -= step;
        const Vector rise =
            of_position ? Vector(Traits::force(e, at.theta, ahead, at.v) - Traits::force(e, at.theta, behind, at.v))
                        : Vector(Traits::force(e, at.theta, at.x, ahead) - Traits::force(e, at.theta, at.x, behind));
        return Scalar(rise[axis] / (ahead[axis] - behind[axis]));
      };
      using std::abs;
      const Scalar force = abs(Traits::force(e, at.theta, at.x, at.v)[axis]);
      const Scalar stiffness = difference(cbrt(epsilon) * range.deepest, true);
      const Scalar damping = difference(cbrt(epsilon) * range.fastest, false);
      const Scalar stiff_size = abs(stiffness) + force / range.deepest;
      const Scalar damp_size = abs(damping) + force / range.fastest;
      REQUIRE(abs(Scalar(stiffness - tangent.stiffness[axis])) <= sqrt(epsilon) * stiff_size);
      REQUIRE(abs(Scalar(damping - tangent.damping[axis])) <= sqrt(epsilon) * damp_size);
    }
  }
}

/// The response is force and tangent at the point. Found by the same sums, of which a compiler may contract others:
/// within two roundings of each term, and the force's terms are as large as a stiff damper's and spring's.
template <Environment E>
void check_response_is_force_and_tangent(const E& e, const EnvironmentRange<E>& range) {
  using Traits = EnvironmentTraits<E>;
  using Scalar = typename Traits::Scalar;
  using Vector = EnvironmentVector<E>;
  const Scalar roundings = Scalar(2 * (Traits::parameters + 2)) * std::numeric_limits<Scalar>::epsilon();
  RandomContact<E> at(range, 18820101);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    at.draw();
    const Vector force = Traits::force(e, at.theta, at.x, at.v);
    const auto tangent = Traits::tangent(e, at.theta, at.x, at.v);
    const auto both = response_of(e, at.theta, at.x, at.v);
    const Vector size = (Traits::regressor(e, at.x, at.v) * at.theta).abs().rowwise().sum() +
                        Traits::force(e, EnvironmentTheta<E>::Zero(), at.x, at.v).abs();
    REQUIRE(((both.force - force).abs() <= roundings * size).all());
    // the stiffness of a force that is a product with v: that of its terms, over the depth
    const Vector stiff = tangent.stiffness.abs() + size / at.x.abs();
    REQUIRE(((both.tangent.stiffness - tangent.stiffness).abs() <= roundings * stiff).all());
    REQUIRE(((both.tangent.damping - tangent.damping).abs() <= roundings * tangent.damping.abs()).all());
  }
}

/// `linear`: the tangent is the same everywhere. `decoupled`: moving an axis leaves the others' forces as they are.
template <Environment E>
void check_flags_are_true(const E& e, const EnvironmentRange<E>& range) {
  using Traits = EnvironmentTraits<E>;
  using Vector = EnvironmentVector<E>;
  RandomContact<E> at(range, 17950101);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    at.draw();
    const auto here = Traits::tangent(e, at.theta, at.x, at.v);
    const auto there = Traits::tangent(e, at.theta, Vector::Zero(), Vector::Zero());
    REQUIRE((!Traits::linear || ((here.stiffness == there.stiffness).all() && (here.damping == there.damping).all())));
    const Vector force = Traits::force(e, at.theta, at.x, at.v);
    for (int moved = 0; moved < Traits::axes; ++moved) {
      Vector x = at.x, v = at.v;
      x[moved] = -x[moved] / 2;
      v[moved] = -v[moved] / 2;
      const Vector after = Traits::force(e, at.theta, x, v);
      for (int axis = 0; axis < Traits::axes; ++axis) {
        REQUIRE((!Traits::decoupled || axis == moved || after[axis] == force[axis]));
      }
    }
  }
}

/// Finite at rest, at a touch and a million times the range away.
template <Environment E>
void check_finite_everywhere(const E& e, const EnvironmentRange<E>& range) {
  using Traits = EnvironmentTraits<E>;
  using Scalar = typename Traits::Scalar;
  using Vector = EnvironmentVector<E>;
  const Scalar tiny = std::numeric_limits<Scalar>::min();
  const Scalar factors[] = {Scalar{0}, tiny, -tiny, Scalar{1}, Scalar{-1}, Scalar(1'000'000), Scalar(-1'000'000)};
  for (const Scalar& deep : factors) {
    for (const Scalar& fast : factors) {
      CAPTURE(deep);
      CAPTURE(fast);
      const Vector x = Vector::Constant(Scalar(range.deepest * deep)),
                   v = Vector::Constant(Scalar(range.fastest * fast));
      const auto tangent = Traits::tangent(e, range.upper, x, v);
      const auto both = response_of(e, range.upper, x, v);
      REQUIRE((is_finite(both.force) && is_finite(both.tangent.stiffness) && is_finite(both.tangent.damping)));
      REQUIRE(is_finite(Traits::regressor(e, x, v)));
      REQUIRE(is_finite(Traits::force(e, range.upper, x, v)));
      REQUIRE(is_finite(tangent.stiffness));
      REQUIRE(is_finite(tangent.damping));
    }
  }
}

template <Environment E>
void check_allocates_nothing(const E& e, const EnvironmentRange<E>& range) {
  using Traits = EnvironmentTraits<E>;
  const EnvironmentVector<E> x = EnvironmentVector<E>::Constant(range.deepest);
  EnvironmentVector<E> sum = EnvironmentVector<E>::Zero();
  check_no_allocation([&] {
    sum += Traits::regressor(e, x, x).col(0) + Traits::force(e, range.upper, x, x);
    sum += Traits::tangent(e, range.upper, x, x).stiffness + response_of(e, range.upper, x, x).force;
  });
  CHECK(is_finite(sum));
}

/// All laws of the Environment concept but the tangent's, which asks for 50 digits, for any type in its own scalar.
template <Environment E>
void check_environment(const E& e, const EnvironmentRange<E>& range) {
  check_force_is_linear_in_theta(e, range);
  check_response_is_force_and_tangent(e, range);
  check_flags_are_true(e, range);
  check_finite_everywhere(e, range);
  check_allocates_nothing(e, range);
}

}  // namespace limpid::test
