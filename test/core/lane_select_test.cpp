// SPDX-License-Identifier: MIT
#include <limpid/core/lane_select.hpp>

#include <doctest/doctest.h>

#include <limits>

using namespace limpid;

TEST_CASE_TEMPLATE("what is chosen is chosen entry by entry, and of NaN the other", Scalar, float, double,
                   long double) {
  using Three = Eigen::Array<Scalar, 3, 1>;
  using One = Eigen::Array<Scalar, 1, 1>;
  const Three of(Scalar(2), Scalar(0), std::numeric_limits<Scalar>::quiet_NaN()), yes(1, 2, 3), no(4, 5, 6);
  CHECK((where_positive(of, yes, no) == Three(1, 5, 6)).all());
  CHECK(where_positive(One(1), One(2), One(3))[0] == 2);
}
