// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the proofs assume of floating point, here and in each program that includes a header of
/// swept, whose templates and inline functions are compiled with the program's flags: an operation
/// is done as it is written, rounds once, to its own type, and knows NaN and infinity. No macro
/// tells of fused multiply-adds; the CMake target and the pkg-config file of the core ask for
/// -ffp-contract=off.

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0)
#error "swept: nothing is proven with -ffast-math, -Ofast or -ffinite-math-only: leave them out"
#endif

#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "swept: nothing is proven with operations in excess precision: -mfpmath=sse instead of 387"
#endif
