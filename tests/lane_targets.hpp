// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace swept::lane_test {

/// Instruction sets that this program is compiled for and that this machine has.
inline std::vector<std::int64_t> laneTargets() {
  std::vector<std::int64_t> targets;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) targets.push_back(target);
  return targets;
}

/// Dispatch goes to this instruction set for as long as this lives.
class OnTarget {
 public:
  explicit OnTarget(std::int64_t target) : trace_(__FILE__, __LINE__, hwy::TargetName(target)) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~OnTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  OnTarget(const OnTarget&) = delete;
  OnTarget& operator=(const OnTarget&) = delete;

 private:
  testing::ScopedTrace trace_;
};

/// Calls `check(tally)` on each of the instruction sets, and records what each tally says.
template <typename Tally, typename Check>
void tallyOnAllTargets(const Check& check) {
  for (const std::int64_t target : laneTargets()) {
    const OnTarget on(target);
    Tally tally;
    check(tally);
    testing::Test::RecordProperty(std::string("tally_") + hwy::TargetName(target), tally.text());
  }
}

}  // namespace swept::lane_test
