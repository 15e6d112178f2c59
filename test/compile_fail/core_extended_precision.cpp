// SPDX-License-Identifier: MIT
// options: -U__FLT_EVAL_METHOD__ -D__FLT_EVAL_METHOD__=2
// options: -U__FLT_EVAL_METHOD__ -D__FLT_EVAL_METHOD__=1
// options: -U__FLT_EVAL_METHOD__ -D__FLT_EVAL_METHOD__=-1
// expect: limpid needs FLT_EVAL_METHOD 0
// expect: leave out -mfpmath=387
#include <limpid/core/real.hpp>

int main() { return limpid::is_finite(1.0) ? 0 : 1; }
