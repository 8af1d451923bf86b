// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "judge.hpp"

namespace sweeps {

struct CampaignOptions {
  std::uint64_t first = 0;  ///< index of the first sweep
  std::uint64_t count = 20000;
  std::uint64_t seed = 1;
  int symmetries = 8;  ///< one sweep in so many is asked in other ways too; 0: none
};

/// What came of judging the library's answers to random sweeps.
struct CampaignReport {
  std::uint64_t sweeps = 0, free = 0, collision = 0, undecided = 0, capped = 0;
  std::uint64_t contacts = 0;  ///< known by construction, deeper than rounding
  std::uint64_t atStart = 0;   ///< contactBy 0
  std::uint64_t close = 0;     ///< proven free, and seen within ten tolerances of the margin
  std::uint64_t mustBeFree = 0, symmetries = 0, crossings = 0;
  std::uint64_t samples = 0;  ///< judged by the tests' own distance
  std::array<std::uint64_t, kSceneNames.size()> scenes{};
  std::array<std::array<std::uint64_t, kKinds>, kKinds> pairs{};
  std::array<std::array<std::uint64_t, kPathKinds>, kPathKinds> paths{};
  double widest = 0.0;        ///< tolerances, of the straight crossings
  double roomiestStop = 0.0;  ///< tolerances beyond the margin
  std::uint64_t mostIntervals = 0;
  double slowest = 0.0;  ///< s, one query
  double querySeconds = 0.0, oracleSeconds = 0.0;
  std::vector<std::string> failures;  ///< each with what reproduces it

  void add(const CampaignReport& other);
};

CampaignReport runCampaign(const CampaignOptions& options);
std::string summary(const CampaignReport& report);

}  // namespace sweeps
