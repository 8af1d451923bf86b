// SPDX-License-Identifier: BSD-3-Clause
/// Selects the instruction set that a kernel runs with. For sources of swept that are compiled with
/// Highway; not installed.
///
/// Highway's own library does the same (HWY_EXPORT, HWY_DYNAMIC_DISPATCH). But it measures the
/// processor's clock when it is loaded, with an instruction (`rdtscp`) that valgrind does not know
/// on every processor, and such a program ends before `main`. So swept uses only Highway's headers.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace swept::detail {

/// Bits of Highway (`HWY_AVX2`, ...) for the instruction sets that the library's kernels are
/// compiled for, of those that the processor has and the operating system saves. On processors
/// other than x86-64 it is one (`HWY_NEON`).
std::int64_t processorTargets();

/// The target that dispatch uses: processorTargets(), until a test changes it (`Update`).
hwy::ChosenTarget& chosenTarget();

}  // namespace swept::detail

/// Use after Highway's `HWY_ONCE`, in the namespace around HWY_NAMESPACE. Registers FUNCTION,
/// compiled for several instruction sets, for SWEPT_DISPATCH.
#define SWEPT_DISPATCH_TABLE(FUNCTION)                                               \
  static constexpr decltype(&HWY_STATIC_DISPATCH(FUNCTION)) FUNCTION##ByTarget[] = { \
      nullptr, HWY_CHOOSE_TARGET_LIST(FUNCTION), HWY_CHOOSE_FALLBACK(FUNCTION)}

/// FUNCTION for the best instruction set that it is compiled for and the processor has.
#define SWEPT_DISPATCH(FUNCTION) (FUNCTION##ByTarget[::swept::detail::chosenTarget().GetIndex()])
