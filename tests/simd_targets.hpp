// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "swept/core/simd_dispatch.hpp"

namespace swept::simd_test {

/// Instruction sets that the library is compiled for and that this machine has.
inline std::vector<std::int64_t> simdTargets() {
  std::vector<std::int64_t> targets;
  for (std::int64_t left = detail::processorTargets(); left != 0; left &= left - 1)
    targets.push_back(left & -left);
  return targets;
}

/// Dispatch goes to this instruction set for as long as this lives.
class OnTarget {
 public:
  explicit OnTarget(std::int64_t target) : trace_(__FILE__, __LINE__, hwy::TargetName(target)) {
    detail::chosenTarget().Update(target);
  }
  ~OnTarget() { detail::chosenTarget().Update(detail::processorTargets()); }
  OnTarget(const OnTarget&) = delete;
  OnTarget& operator=(const OnTarget&) = delete;

 private:
  testing::ScopedTrace trace_;
};

/// Calls `check(tally)` on each of the instruction sets, and records what each tally says.
template <typename Tally, typename Check>
void tallyOnAllTargets(const Check& check) {
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Tally tally;
    check(tally);
    testing::Test::RecordProperty(std::string("tally_") + hwy::TargetName(target), tally.text());
  }
}

}  // namespace swept::simd_test
