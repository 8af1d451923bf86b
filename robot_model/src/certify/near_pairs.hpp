// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Worlds with fewer pieces of geometry are looked through one by one.
inline constexpr std::size_t kFewestBoxes = 32;

/// The boxes of the model's world, handles being indices into CheckerModel::worldGeometry; null for
/// a world with few. `like`: as for compileChecker.
std::shared_ptr<const SweepAndPrune> compileBoxes(const CheckerModel& model,
                                                  const CheckerModel* like);

/// The exact tier's pairs in order of their boxes: of all pairs of a large world, few come near.
class NearGeometries {
 public:
  NearGeometries(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace)
      : model_(model), query_(query), workspace_(workspace) {}

  /// Into `pairs`, ascending: all pairs but those whose boxes, swept over [t - half, t + half],
  /// stay apart by more than their margins.
  void collect(double half, std::vector<std::uint32_t>& pairs);

  /// Visits pairs until all others are proven to be at least as far apart as the least bound that
  /// `visit(pair)` has returned (m), at t.
  template <typename Visitor>
  void forNearest(const Visitor& visit) {
    double least = std::numeric_limits<double>::infinity();
    const auto one = [&](std::uint32_t pair) {
      // What is no number says nothing.
      const bool settled = query_.coarseDistance(model_.pairs[pair]) >= least;
      if (!settled) least = std::min(least, visit(pair));
    };
    if (model_.boxes == nullptr) {
      for (std::uint32_t pair = 0; pair < model_.pairs.size(); ++pair) one(pair);
      return;
    }
    for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
      if (worldPairs(i).empty()) continue;
      model_.boxes->distance(query_.ballBox(static_cast<int>(i), 0.0), workspace_.boxes,
                             [&](BoxHandle other, double) {
                               if (const auto pair = pairOf(i, other)) one(*pair);
                               return least;
                             });
    }
    for (std::uint32_t pair = model_.firstSelfPair; pair < model_.pairs.size(); ++pair) one(pair);
  }

 private:
  /// Of the geometry with the world, ascending in the world's geometry.
  std::span<const GeometryPair> worldPairs(std::size_t geometry) const {
    const std::uint32_t first = model_.firstWorldPair[geometry];
    return {model_.pairs.data() + first, model_.firstWorldPair[geometry + 1] - first};
  }
  std::optional<std::uint32_t> pairOf(std::size_t geometry, BoxHandle other) const;

  const CheckerModel& model_;
  PairQuery& query_;
  WorkspaceData& workspace_;
};

}  // namespace swept::detail
