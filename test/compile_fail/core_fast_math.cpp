// SPDX-License-Identifier: MIT
// options: -ffast-math
// options: -Ofast
// options: -ffinite-math-only
// options: -O2 -ffast-math -fno-associative-math
// expect: limpid needs IEEE arithmetic
// expect: -ffast-math, -Ofast, -ffinite-math-only
#include <limpid/core/real.hpp>

int main() { return limpid::is_finite(1.0) ? 0 : 1; }
