// SPDX-License-Identifier: MIT
// Four and two in a register: tests of lanes, and lanes that are exchanged.
#include <limpid/core/any_lane.hpp>
#include <limpid/core/quad.hpp>

#include <doctest/doctest.h>

#include <limits>

using limpid::detail::all_at_most;
using limpid::detail::any_entry;
using limpid::detail::Quad;
using limpid::detail::shuffle;
using limpid::detail::spread;

namespace {

template <typename Scalar, int n>
void check_each_place() {
  using Entries = Eigen::Array<Scalar, n, 1>;
  const Entries zero = Entries::Zero();
  const auto above_one = [](auto& mask, const auto& v) { mask = v > Scalar{1}; };
  CHECK_FALSE(any_entry(above_one, zero));
  CHECK(all_at_most(zero, Scalar{0}));
  for (int i = 0; i < n; ++i) {
    CAPTURE(i);
    Entries one_large = zero, one_nan = zero;
    one_large[i] = 2;
    one_nan[i] = std::numeric_limits<Scalar>::quiet_NaN();
    CHECK(any_entry(above_one, one_large));
    CHECK_FALSE(any_entry(above_one, one_nan));
    CHECK_FALSE(all_at_most(one_large, Scalar{1}));
    CHECK_FALSE(all_at_most(one_nan, Scalar{1}));
  }
}

}  // namespace

TEST_CASE_TEMPLATE("a test of lanes sees every entry, and no NaN is at most anything", Scalar, float, double) {
  check_each_place<Scalar, 2>();
  check_each_place<Scalar, 4>();
  check_each_place<Scalar, 8>();
}

TEST_CASE_TEMPLATE("four lanes are loaded, computed with, exchanged and stored", Scalar, float, double) {
  using Four = Eigen::Array<Scalar, 4, 1, Eigen::DontAlign>;
  const auto equal = [](const Quad<Scalar>& quad, const Four& expected) { return (quad.array() == expected).all(); };
  const auto a = Quad<Scalar>::of(Four(1, 2, 3, 4)), b = Quad<Scalar>::of(Four(5, 6, 7, 8));
  CHECK(equal(a + b, Four(6, 8, 10, 12)));
  CHECK(equal(b - a, Four(4, 4, 4, 4)));
  CHECK(equal(a * b, Four(5, 12, 21, 32)));
  CHECK(equal(b / Quad<Scalar>::all(2), Four(Scalar(2.5), 3, Scalar(3.5), 4)));
  CHECK(equal(shuffle<0, 7, 2, 5>(a, b), Four(1, 8, 3, 6)));
  CHECK(equal(spread<2>(a), Four(3, 3, 3, 3)));
  Eigen::Matrix<Scalar, 3, 1> vector(1, 2, 3);
  CHECK(equal(Quad<Scalar>::of(vector), Four(1, 2, 3, 3)));
  b.store(9, vector);
  CHECK((vector.array() == Eigen::Array<Scalar, 3, 1>(5, 6, 9)).all());
}
