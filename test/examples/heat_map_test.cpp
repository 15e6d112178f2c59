// SPDX-License-Identifier: MIT
#include "common/heat_map.hpp"
#include "common/gnuplot.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace limpid::examples;

namespace {

HeatMap two_by_three() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {"a map's title",
          {{"left", "k (N/m)", "b (N s/m)", {1, 2}, {10, 20, 30}, {0, 1, 1, nan, 0.5, 9}, region_scale}}};
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a heat map is drawn, or its values are written") {
  const auto svg = std::filesystem::temp_directory_path() / "limpid_heat_map.svg";
  const std::string written = draw(two_by_three(), svg.string());
  const std::string text = contents(written);
  std::filesystem::remove(written);
  if (gnuplot_is_installed()) {
    CHECK(written == svg.string());
    CHECK(text.find("</svg>") != std::string::npos);
    CHECK(text.find("a map's title") != std::string::npos);
  } else {
    CHECK(written.ends_with(".csv"));
    CHECK(text.find("\"left\",2,30,9") != std::string::npos);
  }
}

TEST_CASE("a heat map that cannot be written is an exception") {
  CHECK_THROWS_AS((void)draw(two_by_three(), "/no/such/folder/map.svg"), std::runtime_error);
}
