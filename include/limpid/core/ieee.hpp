// SPDX-License-Identifier: MIT
#pragma once

/// Refuses compiler options under which the library would not be what it says: checks of finiteness would always pass,
/// error-free sums would lose their errors, and the roundings that proofs count would be others. g++ shows them all as
/// macros; clang shows neither -funsafe-math-optimizations nor its parts. Contraction to FMA may stay.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "limpid needs IEEE arithmetic: leave out -ffast-math, -Ofast, -ffinite-math-only, -funsafe-math-optimizations"
#endif
