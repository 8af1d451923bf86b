// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/floating_point_environment.hpp"

#include <cfenv>
#include <cstdint>

namespace swept::detail {
namespace {

// The bits of the control registers that make up an environment. Setting them leaves the other bits
// at their present values: masks, and flags that were raised meanwhile.
#if defined(__GNUC__) && defined(__SSE2__)

constexpr std::uint32_t kRoundingOrZeros = 0xE040;
constexpr std::uint16_t kRoundingAndPrecision = 0x0F00;

struct Control {
  std::uint32_t vector;
  std::uint16_t extended;
};
constexpr Control kDefault{0, 0x0300};

Control wholeControl() {
  Control whole{};
  __asm__ volatile("stmxcsr %0" : "=m"(whole.vector));
  __asm__ volatile("fnstcw %0" : "=m"(whole.extended));
  return whole;
}

Control control() {
  const Control whole = wholeControl();
  return {whole.vector & kRoundingOrZeros,
          static_cast<std::uint16_t>(whole.extended & kRoundingAndPrecision)};
}

void setControl(const Control& bits) {
  Control whole = wholeControl();
  whole.vector = (whole.vector & ~kRoundingOrZeros) | bits.vector;
  whole.extended =
      static_cast<std::uint16_t>((whole.extended & ~kRoundingAndPrecision) | bits.extended);
  __asm__ volatile("ldmxcsr %0" : : "m"(whole.vector) : "memory");
  __asm__ volatile("fldcw %0" : : "m"(whole.extended) : "memory");
}

#elif defined(__GNUC__) && defined(__aarch64__)

constexpr std::uint64_t kRoundingOrZeros = 0x1C00003;
using Control = std::uint64_t;
constexpr Control kDefault = 0;

Control wholeControl() {
  Control whole = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(whole));
  return whole;
}

Control control() {
  return wholeControl() & kRoundingOrZeros;
}

void setControl(Control bits) {
  const Control whole = (wholeControl() & ~kRoundingOrZeros) | bits;
  __asm__ volatile("msr fpcr, %0" : : "r"(whole) : "memory");
}

#else

using Control = int;
constexpr Control kDefault = FE_TONEAREST;
Control control() {
  return std::fegetround();
}
void setControl(Control rounding) {
  std::fesetround(rounding);
}

#endif

class DefaultEnvironment {
 public:
  DefaultEnvironment() : callers_(control()) { setControl(kDefault); }
  ~DefaultEnvironment() { setControl(callers_); }
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;

 private:
  Control callers_;
};

}  // namespace

void runInDefaultEnvironment(void (*query)(void*), void* closure) {
  // Volatile: not even a compiler that sees the whole program knows the function that is called.
  void (*volatile unknown)(void*) = query;
  if (!inForeignEnvironment() && !inForeignPrecision()) {
    unknown(closure);
    return;
  }
  const DefaultEnvironment scope;
  unknown(closure);
}

}  // namespace swept::detail
