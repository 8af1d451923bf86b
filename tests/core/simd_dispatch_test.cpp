// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/simd_dispatch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/simd_dispatch_test.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swept::HWY_NAMESPACE {
namespace {

std::int64_t compiledFor() {
  return HWY_TARGET;
}

}  // namespace
}  // namespace swept::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept {
namespace {

// Arrays of kernels have no room for these.
constexpr std::int64_t kScalableVectors = HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128;
static_assert((HWY_TARGETS & kScalableVectors) == 0);
static_assert((HWY_DISABLED_TARGETS & kScalableVectors) == kScalableVectors,
              "processors that have them would run them");

SWEPT_DISPATCH_TABLE(compiledFor);

TEST(SimdDispatch, GoesToTheSetThatIsWanted) {
  for (const std::int64_t target : simd_test::simdTargets()) {
    const simd_test::OnTarget on(target);
    EXPECT_EQ(SWEPT_DISPATCH(compiledFor)(), target);
  }
}

TEST(SimdDispatch, GoesToTheBestSetOfTheProcessor) {
  // Highway gives better ones smaller bits.
  EXPECT_EQ(SWEPT_DISPATCH(compiledFor)(), simd_test::simdTargets().front());
}

#if HWY_ARCH_X86
TEST(SimdDispatch, HasTheSetsThatTheKernelLists) {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  std::set<std::string> flags;
  while (flags.empty() && std::getline(file, line)) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != "flags") continue;
    while (words >> word) flags.insert(word);
  }
  if (flags.empty()) GTEST_SKIP() << "/proc/cpuinfo lists no flags";
  const auto hasAll = [&](const std::set<std::string>& wanted) {
    return std::ranges::includes(flags, wanted);
  };
  const bool sse4 = hasAll({"ssse3", "sse4_1", "sse4_2", "pclmulqdq", "aes"});
  const bool avx2 = sse4 && hasAll({"avx2", "bmi1", "bmi2", "fma", "f16c"});
  const bool avx3 = avx2 && hasAll({"avx512f", "avx512vl", "avx512dq", "avx512bw"});
  const std::int64_t targets = detail::processorTargets();
  EXPECT_EQ((targets & HWY_SSE4) != 0, sse4 && (HWY_TARGETS & HWY_SSE4) != 0);
  EXPECT_EQ((targets & HWY_AVX2) != 0, avx2 && (HWY_TARGETS & HWY_AVX2) != 0);
  EXPECT_EQ((targets & HWY_AVX3) != 0, avx3 && (HWY_TARGETS & HWY_AVX3) != 0);
}
#endif

}  // namespace
}  // namespace swept
#endif  // HWY_ONCE
