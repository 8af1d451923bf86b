// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cfenv>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/// Floating-point environments that a program may have set before it calls swept.
namespace swept::test {

struct Environment {
  std::string name;
  int rounding;           ///< FE_UPWARD, ...
  bool flushesToZero;     ///< results that are denormal
  bool denormalsAreZero;  ///< operands that are
};

/// All that are not the default: each alone, and together.
inline const std::vector<Environment>& foreignEnvironments() {
  static const std::vector<Environment> all {
    {"upward", FE_UPWARD, false, false}, {"downward", FE_DOWNWARD, false, false},
        {"towards zero", FE_TOWARDZERO, false, false},
#if defined(__SSE2__)
        {"flush to zero", FE_TONEAREST, true, false},
        {"denormals are zero", FE_TONEAREST, false, true},
        {"no denormals", FE_TONEAREST, true, true}, {"all upward", FE_UPWARD, true, true},
        {"all downward", FE_DOWNWARD, true, true},
#endif
  };
  return all;
}

/// Of this thread: rounding, zeros for denormals, masks of exceptions; not the flags.
[[gnu::noinline]] inline std::uint32_t environmentBits() {
#if defined(__SSE2__)
  return (_mm_getcsr() & ~0x3FU) | static_cast<std::uint32_t>(std::fegetround()) << 16U;
#else
  return static_cast<std::uint32_t>(std::fegetround());
#endif
}

[[gnu::noinline]] inline void enter(const Environment& environment) {
  std::fesetround(environment.rounding);
#if defined(__SSE2__)
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x40;
  _mm_setcsr((_mm_getcsr() & ~(kFlushToZero | kDenormalsAreZero)) |
             (environment.flushesToZero ? kFlushToZero : 0U) |
             (environment.denormalsAreZero ? kDenormalsAreZero : 0U));
#endif
}

/// The environment that a thread has when this begins.
class OwnEnvironment {
 public:
  OwnEnvironment() { std::fegetenv(&whole_); }
  void comeBack() const {
    std::fesetenv(&whole_);
#if defined(__SSE2__)
    _mm_setcsr(control_);  // MinGW's fesetenv leaves it
#endif
  }

 private:
  std::fenv_t whole_{};
#if defined(__SSE2__)
  unsigned control_ = _mm_getcsr();
#endif
};

/// Calls `act` in an environment. Returns whether that was still there afterwards, however `act`
/// ended; then this thread has its own again.
[[gnu::noinline]] inline bool leavesAlone(const Environment& environment,
                                          const std::function<void()>& act) {
  const OwnEnvironment own;
  enter(environment);
  const std::uint32_t before = environmentBits();
  try {
    act();
  } catch (...) {
    const bool same = environmentBits() == before;
    own.comeBack();
    if (!same) return false;
    throw;
  }
  const bool same = environmentBits() == before;
  own.comeBack();
  return same;
}

}  // namespace swept::test
