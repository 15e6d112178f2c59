// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_dual_certificate.hpp>
#include <limpid/design/lmi_problem.hpp>
#include <limpid/design/lmi_scaling.hpp>
#include <limpid/design/primal_dual_method.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace limpid::detail {

/// An Lmi as the semidefinite programs its solver runs on, in the numbers of LmiScaling.
template <Real Scalar>
class ScaledLmi {
 public:
  using Problem = LmiProblem<Scalar>;
  using Term = typename Problem::Term;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Sdp = DynamicSdp<Scalar>;
  using Point = SdpPoint<Sdp>;

  /// @param homogenise  gives the constant part an unknown x_0 > 0 of its own, and c'x = d the form c'x = d x_0
  ScaledLmi(const Problem& problem, bool homogenise)
      : problem_{problem}, homogenised_{homogenise}, scaling_(problem, homogenise) {
    number_unknowns();
    trace_ = Vector::Zero(unknowns());
    for (std::size_t j = 0; j < problem_.blocks.size(); ++j) {
      dimension_ += problem_.blocks[j].size;
      for (const Term& term : problem_.blocks[j].terms) {
        const int i = column(term.unknown);
        if (term.row == term.column && i >= 0) trace_[i] += scaling_.value(term, j);
      }
    }
    if (!homogenised_) return;
    trace_[unknowns() - 1] += Scalar{1};
    ++dimension_;
  }

  [[nodiscard]] bool homogenised() const { return homogenised_; }
  [[nodiscard]] bool has_trace() const {
    return trace_.size() > 0 && trace_.squaredNorm() > Scalar(dimension_) * std::numeric_limits<Scalar>::epsilon();
  }

  /// max t with S = F(x) - t I >= 0, tr F(x) = n, and the equation where homogenised.
  [[nodiscard]] Sdp feasibility() const {
    Sdp sdp;
    const int t = unknowns();
    for (std::size_t j = 0; j < problem_.blocks.size(); ++j) {
      sdp.groups.push_back(group(j, t));
    }
    if (homogenised_) sdp.groups.push_back(positive_unknown(t));
    sdp.b = Vector::Unit(t + 1, t);
    const bool with_equation = homogenised_ && problem_.has_equation;
    sdp.C = Matrix::Zero(with_equation ? 2 : 1, t + 1);
    sdp.d = Vector::Zero(sdp.C.rows());
    sdp.C.row(0).head(t) = trace_.transpose();
    sdp.d[0] = Scalar(dimension_);
    if (!with_equation) return sdp;
    for (const Term& term : problem_.equation) {
      sdp.C(1, column(term.unknown)) += term.factor.centre() * scaling_.unknown(term.unknown) * scaling_.equation();
    }
    return sdp;
  }

  /// max b'x with F_0 + F(x) >= 0 and the equation, not homogenised.
  [[nodiscard]] Sdp optimisation() const {
    Sdp sdp;
    for (std::size_t j = 0; j < problem_.blocks.size(); ++j) sdp.groups.push_back(group(j, -1));
    sdp.b = Vector::Zero(used_);
    for (const Term& term : problem_.objective) {
      if (column(term.unknown) >= 0)
        sdp.b[column(term.unknown)] += term.factor.centre() * scaling_.unknown(term.unknown);
    }
    sdp.b *= scaling_.objective();
    sdp.C = Matrix::Zero(problem_.has_equation ? 1 : 0, used_);
    sdp.d = Vector::Zero(sdp.C.rows());
    for (const Term& term : problem_.equation) {
      const Scalar value = term.factor.centre() * scaling_.unknown(term.unknown) * scaling_.equation();
      if (term.unknown == constant) {
        sdp.d[0] -= term.factor.centre() * scaling_.equation();
      } else {
        sdp.C(0, column(term.unknown)) += value;
      }
    }
    return sdp;
  }

  /// From a point inside the inequalities.
  [[nodiscard]] Point start(const Sdp& sdp, const Vector& x, bool inside) const {
    Point at{Vector::Zero(sdp.b.size()), sdp.make(), sdp.make(), Vector::Zero(sdp.d.size())};
    for (int i = 0; i < problem_.unknowns; ++i) {
      if (column(i) >= 0) at.x[column(i)] = x[i] / scaling_.unknown(i);
    }
    Scalar size{1};
    sdp.for_each_group(
        [&](const auto& group, auto& S) {
          group.apply(at.x, S, true);
          size = std::max<Scalar>(size, S[0].entries().norm());
        },
        at.S);
    if (!inside) {
      for (auto& S : at.S) set_scaled_identity(S[0], size);
    }
    for (auto& Z : at.Z) set_scaled_identity(Z[0], Scalar{1});
    return at;
  }

  /// The same for a problem whose last unknown is t of F(x) - t I: the smallest x on the equation's plane, t low
  /// enough.
  [[nodiscard]] Point margin_start(const Sdp& sdp) const {
    Vector x = Vector::Zero(problem_.unknowns);
    const int t = problem_.unknowns - 1;
    if (sdp.d.size() != 0) {
      const Scalar factor = sdp.d[0] / sdp.C.row(0).squaredNorm();
      for (int i = 0; i < t; ++i) {
        if (column(i) >= 0) x[i] = sdp.C(0, column(i)) * factor * scaling_.unknown(i);
      }
    }
    const Point centre = start(sdp, x, true);
    Scalar most{0};  // of what t I has to make up for
    for (std::size_t j = 0; j < scaling_.rows().size(); ++j) {
      const Scalar least = scaling_.rows()[j].minCoeff();
      most = std::max<Scalar>(most, centre.S[j][0].entries().norm() / (least * least));
    }
    x[t] = Scalar{-2} * most;
    return start(sdp, x, true);
  }

  /// Unknowns and multipliers of a point of the optimisation.
  [[nodiscard]] Vector values(const Point& at) const {
    Vector x = Vector::Zero(problem_.unknowns);
    for (int i = 0; i < problem_.unknowns; ++i) {
      if (column(i) >= 0) x[i] = at.x[column(i)] * scaling_.unknown(i);
    }
    return x;
  }
  [[nodiscard]] LmiMultipliers<Scalar> multipliers(const Point& at) const {
    LmiMultipliers<Scalar> dual;
    for (std::size_t j = 0; j < scaling_.rows().size(); ++j) {
      dual.Z.push_back(scaling_.unscale(j, at.Z[j][0].matrix()) / scaling_.objective());
    }
    if (at.y.size() > 0) dual.y = -at.y[0] * scaling_.equation() / scaling_.objective();
    return dual;
  }

  /// Inside both cones; on all planes where there is no equation.
  [[nodiscard]] Point feasibility_start(const Sdp& sdp) const {
    Point at{Vector::Zero(sdp.b.size()), sdp.make(), sdp.make(), Vector::Zero(sdp.d.size())};
    const int t = unknowns();
    at.x.head(t) = trace_ * (Scalar(dimension_) / trace_.squaredNorm());
    Scalar least{0};
    sdp.for_each_group([&](const auto& group, auto& S) { group.apply(at.x, S, true); }, at.S);
    for (const auto& S : at.S) least = std::min<Scalar>(least, -S[0].entries().norm());
    at.x[t] = least - Scalar{1};
    sdp.for_each_group([&](const auto& group, auto& S) { group.apply(at.x, S, true); }, at.S);
    for (auto& Z : at.Z) set_scaled_identity(Z[0], Scalar{1} / Scalar(dimension_));
    at.y[0] = Scalar{1} / Scalar(dimension_);
    return at;
  }

  [[nodiscard]] const Scalar& margin(const Point& at) const { return at.x[unknowns()]; }

  /// The point as a solution of the Lmi, and a margin it should have.
  [[nodiscard]] std::pair<Vector, Scalar> solution(const Point& at) const {
    Vector x = Vector::Zero(problem_.unknowns);
    const Scalar unit = homogenised_ ? Scalar(at.x[unknowns() - 1] * scaling_.unknown(constant)) : Scalar{1};
    for (int i = 0; i < problem_.unknowns; ++i) {
      if (column(i) >= 0) x[i] = at.x[column(i)] * scaling_.unknown(i) / unit;
    }
    Scalar largest{0};
    for (const Vector& D : scaling_.rows()) largest = std::max<Scalar>(largest, D.maxCoeff());
    return {std::move(x), margin(at) / (largest * largest * unit)};
  }

  /// Z - y I, which makes up for tr F(x) = n, with a trace of 1 in all.
  [[nodiscard]] LmiMultipliers<Scalar> proof(const Point& at) const {
    LmiMultipliers<Scalar> dual;
    for (std::size_t j = 0; j < problem_.blocks.size(); ++j) {
      Matrix Z = at.Z[j][0].matrix();
      Z.diagonal().array() -= at.y[0];
      dual.Z.push_back(scaling_.unscale(j, Z));
    }
    if (at.y.size() > 1) dual.y = -at.y[1] * scaling_.equation();
    normalise(dual);
    return dual;
  }

  [[nodiscard]] LmiMultipliers<Scalar> unit_multipliers() const {
    LmiMultipliers<Scalar> dual;
    for (const Vector& D : scaling_.rows()) dual.Z.push_back(D.array().square().matrix().asDiagonal());
    normalise(dual);
    return dual;
  }

 private:
  static constexpr int constant = LmiExpression<Scalar>::constant;

  [[nodiscard]] int unknowns() const { return used_ + (homogenised_ ? 1 : 0); }
  // Of an unknown in the semidefinite program; below 0 where it has none.
  [[nodiscard]] int column(int unknown) const {
    if (unknown == constant) return homogenised_ ? used_ : -1;
    return column_[static_cast<std::size_t>(unknown)];
  }
  static void normalise(LmiMultipliers<Scalar>& dual) {
    Scalar trace{0};
    for (const Matrix& Z : dual.Z) trace += Z.trace();
    for (Matrix& Z : dual.Z) Z /= trace;
    dual.y /= trace;
  }

  void number_unknowns() {
    column_.assign(static_cast<std::size_t>(problem_.unknowns), -1);
    const auto mark = [this](const std::vector<Term>& terms) {
      for (const Term& term : terms) {
        if (term.unknown != constant) column_[static_cast<std::size_t>(term.unknown)] = 0;
      }
    };
    for (const auto& block : problem_.blocks) mark(block.terms);
    if (problem_.has_equation) mark(problem_.equation);
    mark(problem_.objective);
    for (int& number : column_) {
      if (number == 0) number = used_++;
    }
  }

  // With - t I for an unknown t >= 0; else with its constant part as it is.
  [[nodiscard]] typename Sdp::Group group(std::size_t j, int t) const {
    const auto& block = problem_.blocks[j];
    typename Sdp::Group group(block.size);
    auto first_with_unknown = block.terms.begin();
    while (first_with_unknown != block.terms.end() && first_with_unknown->unknown == constant) ++first_with_unknown;
    add_terms(group, j, first_with_unknown, block.terms.end());
    if (homogenised_) add_terms(group, j, block.terms.begin(), first_with_unknown);
    if (t < 0) {
      for (auto term = block.terms.begin(); term != first_with_unknown; ++term) {
        group.add_constant(term->row, term->column, scaling_.value(*term, j));
      }
      return group;
    }
    group.begin_variable(t);
    for (int i = 0; i < block.size; ++i) group.add_entry(i, i, {Scalar{-1}});
    group.end_variable();
    return group;
  }
  template <typename Iterator>
  void add_terms(typename Sdp::Group& group, std::size_t j, Iterator from, Iterator to) const {
    while (from != to) {
      const int unknown = from->unknown;
      group.begin_variable(column(unknown));
      for (; from != to && from->unknown == unknown; ++from) {
        group.add_entry(from->row, from->column, {scaling_.value(*from, j)});
      }
      group.end_variable();
    }
  }
  // x_0 - t >= 0
  [[nodiscard]] typename Sdp::Group positive_unknown(int t) const {
    typename Sdp::Group group(1);
    group.begin_variable(used_);
    group.add_entry(0, 0, {Scalar{1}});
    group.end_variable();
    group.begin_variable(t);
    group.add_entry(0, 0, {Scalar{-1}});
    group.end_variable();
    return group;
  }

  const Problem& problem_;
  bool homogenised_;
  LmiScaling<Scalar> scaling_;
  int used_ = 0;             // unknowns that occur
  std::vector<int> column_;  // of each unknown
  Vector trace_;
  int dimension_ = 0;
};

}  // namespace limpid::detail
