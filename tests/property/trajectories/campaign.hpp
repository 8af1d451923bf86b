// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "curve.hpp"

namespace trajectories {

/// Curves of each stage, see makeStage(), unless another number is asked for.
inline constexpr std::uint64_t kCurvesOfStage = 20;

struct CampaignOptions {
  std::uint64_t first = 0;  ///< index of the first curve
  std::uint64_t count = 1000;
  std::uint64_t seed = 1;
  std::size_t samples = 0;  ///< most of one curve; 0: as many as there are
  std::uint64_t curvesOfStage = kCurvesOfStage;
  double seconds = kLongest;  ///< s, that a curve takes at most
};

/// Of curves, or of those of one kind.
struct Tally {
  std::uint64_t curves = 0, free = 0, collision = 0, undecided = 0;

  void add(const Tally& other);
};

struct CampaignReport {
  Tally all;
  Tally narrow;  ///< in tubes of no more than kNarrow
  std::array<Tally, kKindNames.size()> kinds;
  std::vector<Tally> scenes;
  std::uint64_t near = 0;      ///< Free, and some configuration of the tube within kNear of contact
  std::uint64_t beside = 0;    ///< contacts that only the tube has
  std::uint64_t prefixes = 0;  ///< not Free, but free at first
  std::uint64_t tooFast = 0;   ///< beyond a limit of rates
  std::uint64_t outside = 0;   ///< beyond a limit of positions
  std::uint64_t states = 0;    ///< judged
  std::vector<std::string> failures;  ///< each with what reproduces it

  void add(const CampaignReport& other);
};

inline constexpr double kNarrow = 5e-3;  ///< rad or m
inline constexpr double kNear = 0.02;    ///< m

/// Asks about random curves in random tubes, and tries to prove the answers wrong.
CampaignReport runCampaign(const CampaignOptions& options);
std::string summary(const CampaignReport& report);

}  // namespace trajectories
