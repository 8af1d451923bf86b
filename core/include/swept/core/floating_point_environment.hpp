// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cfenv>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "swept/core/arithmetic.hpp"

/// The proofs assume the default environment: rounding to nearest, with denormal results. A program
/// may have set another one for its thread (std::fesetround; flush to zero or denormals are zero
/// for an audio or solver library; a compiler's start code for -ffast-math).
///
/// Every function of swept that computes runs in the default environment, whatever the caller's is,
/// and gives the same bits. The caller's environment is back when the function ends, by return or
/// exception. Masks of exceptions do not change; flags that the function raised stay raised, as
/// with any arithmetic. Callbacks of the program (visitors, motions, rules, distance functions,
/// OMPL's callbacks) run in the default environment, too, except for a shorter long double, and
/// leave it as it was.
/// Members defined within a class that compare or add a few numbers (Aabb::overlaps, center(),
/// ApproachBound::along() ...) are left out: they compute in the caller's environment. There,
/// comparisons err towards overlap, and the bounds that queries put on roundings are wide enough
/// for both.
namespace swept {

namespace detail {

/// Whether the thread's control register differs from the default: rounding is not to nearest, or
/// denormal results or operands count as zero.
inline bool inForeignEnvironment() {
#if defined(__GNUC__) && defined(__SSE2__)
  constexpr std::uint32_t kRoundingOrZeros = 0xE040;
  std::uint32_t control = 0;
  __asm__ volatile("stmxcsr %0" : "=m"(control));
  return __builtin_expect(static_cast<long>((control & kRoundingOrZeros) != 0), 0L) != 0;
#elif defined(__GNUC__) && defined(__aarch64__)
  constexpr std::uint64_t kRoundingOrZeros = 0x1C00003;
  std::uint64_t control = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  return __builtin_expect(static_cast<long>((control & kRoundingOrZeros) != 0), 0L) != 0;
#else
  return std::fegetround() != FE_TONEAREST;
#endif
}

/// The same for long double, if it has its own register: rounding is not to nearest, or the
/// precision is less than its type's.
inline bool inForeignPrecision() {
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
  constexpr std::uint16_t kRoundingAndPrecision = 0x0F00, kDefault = 0x0300;
  std::uint16_t control = 0;
  __asm__ volatile("fnstcw %0" : "=m"(control));
  return __builtin_expect(static_cast<long>((control & kRoundingAndPrecision) != kDefault), 0L) !=
         0;
#else
  return false;
#endif
}

/// Calls `query(closure)` in the default environment.
void runInDefaultEnvironment(void (*query)(void*), void* closure);

}  // namespace detail

/// Returns query(), computed in the default environment. Use it for your own code that calls many
/// functions of swept, or for OMPL's planners, which compute between its calls.
///
/// An object that changes the environment and restores it would not work. A compiler sees no
/// connection between the control register and arithmetic, and moves arithmetic across the change.
/// Here all arithmetic is in a function called through an address that the compiler cannot know,
/// from a function that does no arithmetic. So no arithmetic moves out, and results are in memory
/// before the environment changes back.
///
/// swept's own functions begin with
///
///     if (detail::inForeignEnvironment()) {
///       return inDefaultEnvironment([&] { return f(x); });  // itself
///     }
///
/// The code after this runs only in the default environment, even if the compiler moves it before
/// the question.
template <typename Query>
#if defined(__GNUC__)
[[gnu::noinline]]
#endif
std::invoke_result_t<Query&>
inDefaultEnvironment(Query&& query) {
  using Result = std::invoke_result_t<Query&>;
  static_assert(!std::is_reference_v<Result>);
  if constexpr (std::is_void_v<Result>) {
    using Callable = std::remove_reference_t<Query>;
    const void* const closure = std::addressof(query);
    detail::runInDefaultEnvironment([](void* callable) { (*static_cast<Callable*>(callable))(); },
                                    const_cast<void*>(closure));
  } else {
    std::optional<Result> result;
    inDefaultEnvironment([&] { result.emplace(query()); });
    return *std::move(result);
  }
}

}  // namespace swept
