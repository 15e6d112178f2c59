// SPDX-License-Identifier: MIT
// A signal that is computed slowly and late: what the loop sees of it.
#include <limpid/signal/delayed_sampled.hpp>

#include <cmath>
#include <cstdio>

int main() {
  using namespace std::chrono_literals;
  limpid::DelayedSampled<double> tissue({.period = 16ms, .delay = 20ms});  // the delay exceeds the period
  for (limpid::Time now = 0ms; now <= 60ms; now += 1ms) {
    const auto seen = tissue.update(now, std::sin(20 * limpid::in_seconds(now)));
    if (!seen.fresh) continue;
    std::printf("at %2lld ms: %.4f, taken at %2lld ms\n", static_cast<long long>(now / 1ms), seen.value,
                static_cast<long long>(seen.taken / 1ms));
  }
}
