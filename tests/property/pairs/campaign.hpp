// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sample.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace pairs {

/// What the library says of a placement.
struct Answer {
  swept::DistanceResult distance;
  swept::SignedDistanceResult signedDistance;
  swept::Contact contact = swept::Contact::Unknown;
  /// Whether separate() proves that the bodies keep more than their spots are apart.
  bool keepsMore = false;
};

Answer ask(const Pair& pair, const Placing& placing);

/// What is wrong with an answer; empty: nothing that is known.
std::vector<std::string> faultsOf(const Pair& pair, const Placing& placing, const Answer& answer);

struct CampaignOptions {
  std::uint64_t first = 0;  ///< index of the first pair
  std::uint64_t count = 2000;
  std::uint64_t seed = 1;
  int placings = 8;  ///< of each pair
  int kindA = -1;    ///< only pairs of this kind with `kindB`; -1: of all
  int kindB = -1;
};

inline constexpr int kDecades = 25;

struct CampaignReport {
  std::uint64_t placings = 0;
  std::uint64_t apart = 0;     ///< proven so
  std::uint64_t touching = 0;  ///< found so
  std::uint64_t near = 0;      ///< proven apart, by less than 1e-9 of the size
  std::uint64_t within = 0;    ///< spots within 1e-14 of the size of each other
  std::uint64_t bounded = 0;   ///< known from below, too
  std::uint64_t exact = 0;     ///< spots in the same place to the last bit
  std::array<std::array<std::uint64_t, kKinds>, kKinds> pairs{};
  std::array<std::array<std::uint64_t, kKinds>, kKinds> apartOf{};
  std::array<std::uint64_t, kDecades> decades{};  ///< placings by size, from 1e-12 m
  std::vector<std::string> failures;              ///< each with what reproduces it

  void add(const CampaignReport& other);
};

CampaignReport runCampaign(const CampaignOptions& options);
std::string summary(const CampaignReport& report);

}  // namespace pairs
