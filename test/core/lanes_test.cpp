// SPDX-License-Identifier: MIT
#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/prediction/lane_motion.hpp>
#include <limpid/signal/history.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <limits>

using limpid::Time;
using limpid::test::Fifty;

TEST_CASE_TEMPLATE("three axes lie in four lanes, the last one twice, and come back", Scalar, float, double) {
  const Eigen::Array<Scalar, 3, 1> axes(1, 2, 3);
  const auto lanes = limpid::to_lanes<3>(axes);
  CHECK((lanes == Eigen::Array<Scalar, 4, 1>(1, 2, 3, 3)).all());
  CHECK((limpid::from_lanes<3>(lanes) == axes).all());
}

TEST_CASE_TEMPLATE("columns become lanes one by one", Scalar, float, double, long double, Fifty) {
  Eigen::Array<Scalar, 3, 2> rows;
  rows << Scalar(1), Scalar(2), Scalar(3), Scalar(4), Scalar(5), Scalar(6);
  const auto columns = limpid::to_lane_columns<3>(rows);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(columns[0][axis] == rows(axis, 0));
    CHECK(columns[1][axis] == rows(axis, 1));
  }
  for (Eigen::Index lane = 3; lane < columns[0].size(); ++lane) CHECK(columns[1][lane] == rows(2, 1));
}

TEST_CASE_TEMPLATE("parameters fill whole packets with zeros", Scalar, float, double) {
  Eigen::Matrix<Scalar, 9, 1> theta;
  theta << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const auto lanes = limpid::to_packed_lanes(theta);
  CHECK(lanes.size() == 12);
  CHECK((lanes.template head<9>() == theta.array()).all());
  CHECK((lanes.template tail<3>() == Scalar{0}).all());
}

TEST_CASE("a scalar of many digits is not padded") {
  const Eigen::Matrix<Fifty, 3, 1> theta(Fifty(1), Fifty(2), Fifty(3));
  CHECK(limpid::to_packed_lanes(theta).size() == 3);
  CHECK(limpid::to_packed_lanes(theta)[2] == Fifty(3));
}

TEST_CASE_TEMPLATE("arrays are finite together only if each entry is", Scalar, float, double, Fifty) {
  const Scalar none[] = {std::numeric_limits<Scalar>::infinity(), -std::numeric_limits<Scalar>::infinity(),
                         std::numeric_limits<Scalar>::quiet_NaN()};
  using Array = Eigen::Array<Scalar, 4, 1>;
  const Array fine = Array::Constant(std::numeric_limits<Scalar>::max());
  CHECK(limpid::are_finite(fine, fine, fine));
  for (const Scalar& bad : none) {
    for (int i = 0; i < 4; ++i) {
      Array spoilt = fine;
      spoilt[i] = bad;
      CHECK_FALSE(limpid::are_finite(spoilt));
      CHECK_FALSE(limpid::are_finite(fine, spoilt, fine));
      CHECK_FALSE(limpid::are_finite(fine, fine, spoilt));
    }
  }
}

TEST_CASE("a history of lanes interpolates position and velocity") {
  using State = limpid::detail::LaneMotion<3, double>;
  limpid::Motion<3> start, end;
  end.x << 1, 2, 3;
  end.v << -2, 4, 8;
  limpid::History<State, 4> history;
  CHECK(history.push(Time{0}, State(start)) == limpid::Status::ok);
  CHECK(history.push(Time{4}, State(end)) == limpid::Status::ok);
  const auto [middle, status] = history.at(Time{1});
  CHECK(status == limpid::Status::ok);
  const auto motion = middle.with(State::Array::Constant(7));
  CHECK((motion.x == end.x / 4).all());  // quarters are exact
  CHECK((motion.v == end.v / 4).all());
  CHECK((motion.a == 7).all());
  end.v[1] = std::numeric_limits<double>::infinity();
  CHECK(history.push(Time{8}, State(end)) == limpid::Status::not_finite);
}
