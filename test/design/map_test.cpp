// SPDX-License-Identifier: MIT
#include <limpid/design/map.hpp>

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using limpid::Grid;
using limpid::map;
using limpid::MapSettings;
using limpid::Tissue;

namespace {

const Grid<double> thesis{{200, 100, 2000}, {20, 1, 40}};

double product(const Tissue<double>& tissue) { return tissue.stiffness * tissue.damping; }

}  // namespace

TEST_CASE("every cell is put to the test, in the grid's order, whatever the number of threads") {
  for (const int threads : {0, 1, 2, 3, 7, 64}) {
    CAPTURE(threads);
    const auto result = map(thesis, product, {.threads = threads});
    REQUIRE(result.cells.size() == 399);
    for (std::size_t i = 0; i < 399; ++i) REQUIRE(result.cells[i] == product(thesis[i]));
    CHECK(result.at(18, 0) == 2000 * 20.0);
  }
}

TEST_CASE("truth values are filled in parallel too, and counted") {
  const auto result = map(thesis, [](const Tissue<double>& tissue) { return tissue.stiffness > 1000; }, {.threads = 4});
  CHECK(result.count([](bool above) { return above; }) == 10 * 21);  // 1100 to 2000
}

TEST_CASE("a cell is shown what was said of the one before it in its row, and a row's first nothing") {
  for (const int threads : {1, 5}) {
    CAPTURE(threads);
    const auto place =
        map<int>(thesis, [](const Tissue<double>&, const int* before) { return before == nullptr ? 0 : *before + 1; },
                 {.threads = threads});
    for (std::size_t i = 0; i < 399; ++i) REQUIRE(place.cells[i] == static_cast<int>(i % 21));
  }
}

TEST_CASE("progress rises to one and is told from one thread at a time") {
  std::vector<double> told;
  std::atomic<int> inside{0};
  const MapSettings settings{.threads = 4, .progress = [&](double fraction) {
                               CHECK(++inside == 1);
                               told.push_back(fraction);
                               --inside;
                             }};
  (void)map(thesis, product, settings);
  REQUIRE(told.size() == 19);
  for (std::size_t i = 0; i < 19; ++i) CHECK(told[i] == doctest::Approx(double(i + 1) / 19));
}

TEST_CASE("the exception of the first cell that throws is passed on, whatever the number of threads") {
  const auto test = [](const Tissue<double>& tissue) {
    if (tissue.stiffness >= 500 && tissue.damping >= 25) {
      throw std::runtime_error(std::to_string(tissue.stiffness) + " " + std::to_string(tissue.damping));
    }
    return 0;
  };
  for (const int threads : {1, 2, 8}) {
    CAPTURE(threads);
    CHECK_THROWS_WITH_AS((void)map(thesis, test, {.threads = threads}), "500.000000 25.000000", std::runtime_error);
  }
}

TEST_CASE("an exception of the progress is passed on") {
  const MapSettings settings{.threads = 3, .progress = [](double) { throw std::runtime_error("enough"); }};
  CHECK_THROWS_WITH_AS((void)map(thesis, product, settings), "enough", std::runtime_error);
}

TEST_CASE("one thread is the caller's") {
  const auto caller = std::this_thread::get_id();
  const auto result =
      map(thesis, [&](const Tissue<double>&) { return std::this_thread::get_id() == caller; }, {.threads = 1});
  CHECK(result.count([](bool same) { return same; }) == 399);
}

TEST_CASE("a broken grid, and a number of threads that is negative or absurd, are refused") {
  const Grid<double> broken{{200, 0, 2000}, {20, 1, 40}};
  CHECK_THROWS_AS((void)map(broken, product), std::invalid_argument);
  CHECK_THROWS_AS((void)map(thesis, product, {.threads = -1}), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)map(thesis, product, {.threads = 2'000'000'000}),
                       "MapSettings: threads: expected 0 to 1024, got 2000000000", std::invalid_argument);
}
