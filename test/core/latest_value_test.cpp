// SPDX-License-Identifier: MIT
#include <limpid/core/latest_value.hpp>

#include "support/no_allocation.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <thread>

using limpid::LatestValue;

namespace {

// Large enough for a copy to be interrupted.
struct Wide {
  std::array<std::uint64_t, 64> words{};
};

Wide all(std::uint64_t number) {
  Wide wide;
  wide.words.fill(number);
  return wide;
}

bool is_whole(const Wide& wide) {
  for (const std::uint64_t word : wide.words) {
    if (word != wide.words[0]) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("before anything is written there is the initial value") {
  LatestValue<int> latest(7);
  CHECK(!latest.take());
  CHECK(latest.value() == 7);
}

TEST_CASE("the newest value is taken once") {
  LatestValue<int> latest;
  latest.write(1);
  latest.write(2);
  CHECK(latest.take());
  CHECK(latest.value() == 2);
  CHECK(!latest.take());
  CHECK(latest.value() == 2);
  latest.write(3);
  CHECK(latest.value() == 2);  // until it is taken
  CHECK(latest.take());
  CHECK(latest.value() == 3);
}

TEST_CASE("no value that two threads exchange is torn, older than one before, or the last one lost") {
  constexpr std::uint64_t last = 200'000;
  LatestValue<Wide> latest;
  std::thread writer([&] {
    for (std::uint64_t k = 1; k <= last; ++k) latest.write(all(k));
  });
  std::uint64_t seen = 0, torn = 0, backwards = 0;
  while (seen < last) {
    if (!latest.take()) continue;
    torn += is_whole(latest.value()) ? 0U : 1U;
    backwards += latest.value().words[0] <= seen ? 1U : 0U;
    seen = latest.value().words[0];
  }
  writer.join();
  CHECK(torn == 0);
  CHECK(backwards == 0);
}

TEST_CASE("no call allocates") {
  LatestValue<Wide> latest;
  limpid::test::check_no_allocation([&] {
    latest.write(all(1));
    (void)latest.take();
  });
}
