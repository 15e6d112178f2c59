// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/status.hpp>
#include <limpid/prediction/lane_motion.hpp>

#include <limits>

namespace limpid::detail {

/// The coefficients of x'' + beta x' + kappa x = f + constant, about a point where the environment is not linear.
template <int Axes, Real Scalar>
struct LaneModel {
  using Array = Lanes<Axes, Scalar>;

  Array kappa, beta, constant;

  /// Whether the squares are finite: then so are the products and sums that follow from moderate values.
  [[nodiscard]] bool moderate() const noexcept { return are_finite(kappa * kappa, beta * beta, constant * constant); }

  [[nodiscard]] bool same_as(const LaneModel& other) const noexcept {
    return none((kappa - other.kappa).abs() + (beta - other.beta).abs() + (constant - other.constant).abs());
  }
  /// The same but for the constant: then a response to the one is one to the other.
  [[nodiscard]] bool responds_as(const LaneModel& other) const noexcept {
    return none((kappa - other.kappa).abs() + (beta - other.beta).abs());
  }

 private:
  static bool none(const Array& distance) noexcept {
    if constexpr (in_packets<Array>) {
      return all_at_most(distance, Scalar{0});
    } else {
      return distance.sum() == Scalar{0};
    }
  }
};

/// Steps of x'' + beta x' + kappa x = f + constant + w(t), where the coefficients are those at the step's start and w
/// is what the force, over mass, has beside them. f, m/s^2, is linear in time over the step.
///
/// `follow`: where axes do not feel each other w vanishes at the start with its slope, the tangent having both; so
/// w = g (t/h)^2 + O(h^3), and g = w(h) is found at the end of the step without w. What the end takes of it are its
/// moments,
///
///     integral of w dt = g h/3,     integral of w (h - t) dt = g h^2/12
///
/// and a forcing of -g/6 at the start and 5 g/6 at the end, linear between, has the same. Left out are the cubic term
/// of w, its second moment and the error of g: h^4 in a step's velocity and h^5 in its position, so that the method
/// is of order 3 where the force is smooth. Another correction does not change the order.
///
/// `substeps`: the above needs steps in which the tangent changes little. Measured is the larger, over the axes, of
///
///     8 (|change of kappa| h^2 + |change of beta| h),     kappa h^2
///
/// at most 1 in a step that is taken. Longer ones are halved, down to 1/32 of the tick; and one that is too long still
/// is taken by implicit Euler, v1 = v0 + h a(x0 + h v1, v1): of order 1, and without force it takes energy out, at
/// any length, where the force grows with position and velocity.
/// @tparam ModelAt  gives the LaneModel at a LaneMotion
/// @realtime        `follow`: one model; `substeps`: at most 96 attempts, and 32 solutions of at most
///                  24 models each
template <int Axes, Real Scalar, typename ModelAt>
class NonlinearStep {
 public:
  using Array = Lanes<Axes, Scalar>;
  using State = LaneMotion<Axes, Scalar>;
  using Model = LaneModel<Axes, Scalar>;
  using Response = SecondOrderStep<Axes, Scalar>;

  explicit NonlinearStep(const ModelAt& model_at) noexcept : model_at_{model_at} {}

  /// Takes `to` over a step of h seconds.
  /// @param here      the model at its start
  /// @param response  to that model, of h
  /// @param f0, f1    f at its start and its end
  /// @return  the measure above: where it is not at most 1 the step is too long
  Scalar follow(State& to, const Model& here, const Response& response, const Scalar& h, const Array& f0,
                const Array& f1) const noexcept {
    const Array start = f0 + here.constant, end = f1 + here.constant;
    State without = to;
    response.advance_lanes(without.x, without.v, start, end);
    const Model there = model_at_(without);
    const Array sixth = remainder(here, there, without) * (Scalar{1} / Scalar{6});
    response.advance_lanes(to.x, to.v, start - sixth, end + Scalar{5} * sixth);
    return measure(here, there, h);
  }

  /// The same in parts as short as need be.
  /// @return  coarse: some were not short enough
  [[gnu::noinline]] Status substeps(State& to, Model here, const Scalar& h, const Array& f0,
                                    const Array& f1) const noexcept {
    Status status = Status::ok;
    const Scalar part = h / Scalar(parts);
    const Array slope = (f1 - f0) * (Scalar{1} / Scalar(parts));
    for (int done = 0, size = parts / 2; done < parts;) {
      const Array start = f0 + slope * Scalar(done), end = f0 + slope * Scalar(done + size);
      const Scalar length = part * Scalar(size);
      State next = to;
      Response response;
      response.set_lanes(here.kappa, here.beta, length);
      const Scalar measured = follow(next, here, response, length, start, end);
      if (!(measured <= Scalar{1})) {
        if (size > 1) {
          size /= 2;
          continue;
        }
        next = implicit(to, length, end);
        status = Status::coarse;
      }
      to = next;
      done += size;
      here = model_at_(to);
      if (Scalar{4} * measured <= Scalar{1} && done % (2 * size) == 0) size *= 2;
    }
    return status;
  }

 private:
  static constexpr int parts = 32, iterations = 24;

  // w there.
  static Array remainder(const Model& here, const Model& there, const State& at) noexcept {
    return (there.constant - here.constant) - (there.kappa - here.kappa) * at.x - (there.beta - here.beta) * at.v;
  }

  static Scalar measure(const Model& here, const Model& there, const Scalar& h) noexcept {
    const Array change = (there.kappa - here.kappa).abs() * (h * h) + (there.beta - here.beta).abs() * h;
    const Array turn = there.kappa.max(here.kappa) * (h * h);
    return (change * Scalar{8}).max(turn).maxCoeff();
  }

  // Implicit Euler: the root of v1 - v0 - h a(x0 + h v1, v1) by Newton's method. Where the force grows with position
  // and velocity the slope is at least 1, which brackets the root; a step out of the bracket halves it.
  [[nodiscard]] State implicit(const State& from, const Scalar& h, const Array& f) const noexcept {
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    Array least = Array::Constant(-infinity), most = Array::Constant(infinity);
    State at = from;
    for (int i = 0; i < iterations; ++i) {
      at.x = from.x + h * at.v;
      const Model m = model_at_(at);
      const Array excess = at.v - from.v - h * (f + m.constant - m.kappa * at.x - m.beta * at.v);
      least = (excess > Scalar{0}).select(least.max(at.v - excess), at.v);
      most = (excess > Scalar{0}).select(at.v, most.min(at.v - excess));
      const Array newton = at.v - excess / (Scalar{1} + h * (m.beta + h * m.kappa));
      const Array next = (newton >= least && newton <= most).select(newton, (least + most) * (Scalar{1} / Scalar{2}));
      const bool settled = ((next - at.v).abs() <= at.v.abs() * std::numeric_limits<Scalar>::epsilon()).all();
      at.v = next;
      if (settled) break;
    }
    at.x = from.x + h * at.v;
    return at;
  }

  const ModelAt& model_at_;
};

}  // namespace limpid::detail
