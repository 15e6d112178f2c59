// SPDX-License-Identifier: MIT
#include "tick/differences.hpp"
#include "tick/form.hpp"

#include <support/maximum.hpp>

#include <cmath>

namespace limpid::bench {

namespace {

using test::largest_entry;
using test::maximum;

constexpr int ticks = 10'000;

// Of double: what is asked of the torque. An entry of Gamma forgets in 1 / (alpha dt) = 500 ticks, each of a rounding
// or two; in the first dozen, after which the samples outweigh Gamma(0), x and v turn by 0.2 rad, so that what they
// tell of k and b is conditioned by less than 100.
constexpr double most_torque = 1e-12, most_law = 500 * 2 * 0x1p-53 * 1e2;
// Of float: the arm's parameters, by which a torque goes, are sums of 10 000 steps, each of them rounded. Gamma as
// above.
constexpr double most_torque_float = ticks * 0x1p-24, most_law_float = 500 * 2 * 0x1p-24 * 1e2;

void see(const FormState& is, const FormState& reference, FormDifference& difference, double& largest) {
  const auto s = TickParts<double>::settings();
  const Eigen::Vector2d width = s.upper - s.lower;
  difference.torque = maximum(difference.torque, largest_entry(is.torque - reference.torque));
  largest = maximum(largest, largest_entry(reference.torque));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Eigen::Vector2d size = reference.Gamma[axis].diagonal().cwiseSqrt();
    const Eigen::Matrix2d sizes = size * size.transpose();
    difference.theta =
        maximum(difference.theta, largest_entry((is.theta[axis] - reference.theta[axis]).cwiseQuotient(width)));
    difference.Gamma =
        maximum(difference.Gamma, largest_entry((is.Gamma[axis] - reference.Gamma[axis]).cwiseQuotient(sizes)));
  }
}

FormDifference compare(Form form, Form reference) {
  const bool in_float = form.name() == "composed_float";
  FormDifference difference{.form = form.name(),
                            .most_torque = in_float ? most_torque_float : most_torque,
                            .most_law = in_float ? most_law_float : most_law};
  double largest = 0;
  for (int i = 0; i < ticks; ++i) see(form.look(), reference.look(), difference, largest);
  difference.torque /= largest;
  return difference;
}

}  // namespace

std::vector<FormDifference> differences_from_straightforward() {
  std::vector<FormDifference> differences;
  for (const Form& form : {dynamic_form(), simd_form(), composed_form(), hand_written_form(), composed_float_form()})
    differences.push_back(compare(form, straightforward_form()));
  for (const Form& form : {composed_safe_form(), hand_written_safe_form()})
    differences.push_back(compare(form, straightforward_safe_form()));
  return differences;
}

}  // namespace limpid::bench
