// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/world_walk.hpp"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/world_walk.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lanes/f8.hpp"
#include "lanes/obstacle_kernels.hpp"
#include "lanes/placed_ball.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

class WorldWalk {
 public:
  WorldWalk(const LaneModel& model, LaneScratch& scratch)
      : model_(model),
        scratch_(scratch),
        block_(scratch.block),
        half_(load(scratch.block.half)),
        moving_(scratch.block.mode == LaneMode::Motion) {}

  bool bodies() {
    scratch_.queries.clear();
    for (const int body : model_.worldBodies) {
      start(body);
      const LaneNode& root = model_.nodes[model_.rootOfBody[body]];
      const LaneRoot& ball = block_.roots[body];
      const Segment segment = {load3(ball.at), moving_ ? load3(ball.by) : set3({0.0F, 0.0F, 0.0F})};
      scratch_.hits.clear();
      cull(segment, inflated(root));
      if (scratch_.hits.empty()) continue;
      if (visit(root, segment, 0)) return true;
    }
    settleQueries();
    return false;
  }

  bool pairs(int geometry, std::span<const LaneHit> obstacles) {
    scratch_.queries.clear();
    start(model_.geometryBody[geometry]);
    const LaneNode& root = model_.nodes[model_.rootOfGeometry[geometry]];
    scratch_.hits.assign(obstacles.begin(), obstacles.end());
    if (visit(root, placed(root), 0)) return true;
    settleQueries();
    return false;
  }

 private:
  void start(int body) {
    state_ = &block_.states[body];
    extra_ = set(scratch_.rounding + model_.margin);
    if (moving_)
      extra_ =
          extra_ + inflation(half_, accelerationOf(model_.references[0], scratch_.bounds[0], body));
    // Balls this close to the link are not worth another look before the interval is halved.
    enough_ = 0.5F * largestLane(extra_);
  }

  HWY_INLINE Segment placed(const LaneNode& node) const {
    const V3 x = place(node, *state_);
    if (!moving_) return {x, set3({0.0F, 0.0F, 0.0F})};
    return {x, half_ * addCross(load3(state_->linear), load3(state_->angular), x)};
  }

  /// m; more than what rounding of squares and roots takes away.
  HWY_INLINE F8 inflated(const LaneNode& node) const {
    return (set(node.radius) + extra_) * set(1.0F + 2e-6F);
  }

  /// Obstacles whose boxes meet the box around all lanes.
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
      const LaneWorldNode& node = nodes[stack[--pending]];
      const Lanes apart = above(load(node.lower[0]), to.x) | above(load(node.lower[1]), to.y) |
                          above(load(node.lower[2]), to.z) | below(load(node.upper[0]), from.x) |
                          below(load(node.upper[1]), from.y) | below(load(node.upper[2]), from.z);
      for (Lanes left = ~apart & kAllLanes; left != 0; left &= left - 1) {
        const std::int32_t child = node.child[std::countr_zero(left)];
        if (child < 0) {
          scratch_.hits.push_back({~child, kAllLanes});
        } else {
          stack[pending++] = child;
        }
      }
    }
  }

  /// The hits from `first` on are what the node's parent is not proven apart from.
  bool visit(const LaneNode& node, const Segment& segment, std::size_t first) {
    const F8 radius = inflated(node);
    const F8 squared = radius * radius;
    const std::size_t last = scratch_.hits.size();
    const bool descend = node.childCount > 0 && (node.geometry < 0 || node.beyond > enough_);
    for (std::size_t i = first; i < last; ++i) {
      LaneHit hit = scratch_.hits[i];
      hit.lanes &= ~block_.contactLanes;
      std::int32_t pair = 0;
      if (node.geometry >= 0) {
        pair = model_.pairOf[node.geometry * model_.obstacles.obstacles.size() + hit.index];
        if (pair < 0) continue;
        hit.lanes &= ~static_cast<Lanes>(block_.openLanes[pair]);
      }
      if (hit.lanes == 0) continue;
      const LaneObstacle& obstacle = model_.obstacles.obstacles[hit.index];
      if (obstacle.kind == ObstacleKind::Field) {
        if (visitField(node, segment, radius, hit, static_cast<std::uint32_t>(pair), descend))
          return true;
        continue;
      }
      hit.lanes &= ~above(squaredDistance(model_.obstacles, obstacle, segment), squared);
      if (hit.lanes == 0) continue;
      if (node.inside > 0.0F && touches(node, segment, hit, static_cast<std::uint32_t>(pair)))
        return true;
      hit.lanes &= ~block_.contactLanes;
      if (hit.lanes == 0) continue;
      if (descend) {
        scratch_.hits.push_back(hit);
      } else {
        const Segment middle = {segment.x, set3({0.0F, 0.0F, 0.0F})};
        const F8 away = root(squaredDistance(model_.obstacles, obstacle, middle));
        leaveOpen(block_, static_cast<std::uint32_t>(pair), hit.lanes, node.beyond > enough_,
                  set(node.radius - 0.5F * node.beyond) - away);
      }
    }
    bool contact = false;
    if (scratch_.hits.size() > last) {
      for (int i = 0; i < node.childCount && !contact; ++i) {
        const LaneNode& child = model_.nodes[node.firstChild + i];
        contact = visit(child, placed(child), last);
      }
    }
    scratch_.hits.resize(last);
    return contact;
  }

  /// The same of a field. Leaves that only a query can settle are put off: where something else is
  /// in contact, nobody needs to know.
  bool visitField(const LaneNode& node, const Segment& segment, const F8& radius, LaneHit hit,
                  std::uint32_t pair, bool descend) {
    const std::int32_t index = model_.obstacles.obstacles[hit.index].first;
    const LaneField& field = model_.obstacles.fields[index];
    const FieldAnswer answer = askField(field, segment, radius, hit.lanes);
    hit.lanes &= ~answer.apart;
    if (hit.lanes == 0) return false;
    if (node.inside > 0.0F && touchesField(node, segment, field, answer.middle, hit.lanes, pair))
      return true;
    hit.lanes &= ~block_.contactLanes;
    if (hit.lanes == 0) return false;
    if (descend) {
      scratch_.hits.push_back(hit);
      return false;
    }
    // A field tells up to about a cell less than there is.
    const F8 depths = set(node.radius - 0.5F * node.beyond - field.cell) - answer.middle;
    const bool final = node.beyond > enough_;
    if (scratch_.queries.size() < kMostQueries && (hit.lanes & ~answer.worthQuery) != hit.lanes) {
      LaneQuery& query = scratch_.queries.emplace_back();
      query.field = index;
      query.pair = pair;
      query.lanes = hit.lanes & answer.worthQuery;
      query.outside = above(answer.middle, set(0.0F));
      query.final = final;
      store3(segment.x, query.x);
      store3(segment.g, query.g);
      store(radius, query.radius);
      store(depths, query.depth);
      hit.lanes &= ~query.lanes;
    }
    if (hit.lanes != 0) leaveOpen(block_, pair, hit.lanes, final, depths);
    return false;
  }

  void settleQueries() {
    for (const LaneQuery& query : scratch_.queries) {
      Lanes left = query.lanes & ~block_.contactLanes;
      left &= ~static_cast<Lanes>(block_.openLanes[query.pair]);
      const LaneField& field = model_.obstacles.fields[query.field];
      // One that stays open leaves the pair open: the others are not worth the time.
      for (; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        const bool outside = (query.outside >> lane & 1U) != 0;
        if (!isApart(field, pointOf(query.x, query.g, lane), query.radius.lane[lane], outside))
          break;
      }
      if (left != 0) leaveOpen(block_, query.pair, left, query.final, load(query.depth));
    }
  }

  /// At a middle, the centre is so near that the obstacle reaches into the link.
  bool touches(const LaneNode& node, const Segment& segment, const LaneHit& hit,
               std::uint32_t pair) {
    if (!block_.stopAtContact) return false;
    const LaneObstacle& obstacle = model_.obstacles.obstacles[hit.index];
    const float within = node.inside - scratch_.rounding;
    if (!(within > 0.0F)) return false;
    const Lanes lanes = lanesNear(obstacle, segment, within, hit.lanes);
    return lanes != 0 && claim(block_, pair, lanes, segment.x, within);
  }

  /// Lanes in which the obstacle is known to reach within that distance of the middle.
  Lanes lanesNear(const LaneObstacle& obstacle, const Segment& segment, float within,
                  Lanes lanes) const {
    const Segment middle = {segment.x, set3({0.0F, 0.0F, 0.0F})};
    const float most = obstacle.near == NearProof::Distance ? 0.9F * within * within : 1e-30F;
    if (obstacle.near == NearProof::None) return 0;
    return lanes & below(squaredDistance(model_.obstacles, obstacle, middle), set(most));
  }

  /// The same of a field: the first lane that a query confirms. `bounds`: m, on the distance.
  bool touchesField(const LaneNode& node, const Segment& segment, const LaneField& field,
                    const F8& bounds, Lanes lanes, std::uint32_t pair) {
    if (!block_.stopAtContact) return false;
    const float within = node.inside - scratch_.rounding;
    if (!(within > 0.0F)) return false;
    const Lanes outside = above(bounds, set(0.0F));
    // Not sure, but a query costs less than what is left open.
    Lanes left = lanes & below(bounds, set(within - 0.25F * field.cell));
    if (left == 0) return false;
    Row x[3];
    store3(segment.x, x);
    const Row still[3] = {};
    for (; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      if (reaches(field, pointOf(x, still, lane), within, (outside >> lane & 1U) != 0))
        return claim(block_, pair, 1U << lane, segment.x, within);
    }
    return false;
  }

  static MovingPoint pointOf(const Row (&x)[3], const Row (&g)[3], int lane) {
    MovingPoint point;
    for (int i = 0; i < 3; ++i) {
      point.x[i] = x[i].lane[lane];
      point.g[i] = g[i].lane[lane];
    }
    return point;
  }

  /// Put off at most: the time of a query is that of several nodes.
  static constexpr std::size_t kMostQueries = 256;
  /// Enough for trees of 8^9 boxes: each level leaves at most seven siblings behind.
  static constexpr int kMostPending = 64;

  const LaneModel& model_;
  LaneScratch& scratch_;
  LaneBlock& block_;
  const F8 half_;
  const bool moving_;
  const LaneBodyState* state_ = nullptr;
  F8 extra_;
  float enough_ = 0.0F;
};

bool Bodies(const LaneModel& model, LaneScratch& scratch) {
  return WorldWalk(model, scratch).bodies();
}

bool Pairs(const LaneModel& model, int geometry, std::span<const LaneHit> obstacles,
           LaneScratch& scratch) {
  return WorldWalk(model, scratch).pairs(geometry, obstacles);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

HWY_EXPORT(Bodies);
HWY_EXPORT(Pairs);

bool walkWorld(const LaneModel& model, LaneScratch& scratch) {
  return HWY_DYNAMIC_DISPATCH(Bodies)(model, scratch);
}

bool walkPairs(const LaneModel& model, int geometry, std::span<const LaneHit> obstacles,
               LaneScratch& scratch) {
  return HWY_DYNAMIC_DISPATCH(Pairs)(model, geometry, obstacles, scratch);
}

}  // namespace swept::detail
#endif
