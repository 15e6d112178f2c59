// SPDX-License-Identifier: MIT
#pragma once

// Before a loop that is short and of known length: without this -O2 leaves it a loop.
#if defined(__clang__)
#define LIMPID_UNROLL _Pragma("unroll")
#else
#define LIMPID_UNROLL _Pragma("GCC unroll 8")
#endif
