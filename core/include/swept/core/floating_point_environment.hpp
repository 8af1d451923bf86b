// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cfenv>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "swept/core/arithmetic.hpp"

/// The proofs count roundings to nearest, of results that may be denormal: the default environment.
/// A program may have set another one for its thread (std::fesetround, flush to zero or denormals
/// are zero for an audio or solver library, a compiler's start code for -ffast-math).
///
/// Every function of swept that computes runs in the default environment, whatever the caller's is,
/// and gives the same bits. The caller's comes back when it ends, by return or exception, with the
/// exceptions masked that were masked; flags that the function raised stay raised, as with any
/// arithmetic. What the function calls of the program's own (visitors, motions, rules, distance
/// functions, OMPL's callbacks) runs in the default environment, too, but for a shorter long
/// double, and leaves it as it was.
/// Left out are members defined within a class that compare or add a few numbers (Aabb::overlaps,
/// center(), ApproachBound::along() ...): they compute where they are called. Comparisons err
/// towards overlap there, and the bounds that queries put on roundings are wide enough for both.
namespace swept {

namespace detail {

/// What is not the default in the control register of the thread: rounding that is not to nearest,
/// results or operands of denormals that count as zero.
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

/// The same of long double, where that has a register of its own: rounding, or a precision that is
/// less than its type's.
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

/// What `query()` returns, computed in the default environment: for code of one's own that calls
/// many functions of swept, or OMPL's planners, which compute between its calls.
///
/// An object that changes the environment and restores it would not do: to a compiler a change of
/// the control register has nothing to do with arithmetic, which it moves across. Here all of it is
/// in a function that is called by an address the compiler cannot know, from a function that does
/// no arithmetic. So none gets out, and results are in memory before the environment changes back.
///
/// swept's own functions begin with
///
///     if (detail::inForeignEnvironment()) {
///       return inDefaultEnvironment([&] { return f(x); });  // itself
///     }
///
/// What follows, and may move before the question, is used in the default environment alone.
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
