// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "exact_motion.hpp"
#include "simd_targets.hpp"

/// The table of ERROR_MODEL.md, row by row.
namespace swept::simd_test {

/// What is not a matter of lanes is measured once.
inline constexpr std::int64_t kAnyTarget = 0;

/// The largest error that was met, as a share of its bound, on each instruction set. At the end it
/// is a row of the table: bound / largest error.
class Worst {
 public:
  /// `least`: a share that some error has to come to, else the test would see nothing.
  Worst(std::string what, double least) : what_(std::move(what)), least_(least) {}
  Worst(const Worst&) = delete;
  Worst& operator=(const Worst&) = delete;
  ~Worst() {
    std::string row = "| " + what_ + " |";
    const bool once = shares_.contains(kAnyTarget);
    for (const std::int64_t target : simdTargets()) {
      const double share = shares_[once ? kAnyTarget : target];
      EXPECT_LE(share, 1.0) << what_ << ", " << hwy::TargetName(target);
      EXPECT_GE(share, least_) << what_ << ": no error is worth the bound";
      char factor[32];
      std::snprintf(factor, sizeof(factor), " %.3g |", 1.0 / share);
      row += factor;
    }
    std::printf("%s\n", row.c_str());
  }

  void note(std::int64_t target, const exact_test::Digits& error, const exact_test::Digits& bound) {
    double& share = shares_[target];
    const auto own = static_cast<double>(error / bound);
    if (!(own <= share)) share = own;
  }

 private:
  std::string what_;
  double least_;
  std::map<std::int64_t, double> shares_;
};

}  // namespace swept::simd_test
