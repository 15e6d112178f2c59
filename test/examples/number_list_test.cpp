// SPDX-License-Identifier: MIT
#include "common/number_list.hpp"

#include <doctest/doctest.h>

#include <vector>

using limpid::examples::number_of;
using limpid::examples::numbers_of;

TEST_CASE("a number may be a fraction") {
  CHECK(number_of("0.016") == 0.016);
  CHECK(number_of("-7.26") == -7.26);
  CHECK(number_of("1.8e5") == 1.8e5);
  CHECK(number_of("1/60") == 1.0 / 60);
  CHECK(number_of("-1/4") == -0.25);
}

TEST_CASE("what is not a finite number is none") {
  for (const char* typed : {"", "x", "1x", "nan", "inf", "0x10", "1e999", "1/0", "0/0", "1/", "/2", "1/2/3", " 1"}) {
    CAPTURE(typed);
    CHECK_FALSE(number_of(typed));
  }
}

TEST_CASE("lists are told apart by their separators") {
  CHECK(numbers_of("200:2000,20:40", ":,:") == std::vector<double>{200, 2000, 20, 40});
  CHECK(numbers_of("-441.3,-12.12", ",") == std::vector<double>{-441.3, -12.12});
  CHECK(numbers_of("5", "") == std::vector<double>{5});
  for (const char* typed : {"200:2000", "200,2000,20,40", "200:2000,20:40:60", "200:2000,20:", ":2000,20:40", ""}) {
    CAPTURE(typed);
    CHECK_FALSE(numbers_of(typed, ":,:"));
  }
}
