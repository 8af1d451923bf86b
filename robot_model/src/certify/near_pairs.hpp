// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Worlds with fewer pieces of geometry have no tree of boxes.
inline constexpr std::size_t kFewestBoxes = 32;

/// The boxes of the model's world, handles being indices into CheckerModel::worldGeometry; null for
/// a world with few. `like`: as for compileChecker.
std::shared_ptr<const SweepAndPrune> compileBoxes(const CheckerModel& model,
                                                  const CheckerModel* like);

/// Finds the pairs whose boxes come near: few of all pairs of a large world.
class NearGeometries {
 public:
  NearGeometries(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace)
      : model_(model), query_(query), workspace_(workspace) {}

  /// Into `pairs`, ascending: all pairs but those whose boxes, swept over [t - half, t + half],
  /// stay apart by more than their margins.
  void collect(double half, std::vector<std::uint32_t>& pairs);

  /// Visits pairs of pieces of checked bodies, also pieces out of reach, those with the least lower
  /// bounds first. Stops when all other pairs are proven to stay at least as far apart on [t -
  /// half, t + half] as `least` (m) or the least bound that `visit(const GeometryPair&)` has
  /// returned.
  template <typename Visitor>
  void forNearest(double half, const Visitor& visit,
                  double least = std::numeric_limits<double>::infinity()) {
    if (model_.boxes != nullptr) lookAround(half, least, visit);
    collectWorld(half, least);
    collectLinks(half, [least](std::uint32_t) { return least; });
    visitBest(least, visit);
  }

  /// The same for pairs with the world, moving obstacles included, and for all other pairs. The
  /// bounds of one kind do not limit the other.
  template <typename Visitor>
  void forNearestByKind(double half, const Visitor& visit,
                        double world = std::numeric_limits<double>::infinity(),
                        double self = std::numeric_limits<double>::infinity()) {
    if (model_.boxes != nullptr) lookAround(half, world, visit);
    constexpr double kNone = -std::numeric_limits<double>::infinity();
    collectWorld(half, world);
    collectLinks(half, [&](std::uint32_t pair) { return isSelf(pair) ? kNone : world; });
    visitBest(world, visit);
    workspace_.bounds.clear();
    collectLinks(half, [&](std::uint32_t pair) { return isSelf(pair) ? self : kNone; });
    visitBest(self, visit);
  }

  /// Into WorkspaceData::bounds, in no order: pairs as in forNearest() that may come nearer than
  /// `world` or `self` (m) on [t - half, t + half]. Pairs with the world count for `world`, all
  /// others for `self`.
  void collectNearer(double half, double world, double self) {
    workspace_.bounds.clear();
    collectWorld(half, world);
    collectLinks(half, [&](std::uint32_t pair) { return isSelf(pair) ? self : world; });
  }
  GeometryPair pairOf(const PairBound& bound) const;

 private:
  /// Of a large world the box that is nearest to each geometry, so that few others are collected.
  template <typename Visitor>
  void lookAround(double half, double& least, const Visitor& visit) {
    collectNearestBoxes(half, least);
    visitBest(least, visit);
  }

  /// Visits the pairs of WorkspaceData::bounds and removes them.
  template <typename Visitor>
  void visitBest(double& least, const Visitor& visit) {
    std::vector<PairBound>& bounds = workspace_.bounds;
    std::ranges::make_heap(bounds, isFarther);
    while (!bounds.empty() && !(bounds.front().lower >= least)) {
      std::ranges::pop_heap(bounds, isFarther);
      const PairBound next = bounds.back();
      bounds.pop_back();
      least = std::min(least, visit(pairOf(next)));
    }
    bounds.clear();
  }

  static bool isFarther(const PairBound& a, const PairBound& b) { return a.lower > b.lower; }
  bool isSelf(std::uint32_t pair) const { return model_.isSelfPair(model_.pair(pair)); }
  /// Whether distances of the geometry from the world count.
  bool isMeasured(std::size_t geometry) const {
    return model_.firstBodyPair[model_.robotGeometry[geometry].collisionBody] >= 0;
  }
  ///@{
  /// Into WorkspaceData::bounds: pairs with lower bounds below `least`.
  void collectNearestBoxes(double half, double least);
  void collectWorld(double half, double least);
  void collectWorld(std::size_t geometry, double half, double least);
  template <typename LeastOf>
  void collectLinks(double half, const LeastOf& leastOf) {
    for (std::uint32_t i = model_.firstSelfPair; i < model_.pairCount(); ++i)
      add(lowerBound(model_.pair(i), half), leastOf(i), -1, static_cast<std::int32_t>(i));
  }
  ///@}
  void add(double lower, double least, std::int32_t geometry, std::int32_t other) {
    // NaN settles nothing, so such a pair is the first to be looked at.
    if (std::isnan(lower)) lower = -std::numeric_limits<double>::infinity();
    if (lower < least) workspace_.bounds.push_back({lower, geometry, other});
  }
  /// m, over [t - half, t + half], from what contains the two.
  double lowerBound(const GeometryPair& pair, double half) {
    return query_.coarseDistance(pair) - (half > 0.0 ? query_.travel(pair, half) : 0.0);
  }

  /// The pairs of a geometry with the world, ascending by the world's geometry.
  std::span<const WorldPair> worldPairs(std::size_t geometry) const {
    const std::uint32_t first = model_.firstWorldPair[geometry];
    return {model_.worldPairs.data() + first, model_.firstWorldPair[geometry + 1] - first};
  }
  std::optional<std::uint32_t> pairOf(std::size_t geometry, BoxHandle other) const;

  const CheckerModel& model_;
  PairQuery& query_;
  WorkspaceData& workspace_;
};

}  // namespace swept::detail
