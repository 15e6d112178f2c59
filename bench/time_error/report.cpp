// SPDX-License-Identifier: MIT
#include "time_error/row.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <sstream>

namespace limpid::bench {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

}  // namespace

void print_table(const std::vector<Row>& rows) {
  std::string heading;
  for (const Row& row : rows) {
    if (const std::string here = row.place + ", " + row.name; here != heading) {
      std::printf("\n%s\n%-34s %-11s %10s %7s %10s %10s\n", here.c_str(), "", "", "ns", "ratio", "truncation",
                  "rounding");
      heading = here;
    }
    std::printf("%-34s %-11s %10.2f %7.2f %10.1e %10.1e %s%s\n", row.method.c_str(), row.scalar.c_str(), row.time.ns,
                row.time.ratio, row.truncation_error, row.rounding_error, row.on_front ? "*" : "",
                row.is_default ? " default" : "");
  }
}

std::string as_csv(const std::vector<Row>& rows) {
  std::ostringstream out;
  out.precision(6);
  out << "place,case,method,scalar,time_ns,time_ratio,truncation_error,rounding_error,on_front,is_default\n";
  for (const Row& row : rows) {
    out << '"' << row.place << "\",\"" << row.name << "\",\"" << row.method << "\",\"" << row.scalar << "\","
        << row.time.ns << ',' << row.time.ratio << ',' << row.truncation_error << ',' << row.rounding_error << ','
        << row.on_front << ',' << row.is_default << '\n';
  }
  return out.str();
}

std::string as_json(const std::vector<Row>& rows, int turns, const std::vector<std::string>& broken) {
  Json list = Json::array();
  for (const Row& row : rows) {
    list.push_back({{"place", row.place},
                    {"case", row.name},
                    {"method", row.method},
                    {"scalar", row.scalar},
                    {"time_ns", row.time.ns},
                    {"time_ratio", number_or_null(row.time.ratio)},
                    {"time_ratio_quartiles", {number_or_null(row.time.lower), number_or_null(row.time.upper)}},
                    {"truncation_error", number_or_null(row.truncation_error)},
                    {"rounding_error", number_or_null(row.rounding_error)},
                    {"on_front", row.on_front},
                    {"is_default", row.is_default}});
  }
  return Json{{"turns", turns}, {"rows", list}, {"broken_rules", broken}}.dump(2) + "\n";
}

}  // namespace limpid::bench
