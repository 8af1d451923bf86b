// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/floating_point_environment.hpp"

#include <cfenv>
#include <cstdint>

namespace swept::detail {
namespace {

#if defined(__GNUC__) && defined(__SSE2__)

constexpr std::uint32_t kRoundingOrZeros = 0xE040;
constexpr std::uint16_t kRoundingAndPrecision = 0x0F00;
constexpr std::uint16_t kDefaultPrecision = 0x0300;

std::uint32_t vectorControl() {
  std::uint32_t control = 0;
  __asm__ volatile("stmxcsr %0" : "=m"(control));
  return control;
}

/// Flags that were raised meanwhile, and masks, stay.
void setVectorControl(std::uint32_t bits) {
  const std::uint32_t control = (vectorControl() & ~kRoundingOrZeros) | bits;
  __asm__ volatile("ldmxcsr %0" : : "m"(control) : "memory");
}

std::uint16_t longControl() {
  std::uint16_t control = 0;
  __asm__ volatile("fnstcw %0" : "=m"(control));
  return control;
}

void setLongControl(std::uint16_t bits) {
  const auto control = static_cast<std::uint16_t>((longControl() & ~kRoundingAndPrecision) | bits);
  __asm__ volatile("fldcw %0" : : "m"(control) : "memory");
}

class DefaultEnvironment {
 public:
  DefaultEnvironment()
      : vector_(vectorControl() & kRoundingOrZeros), long_(longControl() & kRoundingAndPrecision) {
    setVectorControl(0);
    setLongControl(kDefaultPrecision);
  }
  ~DefaultEnvironment() {
    setVectorControl(vector_);
    setLongControl(long_);
  }
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;

 private:
  std::uint32_t vector_;
  std::uint16_t long_;
};

#elif defined(__GNUC__) && defined(__aarch64__)

constexpr std::uint64_t kRoundingOrZeros = 0x1C00003;

std::uint64_t control() {
  std::uint64_t value = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(value));
  return value;
}

void setControl(std::uint64_t bits) {
  const std::uint64_t value = (control() & ~kRoundingOrZeros) | bits;
  __asm__ volatile("msr fpcr, %0" : : "r"(value) : "memory");
}

class DefaultEnvironment {
 public:
  DefaultEnvironment() : bits_(control() & kRoundingOrZeros) { setControl(0); }
  ~DefaultEnvironment() { setControl(bits_); }
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;

 private:
  std::uint64_t bits_;
};

#else

class DefaultEnvironment {
 public:
  DefaultEnvironment() : rounding_(std::fegetround()) { std::fesetround(FE_TONEAREST); }
  ~DefaultEnvironment() { std::fesetround(rounding_); }
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;

 private:
  int rounding_;
};

#endif

}  // namespace

void runInDefaultEnvironment(void (*query)(void*), void* closure) {
  // Volatile: not even a compiler that sees the whole program knows what is called.
  void (*volatile unknown)(void*) = query;
  if (!inForeignEnvironment() && !inForeignPrecision()) {
    unknown(closure);
    return;
  }
  const DefaultEnvironment scope;
  unknown(closure);
}

}  // namespace swept::detail
