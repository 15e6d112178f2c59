// SPDX-License-Identifier: MIT
#include "prediction/contenders.hpp"

#include <algorithm>
#include <iterator>

namespace limpid::bench {

namespace {

Trace ideal(const Course& course) {
  Trace trace;
  trace.reserve(course.truth.ticks.size());
  for (const TrueTick& tick : course.truth.ticks) trace.push_back({tick.tool.x, tick.tool.v, tick.acceleration()});
  return trace;
}

std::vector<Contender> listed() {
  std::vector<Contender> all;
  for (auto some : {signal_contenders(), model_contenders(), curve_contenders()})
    std::ranges::move(some, std::back_inserter(all));
  all.push_back({"ideal", ideal});
  return all;
}

}  // namespace

const std::vector<Contender>& contenders() {
  static const std::vector<Contender> all = listed();
  return all;
}

}  // namespace limpid::bench
