// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace limpid::detail {

/// A convex polygon from which half planes are cut.
template <Real Scalar>
class ConvexPolygon {
 public:
  using Point = Eigen::Matrix<Scalar, 2, 1>;

  /// The rectangle from `lower` to `upper`.
  ConvexPolygon(const Point& lower, const Point& upper)
      : corners_{lower, Point(upper[0], lower[1]), upper, Point(lower[0], upper[1])} {}

  [[nodiscard]] Scalar area() const {
    Scalar twice{0};
    for (std::size_t i = 2; i < corners_.size(); ++i) twice += twice_area(i);
    return twice / Scalar{2};
  }

  /// Where it has no area left, a corner.
  [[nodiscard]] Point centre_of_gravity() const {
    Point moment = Point::Zero();
    Scalar twice{0};
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      const Scalar part = twice_area(i);
      moment += part / Scalar{3} * (corners_[i - 1] + corners_[i] - Scalar{2} * corners_[0]);
      twice += part;
    }
    return twice > Scalar{0} ? Point(corners_[0] + moment / twice) : corners_[0];
  }

  /// Keeps the part in which inward . (point - through) >= 0; all of it where nothing would be left.
  void keep(const Point& through, const Point& inward) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Point &from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
      const Scalar at_from = inward.dot(from - through), at_to = inward.dot(to - through);
      if (at_from >= Scalar{0}) kept.push_back(from);
      if ((at_from > Scalar{0} && at_to < Scalar{0}) || (at_from < Scalar{0} && at_to > Scalar{0})) {
        kept.push_back(from + (to - from) * (at_from / (at_from - at_to)));
      }
    }
    if (kept.size() > 2) corners_ = kept;
  }

 private:
  [[nodiscard]] Scalar twice_area(std::size_t i) const {
    const Point a = corners_[i - 1] - corners_[0], b = corners_[i] - corners_[0];
    return a[0] * b[1] - a[1] * b[0];
  }

  std::vector<Point> corners_;  // counterclockwise
};

}  // namespace limpid::detail
