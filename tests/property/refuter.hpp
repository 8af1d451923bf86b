// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenario.hpp"

struct RefuterOptions {
  double step = 1e-3;  ///< rad or m of any joint between samples
  double skew = 1.0;   ///< see RandomMotions
  int motions = 1000;
  std::uint64_t seed = 1;
};

/// What came of judging the checker's answers to random motions.
struct RefuterReport {
  int motions = 0, free = 0, collision = 0, undecided = 0;
  /// Free motions and contact-free prefixes whose least room was below 5 mm.
  int grazing = 0;
  long long states = 0;  ///< judged by the oracle
  /// m, least room of any Free motion: what the distance is more than the margin. Of each motion at
  /// most 61 coarse samples and a search about the narrowest are measured, up to 0.02.
  double leastRoomOfFree = 1.0;
  /// m, largest clearance seen where the proven prefix of a motion ended.
  double widestStop = 0.0;
  double roomiestUndecided = 0.0;  ///< m, largest of the least rooms of Undecided motions
  int undecidedAnywhere = 0;       ///< of the motions that were not aimed at obstacles
  double checkerSeconds = 0.0, oracleSeconds = 0.0;
  std::vector<std::string> failures;  ///< each with a command that reproduces it

  void add(const RefuterReport& other);
};

/// Asks the checker about random motions and tries to prove it wrong: by a sample of a Free motion
/// that overlaps (or keeps less than the margin), by a witness that does not touch, by a proven
/// prefix that is hit, and by a proven prefix that ends where there is room to spare. Options that
/// make no sense, and configurations of the wrong size, are std::invalid_argument.
RefuterReport refute(const Scenario& scenario, const RefuterOptions& options);

/// The same for one motion between two configurations of the group.
RefuterReport refuteMotion(const Scenario& scenario, const RefuterOptions& options,
                           const std::vector<double>& from, const std::vector<double>& to);

std::string summary(const RefuterReport& report);
