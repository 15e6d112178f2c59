// SPDX-License-Identifier: MIT
#include <limpid/limpid.hpp>

#include <iostream>

int main() {
  using namespace std::chrono_literals;
  limpid::DelayedSampled<double> seen({.period = 32ms, .delay = 16ms});
  (void)seen.update(0ms, 1.0);
  const auto [value, taken, arrived, fresh, status] = seen.update(16ms, 2.0);
  std::cout << "the sample taken at " << limpid::in_seconds<double>(taken) << " s is seen at "
            << limpid::in_seconds<double>(arrived) << " s: " << value << '\n';
  return fresh && value == 1.0 && status == limpid::Status::ok ? 0 : 1;
}
