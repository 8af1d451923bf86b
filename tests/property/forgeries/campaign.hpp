// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mutate.hpp"

namespace forgeries {

struct CampaignOptions {
  std::uint64_t first = 0;  ///< index of the first file
  std::uint64_t count = 20000;
  std::uint64_t seed = 1;
  /// Path files that have their models in them; some of the files are made of these, the others of
  /// scenes that are made up.
  std::vector<Json> originals = {};
};

/// What the checker of proofs said to forged files, and what exact arithmetic says to those that it
/// accepted.
struct CampaignReport {
  std::uint64_t files = 0, accepted = 0;
  std::uint64_t originals = 0;                            ///< accepted ones that are made of others
  std::uint64_t pairs = 0;                                ///< in accepted files
  std::array<std::uint64_t, kFields> made{}, believed{};  ///< files, and accepted ones, per field
  std::vector<std::string> failures;                      ///< each with what makes the file again

  void add(const CampaignReport& other);
};

/// A forged file that fits its own digests; null: the checker refuses its model.
Json forge(const CampaignOptions& options, std::uint64_t index, std::vector<Field>& fields);

CampaignReport runCampaign(const CampaignOptions& options);
std::string summary(const CampaignReport& report);

}  // namespace forgeries
