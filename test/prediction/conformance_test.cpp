// SPDX-License-Identifier: MIT
#include <conformance/predictor_suite.hpp>
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/model_predictor.hpp>

#include <doctest/doctest.h>

using limpid::HoldPredictor;
using limpid::HuntCrossley;
using limpid::KelvinVoigt;
using limpid::Known;
using limpid::ModelPredictor;
using limpid::Tool;

namespace {

/// A foreign type: neither base class nor members of limpid's.
struct Frozen {
  limpid::Motion<1> motion;
};

}  // namespace

template <>
struct limpid::PredictorTraits<Frozen> {
  using Scalar = double;
  static constexpr int axes = 1;
  static Status observe(Frozen&, const ToolSample<1>&) noexcept { return Status::ok; }
  static Prediction<1> advance(Frozen& p, Time, const Eigen::Array<double, 1, 1>&) noexcept { return {p.motion}; }
};

static_assert(limpid::Predictor<Frozen>);
static_assert(limpid::Predictor<HoldPredictor<3>>);
static_assert(limpid::Predictor<ModelPredictor<KelvinVoigt<3>>>);
static_assert(!limpid::Predictor<int>);
static_assert(!limpid::Predictor<KelvinVoigt<1>>);

// Known parameters: no `use`, so that nothing can ask for an estimator.
template <typename P>
concept Usable = requires(P p) {
  p.use({});
};
static_assert(Usable<ModelPredictor<KelvinVoigt<1>>>);
static_assert(!Usable<ModelPredictor<KelvinVoigt<1>, Tool<1>, Known>>);

TEST_CASE_TEMPLATE("the hold predictor obeys the laws", P, HoldPredictor<1>, HoldPredictor<3, float>) {
  limpid::test::check_predictor(P{});
}

TEST_CASE_TEMPLATE("the model predictor obeys the laws in a linear environment", Scalar, float, double) {
  using Env = KelvinVoigt<3, Scalar>;
  typename Env::Theta theta;
  theta.col(0).setConstant(800);
  theta.col(1).setConstant(30);
  limpid::test::check_predictor(ModelPredictor<Env>({.environment = {},
                                                     .tool = {.mass = Scalar(0.1), .damping = Scalar(0.1)},
                                                     .theta = theta,
                                                     .gain = {Scalar(-100), Scalar(-2)}}));
}

TEST_CASE("the model predictor obeys the laws in a nonlinear environment") {
  using Env = HuntCrossley<1>;
  limpid::test::check_predictor(ModelPredictor<Env, Tool<1>, Known>({.environment = Env({.exponent = 1.5}),
                                                                     .tool = {.mass = 0.1, .damping = 0.1},
                                                                     .theta = Env::Theta(3000, 10, 20),
                                                                     .gain = {-100.0, -2.0}}));
}
