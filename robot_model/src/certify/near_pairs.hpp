// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "certify/pair_query.hpp"
#include "model/compile.hpp"

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

  /// Visits pairs of pieces of checked bodies, also pieces out of reach. Stops when all other pairs
  /// are proven to stay at least as far apart on [t - half, t + half] as `least` (m) or the least
  /// bound that `visit(const GeometryPair&)` has returned.
  template <typename Visitor>
  void forNearest(double half, const Visitor& visit,
                  double least = std::numeric_limits<double>::infinity()) {
    forNearestOfWorld(half, least, visit);
    for (std::uint32_t pair = model_.firstSelfPair; pair < model_.pairCount(); ++pair)
      visitNear(model_.pair(pair), half, least, visit);
  }

  /// The same for pairs with the world, moving obstacles included, and for all other pairs. The
  /// bounds of one kind do not limit the other.
  template <typename Visitor>
  void forNearestByKind(double half, const Visitor& visit,
                        double world = std::numeric_limits<double>::infinity(),
                        double self = std::numeric_limits<double>::infinity()) {
    forNearestOfWorld(half, world, visit);
    for (std::uint32_t index = model_.firstSelfPair; index < model_.pairCount(); ++index) {
      const GeometryPair pair = model_.pair(index);
      visitNear(pair, half, model_.isSelfPair(pair) ? self : world, visit);
    }
  }

 private:
  template <typename Visitor>
  void visitNear(const GeometryPair& pair, double half, double& least, const Visitor& visit) {
    const double approach = half > 0.0 ? query_.travel(pair, half) : 0.0;
    // NaN settles nothing.
    const bool settled = query_.coarseDistance(pair) - approach >= least;
    if (!settled) least = std::min(least, visit(pair));
  }

  template <typename Visitor>
  void forNearestOfWorld(double half, double& least, const Visitor& visit) {
    for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
      if (model_.firstBodyPair[model_.robotGeometry[i].collisionBody] < 0) continue;
      const GeometryPair& like = model_.likeWorldPairs[i];
      const auto oneOfWorld = [&](std::size_t other) {
        const auto b = static_cast<int>(other);
        if (model_.checksWorld(like.a, b))
          visitNear(worldPair(model_, like, b), half, least, visit);
        return least;
      };
      if (model_.boxes == nullptr) {
        for (std::size_t k = 0; k < model_.worldGeometry.size(); ++k) oneOfWorld(k);
      } else {
        model_.boxes->distance(query_.ballBox(like, half), workspace_.boxes,
                               [&](BoxHandle other, double) { return oneOfWorld(other); });
      }
    }
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
