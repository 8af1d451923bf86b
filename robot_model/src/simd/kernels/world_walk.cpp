// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/world_walk.hpp"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels/world_walk.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rounding/error_model.hpp"
#include "simd/kernels/f8.hpp"
#include "simd/kernels/field_walk.hpp"
#include "simd/kernels/obstacle_kernels.hpp"
#include "simd/kernels/placed_ball.hpp"
#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

/// Relative to the radius around a link: obstacles farther from its centre hardly reach the balls
/// inside.
constexpr float kProbeShare = 0.6F;

/// m^2. Square of a distance that is nothing but rounding.
constexpr float kZeroSquared = 1e-30F;

class WorldWalk {
 public:
  WorldWalk(const SimdModel& model, SimdScratch& scratch)
      : model_(model),
        scratch_(scratch),
        block_(scratch.block),
        fields_(model, scratch),
        half_(load(scratch.block.half)),
        moving_(scratch.block.mode == SimdMode::Motion),
        padded_(!model.extras.empty()),
        inTube_(!model.worldTube.empty()) {}

  /// Balls inside the outermost links.
  bool look() {
    for (std::size_t i = 0; i < model_.worldTips; ++i)
      if (lookAt(model_.worldBodies[i])) return true;
    return false;
  }

  /// The root balls of all links, and balls inside these, before the rest of their covers: most
  /// contacts show there.
  bool bodies() {
    fields_.clear();
    scratch_.hits.clear();
    scratch_.worldVisits.clear();
    for (std::size_t i = 0; i < model_.worldBodies.size(); ++i) {
      probes_ = !moving_ || i >= model_.worldTips;  // look() has done so
      if (first(model_.worldBodies[i])) return true;
    }
    for (const SimdScratch::WorldVisit& visit : scratch_.worldVisits) {
      start(visit.body);
      if (descend(model_.nodes[visit.node], visit.first, visit.last)) return true;
    }
    return settleFields();
  }

  bool lookAtPairs(int geometry, std::span<const SimdHit> obstacles) {
    state_ = &block_.states[model_.geometryBody[geometry]];
    const SimdNode& root = model_.nodes[model_.rootOfGeometry[geometry]];
    scratch_.hits.assign(obstacles.begin(), obstacles.end());
    return lookAt(root, place(root, *state_));
  }

  bool pairs(int geometry, std::span<const SimdHit> obstacles, bool looked) {
    probes_ = !looked;
    fields_.clear();
    start(model_.geometryBody[geometry]);
    const SimdNode& root = model_.nodes[model_.rootOfGeometry[geometry]];
    scratch_.hits.assign(obstacles.begin(), obstacles.end());
    if (visit(root, placed(root), 0, scratch_.hits.size())) return true;
    return settleFields();
  }

 private:
  bool settleFields() {
    return fields_.settle([this](const SimdNode& node, const SimdHit& hit) {
      start(model_.geometryBody[node.geometry]);
      scratch_.hits.assign(1, hit);
      return descend(node, 0, 1);
    });
  }

  bool lookAt(int body) {
    state_ = &block_.states[body];
    const SimdNode& root = model_.nodes[model_.rootOfBody[body]];
    const V3 middle = load3(block_.roots[body].at);
    const float reach = root.geometry >= 0 ? kProbeShare * root.radius : root.radius;
    scratch_.hits.clear();
    cull({middle, set3({0.0F, 0.0F, 0.0F})}, set(reach * kBallOutward));
    if (scratch_.hits.empty()) return false;
    if (root.geometry >= 0) return lookAt(root, middle);
    for (int i = 0; i < root.childCount; ++i) {
      const SimdNode& child = model_.nodes[root.firstChild + i];
      if (lookAt(child, place(child, *state_))) return true;
    }
    return false;
  }

  bool lookAt(const SimdNode& node, const V3& middle) {
    for (SimdHit hit : scratch_.hits) {
      const std::int32_t pair =
          model_.pairOf[node.geometry * model_.obstacles.obstacles.size() + hit.index];
      hit.lanes &= ~block_.contactLanes;
      if (pair >= 0 && probe(node, middle, hit, static_cast<std::uint32_t>(pair))) return true;
    }
    return false;
  }

  bool first(int body) {
    start(body);
    const std::int32_t index = model_.rootOfBody[body];
    const SimdNode& root = model_.nodes[index];
    const Segment segment = segmentOf(block_.roots[body], moving_);
    const std::size_t begin = scratch_.hits.size();
    cull(segment, inflated(root));
    const std::size_t culled = scratch_.hits.size();
    if (culled == begin) return false;
    if (sift(root, segment, begin, culled)) return true;
    const std::size_t sifted = scratch_.hits.size();
    if (root.geometry >= 0) {
      later(body, index, culled);
      return false;
    }
    for (int i = 0; i < root.childCount && sifted > culled; ++i) {
      const SimdNode& child = model_.nodes[root.firstChild + i];
      const std::size_t own = scratch_.hits.size();
      if (sift(child, placed(child), culled, sifted)) return true;
      later(body, root.firstChild + i, own);
    }
    return false;
  }

  void later(int body, std::int32_t node, std::size_t first) {
    if (scratch_.hits.size() > first)
      scratch_.worldVisits.push_back({body, node, first, scratch_.hits.size()});
  }

  void start(int body) {
    state_ = &block_.states[body];
    extra_ = set(scratch_.rounding + model_.margin);
    if (moving_)
      extra_ =
          extra_ + inflation(half_, accelerationOf(model_.references[0], scratch_.bounds[0], body));
    // Balls this close to the link are not worth another test before the interval is halved.
    enough_ = 0.5F * largestLane(extra_);
    if (inTube_) extra_ = extra_ + set(model_.worldTube[body]);
  }

  HWY_INLINE Segment placed(const SimdNode& node) const {
    return segmentOf(node, *state_, half_, moving_);
  }

  /// m; more than the rounding of squares and roots.
  HWY_INLINE F8 inflated(const SimdNode& node) const {
    return (set(node.radius) + extra_) * set(kBallOutward);
  }

  /// Obstacles whose boxes overlap the box around all lanes.
  void cull(const Segment& segment, const F8& radius) {
    const V3 reach = {absolute(segment.g.x) + radius, absolute(segment.g.y) + radius,
                      absolute(segment.g.z) + radius};
    const V3 low = segment.x - reach;
    const V3 high = segment.x + reach;
    const float lower[3] = {leastLane(low.x), leastLane(low.y), leastLane(low.z)};
    const float upper[3] = {largestLane(high.x), largestLane(high.y), largestLane(high.z)};
    const V3 from = set3(lower);
    const V3 to = set3(upper);
    const auto& nodes = model_.obstacles.nodes;
    std::int32_t stack[kMostPending];
    int pending = 0;
    if (!nodes.empty()) stack[pending++] = 0;
    while (pending > 0) {
      const SimdWorldNode& node = nodes[stack[--pending]];
      const Lanes apart = above(load(node.lower[0]), to.x) | above(load(node.lower[1]), to.y) |
                          above(load(node.lower[2]), to.z) | below(load(node.upper[0]), from.x) |
                          below(load(node.upper[1]), from.y) | below(load(node.upper[2]), from.z);
      for (Lanes left = ~apart & kAllLanes; left != 0; left &= left - 1) {
        const std::int32_t child = node.child[std::countr_zero(left)];
        if (child < 0) {
          scratch_.hits.push_back({~child, kAllLanes});
        } else if (child > 0) {  // 0: an empty lane, which an infinite box overlaps
          stack[pending++] = child;
        }
      }
    }
  }

  /// The hits from `first` to `last` are those that the node's parent is not proven apart from.
  bool visit(const SimdNode& node, const Segment& segment, std::size_t first, std::size_t last) {
    const std::size_t own = scratch_.hits.size();
    if (sift(node, segment, first, last)) return true;
    const bool contact = descend(node, own, scratch_.hits.size());
    scratch_.hits.resize(own);
    return contact;
  }

  bool descend(const SimdNode& node, std::size_t first, std::size_t last) {
    if (first == last) return false;
    for (int i = 0; i < node.childCount; ++i) {
      const SimdNode& child = model_.nodes[node.firstChild + i];
      if (visit(child, placed(child), first, last)) return true;
    }
    return false;
  }

  /// Adds the hits that the node's children must test. True: the walk is over.
  bool sift(const SimdNode& node, const Segment& segment, std::size_t first, std::size_t last) {
    const F8 plain = inflated(node);
    F8 radius = plain;
    F8 squared = radius * radius;
    const bool isRoot =
        node.geometry >= 0 && &node == &model_.nodes[model_.rootOfGeometry[node.geometry]];
    const bool divides = node.childCount > 0 && (node.geometry < 0 || node.beyond > enough_);
    for (std::size_t i = first; i < last; ++i) {
      SimdHit hit = scratch_.hits[i];
      hit.lanes &= ~block_.contactLanes;
      std::int32_t pair = 0;
      if (node.geometry >= 0) {
        pair = model_.pairOf[node.geometry * model_.obstacles.obstacles.size() + hit.index];
        if (pair < 0) continue;
        hit.lanes &= ~static_cast<Lanes>(block_.openLanes[pair]);
      }
      if (hit.lanes == 0) continue;
      if (padded_) {
        radius = plain + set(extraOf(node, hit.index, pair));
        squared = radius * radius;
      }
      const SimdObstacle& obstacle = model_.obstacles.obstacles[hit.index];
      if (obstacle.kind == ObstacleKind::Field) {
        if (isRoot && probes_ && block_.stopAtContact &&
            probeField(node, segment.x, hit, static_cast<std::uint32_t>(pair)))
          return true;
        if (fields_.visit(node, segment, radius, hit, static_cast<std::uint32_t>(pair), divides,
                          node.beyond > enough_))
          return true;
        continue;
      }
      hit.lanes &= ~above(squaredDistance(model_.obstacles, obstacle, segment), squared);
      if (hit.lanes == 0) continue;
      if (isRoot && probes_ && block_.stopAtContact &&
          probe(node, segment.x, hit, static_cast<std::uint32_t>(pair)))
        return true;
      if (node.inside > 0.0F && touches(node, segment, hit, static_cast<std::uint32_t>(pair)))
        return true;
      hit.lanes &= ~block_.contactLanes;
      if (hit.lanes == 0) continue;
      if (divides) {
        scratch_.hits.push_back(hit);
      } else {
        const F8 away = root(squaredDistance(model_.obstacles, obstacle, segment.x));
        markUnresolved(block_, static_cast<std::uint32_t>(pair), hit.lanes, node.beyond > enough_,
                       set(node.radius - 0.5F * node.beyond) - away);
      }
    }
    return false;
  }

  /// m, rounded up: what the pair keeps beyond the margin of all pairs, or what any pair of the
  /// obstacle keeps if the node has several pieces of geometry.
  float extraOf(const SimdNode& node, std::int32_t obstacle, std::int32_t pair) const {
    const float extra = node.geometry >= 0 ? model_.extras[pair] : model_.obstacleExtras[obstacle];
    return extra * kExtraOutward;
  }

  /// Tests balls inside the link, in the lane in which it is deepest in the obstacle.
  bool probe(const SimdNode& node, const V3& middle, const SimdHit& hit, std::uint32_t pair) {
    const SimdObstacle& obstacle = model_.obstacles.obstacles[hit.index];
    if (obstacle.kind == ObstacleKind::Field) return probeField(node, middle, hit, pair);
    if (obstacle.near != NearProof::Inside && obstacle.near != NearProof::Distance) return false;
    const F8 squared = squaredDistance(model_.obstacles, obstacle, middle);
    const float near = kProbeShare * node.radius;
    const Lanes lanes = hit.lanes & below(squared, set(near * near));
    if (lanes == 0) return false;
    const float within = node.inside - scratch_.rounding;
    if (within > 0.0F) {
      const Lanes touching = lanes & below(squared, set(nearSquared(obstacle, within)));
      if (touching != 0) return claim(block_, pair, touching, middle, within);
    }
    const int best = lowestLane(squared, lanes);
    const SimdModel::InnerBalls& probes = model_.probesOf[node.geometry];
    for (std::int32_t i = probes.first; i < probes.first + probes.count; ++i) {
      const SimdModel::Probes& eight = model_.probes[i];
      const V3 x = placedAt(*state_, best, eight);
      const F8 inside = load(eight.inside) - set(scratch_.rounding);
      const F8 away = squaredDistance(model_.obstacles, obstacle, x);
      const Lanes found = obstacle.near == NearProof::Inside
                              ? below(away, set(kZeroSquared))
                              : below(away, set(kMeeting) * inside * inside);
      if (found == 0) continue;
      const int which = std::countr_zero(found);
      Row at[3];
      Row radii;
      store3(x, at);
      store(inside, radii);
      const float point[3] = {at[0].lane[which], at[1].lane[which], at[2].lane[which]};
      if (!(radii.lane[which] > 0.0F)) continue;
      return claim(block_, pair, 1U << best, set3(point), radii.lane[which]);
    }
    return false;
  }

  bool probeField(const SimdNode& node, const V3& middle, const SimdHit& hit, std::uint32_t pair) {
    return fields_.probe(node, middle, kProbeShare * node.radius, *state_, hit, pair);
  }

  /// At a middle, the centre is so near that the obstacle reaches into the link.
  bool touches(const SimdNode& node, const Segment& segment, const SimdHit& hit,
               std::uint32_t pair) {
    if (!block_.stopAtContact) return false;
    const SimdObstacle& obstacle = model_.obstacles.obstacles[hit.index];
    const float within = node.inside - scratch_.rounding;
    if (!(within > 0.0F) || obstacle.near == NearProof::None) return false;
    const F8 squared = squaredDistance(model_.obstacles, obstacle, segment.x);
    const Lanes lanes = hit.lanes & below(squared, set(nearSquared(obstacle, within)));
    return lanes != 0 && claim(block_, pair, lanes, segment.x, within);
  }

  /// m^2. A point whose squared distance is below is known to be that near to the obstacle.
  static float nearSquared(const SimdObstacle& obstacle, float within) {
    return obstacle.near == NearProof::Distance ? kMeeting * within * within : kZeroSquared;
  }

  /// Enough for trees of 8^9 boxes: each level leaves at most seven siblings to visit.
  static constexpr int kMostPending = 64;

  const SimdModel& model_;
  SimdScratch& scratch_;
  SimdBlock& block_;
  FieldWalk fields_;
  const F8 half_;
  const bool moving_;
  const bool padded_;   ///< margins differ
  bool probes_ = true;  ///< balls inside the links are tested on the way
  const bool inTube_;
  const SimdBodyState* state_ = nullptr;
  F8 extra_;
  float enough_ = 0.0F;
};

bool Look(const SimdModel& model, SimdScratch& scratch) {
  return WorldWalk(model, scratch).look();
}

bool Bodies(const SimdModel& model, SimdScratch& scratch) {
  return WorldWalk(model, scratch).bodies();
}

bool Pairs(const SimdModel& model, int geometry, std::span<const SimdHit> obstacles, bool looked,
           SimdScratch& scratch) {
  return WorldWalk(model, scratch).pairs(geometry, obstacles, looked);
}

bool LookAtPairs(const SimdModel& model, int geometry, std::span<const SimdHit> obstacles,
                 SimdScratch& scratch) {
  return WorldWalk(model, scratch).lookAtPairs(geometry, obstacles);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(Look);
SWEPT_DISPATCH_TABLE(Bodies);
SWEPT_DISPATCH_TABLE(Pairs);
SWEPT_DISPATCH_TABLE(LookAtPairs);

bool lookAtWorld(const SimdModel& model, SimdScratch& scratch) {
  return SWEPT_DISPATCH(Look)(model, scratch);
}

bool walkWorld(const SimdModel& model, SimdScratch& scratch) {
  return SWEPT_DISPATCH(Bodies)(model, scratch);
}

bool walkPairs(const SimdModel& model, int geometry, std::span<const SimdHit> obstacles,
               SimdScratch& scratch, bool looked) {
  return SWEPT_DISPATCH(Pairs)(model, geometry, obstacles, looked, scratch);
}

bool lookAtPairs(const SimdModel& model, int geometry, std::span<const SimdHit> obstacles,
                 SimdScratch& scratch) {
  return SWEPT_DISPATCH(LookAtPairs)(model, geometry, obstacles, scratch);
}

}  // namespace swept::detail
#endif
