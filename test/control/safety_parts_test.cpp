// SPDX-License-Identifier: MIT
#include <limpid/control/fault_reason.hpp>
#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_traits.hpp>
#include <limpid/control/tracking_law.hpp>

#include <doctest/doctest.h>

#include <set>
#include <stdexcept>
#include <string_view>

using namespace limpid;

TEST_CASE("every reason of a fault has words of its own") {
  std::set<std::string_view> words;
  for (int reason = 0; reason <= static_cast<int>(FaultReason::upstream); ++reason) {
    words.insert(describe(static_cast<FaultReason>(reason)));
  }
  CHECK(words.size() == 8);
  CHECK(words.count("unknown") == 0);
}

TEST_CASE("a margin leaves nothing up to itself, all beyond its band, and a share between") {
  const SafetyMargin<> margin{.margin = 0.25, .band = 0.5};
  CHECK(margin.share(0.25) == 0);
  CHECK(margin.share(0.5) == 0.5);
  CHECK(margin.share(0.75) == 1);
  CHECK(SafetyMargin<>{.margin = 0.25, .band = 0}.share(0.26) == 1);
}

TEST_CASE("the reference of the tracking law is that of (4.1) and (4.3)") {
  const TrackingLaw<Omni<>> law{.Lambda = {2, 3, 4}, .Kd = {1, 1, 1}};
  const auto r = law.reference({{0.1, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0.5, 0, 0}, {7, 0, 0}});
  CHECK(r.qdot[0] == doctest::Approx(0.5 - 2 * 0.1));
  CHECK(r.qddot[0] == doctest::Approx(7 - 2 * 0.5));
  CHECK(r.delta[0] == doctest::Approx(1 - 0.3));
  CHECK_THROWS_AS((TrackingLaw<Omni<>>{.Lambda = {2, 0, 4}, .Kd = {1, 1, 1}}.check("Law")), std::invalid_argument);
}
