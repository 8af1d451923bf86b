// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "case.hpp"

namespace swept {
class Checker;
}

namespace constraints {

/// Whether another program shows that the constraints of a checker hold along a case, whose values
/// are in another order; without a value it cannot say.
using Shows = std::function<std::optional<bool>(const Case& of, const swept::Checker& checker,
                                                std::span<const int> order)>;

struct CampaignOptions {
  std::uint64_t first = 0;  ///< index of the first case
  std::uint64_t count = 1000;
  std::uint64_t seed = 1;
  std::size_t samples = 0;  ///< most of one motion; 0: one every milliradian and millimetre
  Shows shows = {};         ///< asked as well, and tried to prove wrong
};

struct Tally {
  std::uint64_t cases = 0, free = 0, violated = 0, undecided = 0;
  void add(const Tally& other);
};

struct CampaignReport {
  Tally all;
  Tally tubes, curves, relative;  ///< of these alone: of two moving frames the last
  std::array<Tally, kKinds> kinds;
  std::uint64_t near = 0;      ///< Free, and closer to a tolerance than a tenth of the motion
  std::uint64_t prefixes = 0;  ///< not Free, but proven at first
  ///@{
  /// What Shows says of the motions that are Free; and of the others.
  std::uint64_t shown = 0, notShown = 0, shownOfOthers = 0;
  ///@}
  std::uint64_t samples = 0;
  std::uint64_t intervals = 0;        ///< examined
  std::vector<std::string> failures;  ///< each with what makes it again

  void add(const CampaignReport& other);
};

/// Asks about random motions under random constraints, and tries to prove the answers wrong.
CampaignReport runCampaign(const CampaignOptions& options);
std::string summary(const CampaignReport& report);

}  // namespace constraints
