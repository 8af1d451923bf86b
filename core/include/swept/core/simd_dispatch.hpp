// SPDX-License-Identifier: BSD-3-Clause
/// Which of the instruction sets that a kernel is compiled for runs. For sources of swept that are
/// compiled with Highway; not installed.
///
/// Highway's own library does the same (HWY_EXPORT, HWY_DYNAMIC_DISPATCH), but measures the
/// processor's clock when it is loaded, with an instruction (`rdtscp`) that valgrind does not know
/// on every processor: a program linked to it ends before `main`. So of Highway only headers are
/// used.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace swept::detail {

/// Bits of Highway (`HWY_AVX2`, ...): instruction sets that the processor has and the operating
/// system saves, and the one that the library is compiled for anyway. On other processors than
/// x86-64, the latter alone.
std::int64_t processorTargets();

/// What dispatch goes by: processorTargets(), until a test says otherwise (`Update`).
hwy::ChosenTarget& chosenTarget();

}  // namespace swept::detail

/// After Highway's `HWY_ONCE`, in the namespace around HWY_NAMESPACE: makes FUNCTION, compiled for
/// several instruction sets, known to SWEPT_DISPATCH.
#define SWEPT_DISPATCH_TABLE(FUNCTION)                                               \
  static constexpr decltype(&HWY_STATIC_DISPATCH(FUNCTION)) FUNCTION##ByTarget[] = { \
      nullptr, HWY_CHOOSE_TARGET_LIST(FUNCTION), HWY_CHOOSE_FALLBACK(FUNCTION)}

/// FUNCTION for the best instruction set that it is compiled for and the processor has.
#define SWEPT_DISPATCH(FUNCTION) (FUNCTION##ByTarget[::swept::detail::chosenTarget().GetIndex()])
