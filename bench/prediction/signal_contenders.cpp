// SPDX-License-Identifier: MIT
#include "prediction/contenders.hpp"
#include "prediction/drive.hpp"

#include <limpid/prediction/autoregressive_predictor.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/linear_predictor.hpp>
#include <limpid/prediction/quadratic_predictor.hpp>

namespace limpid::bench {

namespace {

Trace hold(const Course& course) {
  HoldPredictor<1> predictor;
  return drive(predictor, course);
}

Trace linear(const Course& course) {
  LinearPredictor<1> predictor;
  return drive(predictor, course);
}

Trace quadratic(const Course& course) {
  QuadraticPredictor<1> predictor({.tool = tool()});
  return drive(predictor, course);
}

Trace autoregressive(const Course& course) {
  AutoregressivePredictor<2> predictor({.period = time_of(course.period)});
  return drive(predictor, course);
}

}  // namespace

std::vector<Contender> signal_contenders() {
  return {{"hold", hold}, {"linear", linear}, {"quadratic", quadratic}, {"autoregressive", autoregressive}};
}

}  // namespace limpid::bench
