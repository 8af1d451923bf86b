// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the proofs assume about floating point: an operation is done as written, rounds once, to
/// its own type, and knows NaN and infinity. This must also hold in each program that includes a
/// header of swept, since the program's flags apply to templates and inline functions. No macro
/// reveals fused multiply-adds; so the CMake target and the pkg-config file of the core set
/// -ffp-contract=off.

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0)
#error "swept: nothing is proven with -ffast-math, -Ofast or -ffinite-math-only: leave them out"
#endif

#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "swept: nothing is proven with operations in excess precision: -mfpmath=sse instead of 387"
#endif
