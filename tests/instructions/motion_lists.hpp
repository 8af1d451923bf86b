// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "workloads.hpp"

namespace swept::instructions {

/// The folder models/. Loads rook7 once however often it is asked for: that takes longest.
class Models {
 public:
  explicit Models(std::filesystem::path folder) : folder_(std::move(folder)) {}
  const std::filesystem::path& folder() const { return folder_; }
  std::shared_ptr<const Robot> load(const std::string& robot) const;
  /// rook7's arm in an empty world, for Checker::withWorld.
  const Checker& arm();

 private:
  std::filesystem::path folder_;
  std::optional<Checker> arm_;
};

/// rook7's arm in each world of models/problems.json, with the motions of models/edges.csv.
std::vector<std::unique_ptr<Site>> armSites(Models& models);

/// A box of configurations that random motions start and end in.
struct Range {
  int first = 0;  ///< variables of the group: from here, `count` of them
  int count = 0;
  double lower = 0.0;
  double upper = 0.0;
};

/// A robot of models/ in a scene of models/, with `count` random motions: the first quarter of the
/// way between configurations that are drawn from `ranges`, or from the limits of variables that
/// are in no range.
std::vector<std::unique_ptr<Site>> randomSite(const Models& models, const std::string& robot,
                                              const std::string& group, const std::string& scene,
                                              std::span<const Range> ranges, int count,
                                              std::uint64_t seed);

/// Leaves the motions with this verdict.
void keepVerdict(std::vector<std::unique_ptr<Site>>& sites, Verdict verdict);

/// Cuts each motion off just before the first contact, and drops those that have none or begin in
/// one. What is left ends within a millimetre or so of a contact.
void cutAtContact(std::vector<std::unique_ptr<Site>>& sites);

}  // namespace swept::instructions
