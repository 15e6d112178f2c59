// SPDX-License-Identifier: MIT
#pragma once

/// Refuses compiler options under which the library would not be what it says: checks of finiteness would always pass,
/// error-free sums would lose their errors, and the roundings that proofs count would be others. g++ shows them all as
/// macros; clang shows neither -funsafe-math-optimizations nor its parts. Contraction to FMA may stay.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "limpid needs IEEE arithmetic: leave out -ffast-math, -Ofast, -ffinite-math-only, -funsafe-math-optimizations"
#endif

/// Nor sums and products of more digits than the type's, rounded twice, as the x87 unit makes them: roundings to whole
/// numbers and error-free products would be others. 16 and 32 stand for more digits in types below float alone.
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16 && __FLT_EVAL_METHOD__ != 32
#error "limpid needs FLT_EVAL_METHOD 0, sums of their type: leave out -mfpmath=387 (32 bits: -msse2 -mfpmath=sse)"
#endif
