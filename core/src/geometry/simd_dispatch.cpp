// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/simd_dispatch.hpp"

#if HWY_ARCH_X86
#include <cpuid.h>
#endif

namespace swept::detail {

namespace {

#if HWY_ARCH_X86
struct Registers {
  unsigned eax = 0;
  unsigned ebx = 0;
  unsigned ecx = 0;
  unsigned edx = 0;
};

/// Zeros for a leaf that the processor does not have.
Registers cpuid(unsigned leaf, unsigned part) {
  Registers r;
  const bool there = __get_cpuid_count(leaf, part, &r.eax, &r.ebx, &r.ecx, &r.edx) != 0;
  return there ? r : Registers{};
}

/// Features that not every compiler's __builtin_cpu_supports knows by name.
bool hasF16c() {
  return (cpuid(1, 0).ecx >> 29 & 1U) != 0;
}
bool hasVaes() {
  return (cpuid(7, 0).ecx >> 9 & 1U) != 0;
}
bool hasAvxVnni() {
  return (cpuid(7, 1).eax >> 4 & 1U) != 0;
}

/// The features that Highway compiles each of its targets with. __builtin_cpu_supports also asks
/// the operating system whether it saves the registers.
std::int64_t detectedTargets() {
  __builtin_cpu_init();
  const auto has = [](auto supported) { return supported != 0; };
  std::int64_t targets = 0;
  if (!has(__builtin_cpu_supports("ssse3"))) return targets;
  targets |= HWY_SSSE3;
  if (!has(__builtin_cpu_supports("sse4.1")) || !has(__builtin_cpu_supports("sse4.2")) ||
      !has(__builtin_cpu_supports("pclmul")) || !has(__builtin_cpu_supports("aes")))
    return targets;
  targets |= HWY_SSE4;
  if (!has(__builtin_cpu_supports("avx2")) || !has(__builtin_cpu_supports("bmi")) ||
      !has(__builtin_cpu_supports("bmi2")) || !has(__builtin_cpu_supports("fma")) || !hasF16c())
    return targets;
  targets |= HWY_AVX2;
  if (!has(__builtin_cpu_supports("avx512f")) || !has(__builtin_cpu_supports("avx512vl")) ||
      !has(__builtin_cpu_supports("avx512dq")) || !has(__builtin_cpu_supports("avx512bw")))
    return targets;
  targets |= HWY_AVX3;
  if (!has(__builtin_cpu_supports("vpclmulqdq")) || !has(__builtin_cpu_supports("avx512vbmi")) ||
      !has(__builtin_cpu_supports("avx512vbmi2")) || !has(__builtin_cpu_supports("avx512vnni")) ||
      !has(__builtin_cpu_supports("avx512vpopcntdq")) ||
      !has(__builtin_cpu_supports("avx512bitalg")) || !hasVaes() || !hasAvxVnni())
    return targets;
  return targets | HWY_AVX3_DL;
}
#else
std::int64_t detectedTargets() {
  return 0;
}
#endif

constinit hwy::ChosenTarget chosen;

}  // namespace

std::int64_t processorTargets() {
  static const std::int64_t targets = (HWY_STATIC_TARGET | detectedTargets()) & HWY_TARGETS;
  return targets;
}

hwy::ChosenTarget& chosenTarget() {
  if (!chosen.IsInitialized()) chosen.Update(processorTargets());
  return chosen;
}

}  // namespace swept::detail
