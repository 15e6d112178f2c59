// SPDX-License-Identifier: MIT
#include <limpid/core/recent_values.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <thread>

using limpid::RecentValues;

namespace {

// Large enough to be seen while it is written.
using Several = std::array<std::uint64_t, 16>;

Several filled(std::uint64_t number) {
  Several several{};
  several.fill(number);
  return several;
}

}  // namespace

TEST_CASE("values are read in the order they were written in") {
  RecentValues<int, 4> recent;
  CHECK(recent.written() == 0);
  int value = 0;
  for (int k = 0; k < 3; ++k) recent.write(10 + k);
  CHECK(recent.written() == 3);
  for (std::uint64_t k = 0; k < 3; ++k) {
    CHECK(recent.read(k, value));
    CHECK(value == 10 + static_cast<int>(k));
  }
}

TEST_CASE("as many as there is room for are there, and older ones are lost") {
  RecentValues<int, 4> recent;
  for (int k = 0; k < 10; ++k) recent.write(k);
  int value = 0;
  CHECK(recent.oldest() == 6);
  for (std::uint64_t k = 6; k < 10; ++k) {
    CHECK(recent.read(k, value));
    CHECK(value == static_cast<int>(k));
  }
  CHECK(!recent.read(5, value));
  CHECK(!recent.read(0, value));
}

TEST_CASE("a value that does not fill its words comes through") {
  struct Odd {
    char a[11];
  };
  RecentValues<Odd, 2> recent;
  recent.write(Odd{"0123456789"});
  Odd odd{};
  CHECK(recent.read(0, odd));
  CHECK(odd.a[9] == '9');
}

TEST_CASE("no value that a thread reads while another writes is torn or another one's") {
  constexpr std::uint64_t last = 200'000;
  RecentValues<Several, 8> recent;
  std::thread writer([&] {
    for (std::uint64_t k = 0; k < last; ++k) recent.write(filled(k));
  });
  std::uint64_t next = 0, wrong = 0, read = 0;
  Several value{};
  while (next < last) {
    if (next == recent.written()) continue;
    if (recent.read(next, value)) {
      wrong += value == filled(next) ? 0U : 1U;
      ++read;
      ++next;
    } else {
      next = recent.oldest();
    }
  }
  writer.join();
  CHECK(wrong == 0);
  CHECK(read > 0);
}

TEST_CASE("no call asks for memory") {
  RecentValues<Several, 8> recent;
  Several value{};
  limpid::test::check_no_allocation([&] {
    recent.write(filled(1));
    (void)recent.read(0, value);
  });
}
