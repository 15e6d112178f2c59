// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/status.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/prediction/lane_motion.hpp>
#include <limpid/prediction/nonlinear_step.hpp>

#include <array>
#include <cstddef>

namespace limpid::detail {

/// The virtual tool (3.29) in a model of its environment, axes in lanes: coefficients and steps of
///
///     x'' + beta x' + kappa x = F_h / m + constant,
///
/// exact where the environment is linear and decoupled, else about a point.
template <Environment Env>
class ToolInModel {
  using Traits = EnvironmentTraits<Env>;

 public:
  using Scalar = typename Traits::Scalar;
  static constexpr int axes = Traits::axes;
  static constexpr int parameters = Traits::parameters;
  static constexpr bool exact = LinearEnvironment<Env> && DecoupledEnvironment<Env>;
  using Vector = EnvironmentVector<Env>;
  using Theta = EnvironmentTheta<Env>;
  using Array = Lanes<axes, Scalar>;
  using State = LaneMotion<axes, Scalar>;

  using Model = LaneModel<axes, Scalar>;

  /// Where a tool goes: its state, the parameters it moves by, and the response that the last step was taken with.
  struct Course {
    State at{};
    Theta theta;  // not read where exact
    Model model;  // of theta, about `at`
    SecondOrderStep<axes, Scalar> response{};
    Scalar h{0};  // s, for which response is set; 0: for none

    void use(const Model& next) noexcept {
      if (!next.responds_as(model)) h = Scalar{0};
      model = next;
    }
  };

  template <typename ToolModel>
  ToolInModel(const Env& environment, const ToolModel& tool_model)
      : environment_{environment},
        per_mass_{Scalar{1} / tool_model.mass},
        own_{Array::Constant(tool_model.stiffness * per_mass_), Array::Constant(tool_model.damping * per_mass_),
             to_lanes<axes>(Vector(tool_model.anchor * (tool_model.stiffness * per_mass_)))} {
    if constexpr (exact) probe_parameters();
  }

  [[nodiscard]] const Scalar& per_mass() const noexcept { return per_mass_; }  ///< 1/kg

  /// The coefficients; where not exact, about `at`.
  [[nodiscard, gnu::always_inline]] Model model_of(const Theta& theta, const State& at) const noexcept {
    if constexpr (exact) {
      const auto columns = to_lane_columns<axes>(theta);
      Model model = at_zero_;
      for (std::size_t j = 0; j < columns.size(); ++j) {
        model.kappa += per_parameter_[j].kappa * columns[j];
        model.beta += per_parameter_[j].beta * columns[j];
        model.constant += per_parameter_[j].constant * columns[j];
      }
      return model;
    } else {
      const Model of_environment =
          environment_about(theta, limpid::from_lanes<axes>(at.x), limpid::from_lanes<axes>(at.v));
      return {own_.kappa + of_environment.kappa, own_.beta + of_environment.beta,
              own_.constant + of_environment.constant};
    }
  }

  /// Where not exact: the coefficients about a state, for the next step. Where they are those before, as in free space,
  /// so is the response.
  void look_around(Course& course, const State& at) const noexcept {
    if constexpr (!exact) course.use(model_of(course.theta, at));
  }

  /// The environment's, for schedules.
  [[nodiscard]] Tangents<axes, Scalar> tangent(const Theta& theta, const State& at) const noexcept {
    return Traits::tangent(environment_, theta, limpid::from_lanes<axes>(at.x), limpid::from_lanes<axes>(at.v));
  }

  /// Takes a state on a course over dt seconds; its end's tangent is to be looked at after that.
  /// @param to      at the start where the course is, and at the end where it comes to
  /// @param f0, f1  (F_h + other forces) / m at the start and at the end, linear between, m/s^2
  /// @return  coarse: parts of the step were too long for a nonlinear environment, see NonlinearStep
  [[gnu::always_inline]] Status step(Course& course, State& to, const Scalar& dt, const Array& f0,
                                     const Array& f1) const noexcept {
    if (dt != course.h) {
      course.response.set_lanes(course.model.kappa, course.model.beta, dt);
      course.h = dt;
    }
    if constexpr (exact) {
      course.response.advance_lanes(to.x, to.v, f0 + course.model.constant, f1 + course.model.constant);
    } else if constexpr (DecoupledEnvironment<Env>) {
      const auto model_at = [&](const State& at) noexcept { return model_of(course.theta, at); };
      const NonlinearStep<axes, Scalar, decltype(model_at)> nonlinear(model_at);
      if (!(nonlinear.follow(to, course.model, course.response, dt, f0, f1) <= Scalar{1})) [[unlikely]] {
        to = course.at;
        return nonlinear.substeps(to, course.model, dt, f0, f1);
      }
    } else {
      correct(course, to, f0, f1);
    }
    return Status::ok;
  }

  /// @param f  (F_h + other forces) / m there, m/s^2
  [[nodiscard]] static Array acceleration(const Model& model, const State& at, const Array& f) noexcept {
    return f + model.constant - model.beta * at.v - model.kappa * at.x;
  }

 private:
  // Of the environment alone.
  [[nodiscard]] Model environment_about(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    const auto [force, tangent] = response_of(environment_, theta, x, v);
    const Vector rest = force - tangent.stiffness * x - tangent.damping * v;
    return {to_lanes<axes>(tangent.stiffness) * per_mass_, to_lanes<axes>(tangent.damping) * per_mass_,
            to_lanes<axes>(rest) * -per_mass_};
  }

  // Of an environment that is linear the model is affine in theta, and known by its values at zero and the unit thetas.
  void probe_parameters() noexcept {
    const Vector none = Vector::Zero();
    const Model zero = environment_about(Theta::Zero(), none, none);
    at_zero_ = {own_.kappa + zero.kappa, own_.beta + zero.beta, own_.constant + zero.constant};
    for (int j = 0; j < parameters; ++j) {
      Theta unit = Theta::Zero();
      unit.col(j).setOnes();
      const Model one = environment_about(unit, none, none);
      per_parameter_[static_cast<std::size_t>(j)] = {one.kappa - zero.kappa, one.beta - zero.beta,
                                                     one.constant - zero.constant};
    }
  }

  // Of axes that feel each other the force beside the tangent goes as t, and is taken as linear.
  void correct(const Course& course, State& to, const Array& f0, const Array& f1) const noexcept {
    const State from = to;
    const Model& model = course.model;
    course.response.advance_lanes(to.x, to.v, f0 + model.constant, f1 + model.constant);
    for (int correction = 0; correction < 2; ++correction) {
      const Array F_e = to_lanes<axes>(Vector(
          Traits::force(environment_, course.theta, limpid::from_lanes<axes>(to.x), limpid::from_lanes<axes>(to.v))));
      const Array rest =
          own_.constant - F_e * per_mass_ + (model.kappa - own_.kappa) * to.x + (model.beta - own_.beta) * to.v;
      to = from;
      course.response.advance_lanes(to.x, to.v, f0 + model.constant, f1 + rest);
    }
  }

  Env environment_;
  Scalar per_mass_;  // 1/kg
  Model own_;        // the tool alone
  // where exact: the model of theta = 0, and what each parameter adds
  Model at_zero_;
  std::array<Model, exact ? std::size_t{parameters} : 0> per_parameter_;
};

}  // namespace limpid::detail
