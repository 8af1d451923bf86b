// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/hull_planes.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels/hull_planes.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rounding/error_model.hpp"
#include "simd/kernels/f8.hpp"
#include "simd/kernels/placed_ball.hpp"
#include "simd/kernels/simd_bounds.hpp"
#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

/// Velocity field linear + angular x p, relative to the reference, times half the interval.
struct HalfMotion {
  V3 linear;   ///< m
  V3 angular;  ///< rad
};

/// What one joint's error does to points of a body, along a direction: |along . p + shift| is how
/// far it moves the point p of the body's frame at most, to first order.
struct JointError {
  V3 along;  ///< m per m
  F8 shift;  ///< m
};

/// Of the joints between a body and the reference.
struct JointErrors {
  static constexpr int kMost = 12;
  JointError of[kMost];
  int count = 0;
};

/// m, at most, to first order.
HWY_INLINE F8 movedBy(const JointErrors& errors, const F8& x, const F8& y, const F8& z) {
  F8 sum = set(0.0F);
  for (int i = 0; i < errors.count; ++i) {
    const JointError& own = errors.of[i];
    sum = sum +
          absolute(multiplyAdd(
              own.along.x, x, multiplyAdd(own.along.y, y, multiplyAdd(own.along.z, z, own.shift))));
  }
  return sum;
}

/// How far a hull reaches along a direction at both ends of the interval, if its points moved
/// straight.
struct Reach {
  F8 before;  ///< m
  F8 after;
};

/// Lemma: n . (x_p + s g_p) is affine in the point p and in s. So over a hull of points and |s| <=
/// 1 it is largest at a point and at s = -1 or 1. For a ball of radius r around each point it is
/// larger by at most r |c|, with c the coefficients of p. Errors of joints add what is convex in p.
HWY_INLINE Reach reachOf(const SimdHulls& hulls, const SimdHull& hull, const V3& n,
                         const SimdBodyState& state, const HalfMotion& motion,
                         const JointErrors& errors) {
  const V3 w = cross(n, motion.angular);
  const V3 origin = load3(state.origin);
  const V3 still = turnedBack(state.rotation, n);
  const V3 swept = turnedBack(state.rotation, w);
  const V3 first = still - swept;
  const V3 last = still + swept;
  F8 before = set(-1e30F);
  F8 after = before;
  for (int i = 0; i < hull.count; ++i) {
    const SimdHulls::Points& eight = hulls.points[hull.first + i / kLanes];
    const F8 x = set(eight.x.lane[i % kLanes]);
    const F8 y = set(eight.y.lane[i % kLanes]);
    const F8 z = set(eight.z.lane[i % kLanes]);
    const F8 atFirst = multiplyAdd(first.x, x, multiplyAdd(first.y, y, first.z * z));
    const F8 atLast = multiplyAdd(last.x, x, multiplyAdd(last.y, y, last.z * z));
    const F8 moved = movedBy(errors, x, y, z);
    before = larger(before, atFirst + moved);
    after = larger(after, atLast + moved);
  }
  Reach reach;
  const F8 offset = dot(n, origin);
  const F8 shift = dot(n, motion.linear) + dot(w, origin);
  reach.before = before + (offset - shift);
  reach.after = after + (offset + shift);
  if (hull.radius > 0.0F) {
    F8 share = set(1.0F) + root(dot(swept, swept));
    for (int i = 0; i < errors.count; ++i)
      share = share + root(dot(errors.of[i].along, errors.of[i].along));
    const F8 grown = set(hull.radius * kExtraOutward) * share;
    reach.before = reach.before + grown;
    reach.after = reach.after + grown;
  }
  return reach;
}

/// How far an obstacle reaches along n, at most: its support function, and what single precision
/// takes of it (L11 of ERROR_MODEL.md).
F8 reachOf(const SimdBox& box, const V3& n) {
  F8 sum = set(0.0F);
  for (int i = 0; i < 3; ++i) {
    const F8 share = dot(n, set3(box.axes[i]));
    const float sizes = std::abs(box.offset[i]) + box.half[i];
    sum = subtractProduct(sum, share, set(box.offset[i]));
    sum = multiplyAdd(absolute(share), set(box.half[i]), sum) + set(kSupportShare * sizes);
  }
  return sum;
}

F8 reachOf(const SimdRound& round, ObstacleKind kind, const V3& n) {
  const F8 along = absolute(dot(n, set3(round.axis)));
  const float far = std::abs(round.center[0]) + std::abs(round.center[1]) +
                    std::abs(round.center[2]) + round.halfLength + round.radius;
  F8 reach = multiplyAdd(along, set(round.halfLength), dot(n, set3(round.center)));
  F8 across = set(round.radius);
  if (kind == ObstacleKind::Cylinder)
    across = across * root(larger(set(1.0F) - along * along, set(0.0F)) + set(kSupportShare));
  return reach + across + set(2.0F * kSupportShare * far);
}

F8 reachOf(const SimdObstacles& obstacles, const SimdObstacle& obstacle, const V3& n) {
  if (obstacle.kind == ObstacleKind::Box) return reachOf(obstacles.boxes[obstacle.first], n);
  return reachOf(obstacles.rounds[obstacle.first], obstacle.kind, n);
}

/// From a point to the nearest one of a box, or of a round obstacle's axis, less the radius.
V3 towardsObstacle(const SimdBox& box, const V3& x) {
  V3 towards = set3({0.0F, 0.0F, 0.0F});
  for (int i = 0; i < 3; ++i) {
    const V3 axis = set3(box.axes[i]);
    const F8 at = dot(axis, x) + set(box.offset[i]);
    const F8 half = set(box.half[i]);
    towards = along(towards, smaller(larger(at, -half), half) - at, axis);
  }
  return towards;
}

V3 towardsObstacle(const SimdRound& round, const V3& x) {
  const V3 axis = set3(round.axis);
  const V3 away = x - set3(round.center);
  const F8 half = set(round.halfLength);
  const F8 nearest = smaller(larger(dot(axis, away), -half), half);
  const V3 towards = along(set(-1.0F) * away, nearest, axis);
  const F8 length = root(larger(dot(towards, towards), set(1e-20F)));
  return (larger(length - set(round.radius), set(0.0F)) / length) * towards;
}

V3 towardsObstacle(const SimdObstacles& obstacles, const SimdObstacle& obstacle, const V3& x) {
  if (obstacle.kind == ObstacleKind::Box)
    return towardsObstacle(obstacles.boxes[obstacle.first], x);
  return towardsObstacle(obstacles.rounds[obstacle.first], x);
}

/// A pair in the lanes of the block.
class DividedPair {
 public:
  DividedPair(const SimdModel& model, std::uint32_t pair, SimdScratch& scratch)
      : model_(model),
        block_(scratch.block),
        source_(model.sources[pair]),
        self_(source_.obstacle < 0),
        half_(load(block_.half)),
        bodyA_(model.geometryBody[source_.geometry]) {
    if (self_) bodyB_ = model.geometryBody[source_.other];
    reference_ = self_ ? model.bodyPairs[source_.bodyPair].reference : 0;
    float acceleration = accelerationOfPoints(model, reference_, source_.geometry, scratch);
    if (self_) acceleration += accelerationOfPoints(model, reference_, source_.other, scratch);
    // Two rounded positions, and as much again for the computations here.
    const float margin = (model.margin + model.extraOf(pair) + model.tubeOf(pair)) * kMarginOutward;
    required_ = (set(4.0F * scratch.rounding + margin) + inflation(half_, acceleration)) *
                set(kPairOutward);
    if (!model.tubes.empty()) requireInTube(pair, scratch);
  }

  /// Planes orthogonal to a direction that is fixed in the frame of the first body, then of the
  /// other.
  Lanes divide(const float (&towards)[3], int lane, Lanes lanes) const {
    const V3 n = set3(towards);
    Lanes apart = divideAcross(turnedWith(bodyA_, n, lane), lanes);
    if (apart != lanes) apart |= divideAcross(turnedWith(bodyB_, n, lane), lanes & ~apart);
    return apart;
  }

  /// Planes across the ways from points of the hull to the obstacle.
  Lanes divideOutward(Lanes lanes) const {
    const SimdObstacle& obstacle = model_.obstacles.obstacles[source_.obstacle];
    const SimdBodyState& state = block_.states[bodyA_];
    V3 x = place(model_.nodes[model_.rootOfGeometry[source_.geometry]], state);
    Lanes apart = 0;
    for (int step = 0; step < kSteps; ++step) {
      const V3 way = towardsObstacle(model_.obstacles, obstacle, x);
      const V3 nearest = farthestAlong(way, state);
      // A plane through the hull's point leaves the obstacle on its other side, at rest.
      const Lanes seen = above(dot(way, x + way - nearest), set(0.0F)) & lanes & ~apart;
      if (seen != 0) apart |= divideAcross(way, seen);
      if (apart == lanes || step + 1 == kSteps) break;
      const V3 back = nearest - x;
      const F8 share = dot(way, back) / larger(dot(back, back), set(1e-20F));
      x = along(x, smaller(larger(share, set(0.0F)), set(1.0F)), back);
    }
    return apart;
  }

 private:
  /// Most planes to try.
  static constexpr int kSteps = 6;

  /// Of the hull's points, the one that is farthest along a direction at the middle.
  V3 farthestAlong(const V3& direction, const SimdBodyState& state) const {
    const SimdHulls& hulls = *model_.hulls;
    const SimdHull& hull = hulls.of[source_.geometry];
    const V3 n = turnedBack(state.rotation, direction);
    F8 most = set(-1e30F);
    V3 farthest = set3({0.0F, 0.0F, 0.0F});
    for (int i = 0; i < hull.count; ++i) {
      const SimdHulls::Points& eight = hulls.points[hull.first + i / kLanes];
      const V3 p = {set(eight.x.lane[i % kLanes]), set(eight.y.lane[i % kLanes]),
                    set(eight.z.lane[i % kLanes])};
      const F8 at = dot(n, p);
      for (int k = 0; k < kParts; ++k) {
        const auto more = hn::Gt(at.part[k], most.part[k]);
        most.part[k] = hn::IfThenElse(more, at.part[k], most.part[k]);
        farthest.x.part[k] = hn::IfThenElse(more, p.x.part[k], farthest.x.part[k]);
        farthest.y.part[k] = hn::IfThenElse(more, p.y.part[k], farthest.y.part[k]);
        farthest.z.part[k] = hn::IfThenElse(more, p.z.part[k], farthest.z.part[k]);
      }
    }
    return addRotated(load3(state.origin), state.rotation, farthest);
  }

  Lanes divideAcross(const V3& direction, Lanes lanes) const {
    const V3 n = (set(1.0F) / root(larger(dot(direction, direction), set(1e-20F)))) * direction;
    JointErrors none;  // count alone is set
    Lanes apart = lanes & above(gap(n, none, none), required_);
    if (apart != lanes && errsByTurns_)
      apart |= lanes & above(gap(n, errorsOf(bodyA_, n), errorsOf(bodyB_, n)), requiredInTube_);
    return apart;
  }

  /// The joints of a body's path that are between it and the reference.
  std::span<const int> joints(int body) const {
    const std::vector<int>& path = model_.ancestors[body];
    const std::size_t before = model_.ancestors[model_.references[reference_].body].size();
    return std::span(path).subspan(std::min(before, path.size()));
  }

  /// By L18 of ERROR_MODEL.md, with the errors along n left to the gap.
  void requireInTube(std::uint32_t pair, SimdScratch& scratch) {
    float turns = 0.0F;  // rad
    errsByTurns_ = true;
    for (const int body : {bodyA_, bodyB_}) {
      int count = 0;
      for (const int joint : joints(body)) {
        errsByTurns_ = errsByTurns_ && model_.errsByTurns[joint] != 0;
        count += model_.tubeTurn[joint] > 0.0F ? 1 : 0;
        turns += model_.tubeTurn[joint];
      }
      errsByTurns_ = errsByTurns_ && count <= JointErrors::kMost;
    }
    if (!errsByTurns_) return;
    const float half = *std::ranges::max_element(block_.half.lane);
    float beyond = tubeAccelerationOfPoints(model_, reference_, source_.geometry, half, scratch);
    if (self_) beyond += tubeAccelerationOfPoints(model_, reference_, source_.other, half, scratch);
    const float margin = (model_.margin + model_.extraOf(pair)) * kMarginOutward;
    // Four for each error's arm, which is made of two positions and an axis, and as much again.
    const float rounding = (4.0F + 8.0F * turns) * scratch.rounding;
    requiredInTube_ = set((rounding + margin + 0.5F * beyond) * kPairOutward);
  }

  JointErrors errorsOf(int body, const V3& n) const {
    JointErrors errors;
    const SimdBodyState& own = block_.states[body];
    for (const int joint : joints(body)) {
      const float turn = model_.tubeTurn[joint];
      if (turn == 0.0F) continue;
      const SimdBodyState& at = block_.states[joint];
      const V3 axis = {load(at.rotation[2]), load(at.rotation[5]), load(at.rotation[8])};
      const V3 moved = set(turn) * cross(n, axis);
      errors.of[errors.count++] = {turnedBack(own.rotation, moved),
                                   dot(moved, load3(own.origin) - load3(at.origin))};
    }
    return errors;
  }

  /// The direction of one lane in the other lanes, as the body turns.
  V3 turnedWith(int body, const V3& n, int lane) const {
    if (body == 0) return n;
    const SimdBodyState& state = block_.states[body];
    Row local[3];
    store3(turnedBack(state.rotation, n), local);
    const float there[3] = {local[0].lane[lane], local[1].lane[lane], local[2].lane[lane]};
    return addRotated(set3({0.0F, 0.0F, 0.0F}), state.rotation, set3(there));
  }

  HalfMotion motionOf(int body) const {
    const SimdBodyState& own = block_.states[body];
    const SimdBodyState& base = block_.states[model_.references[reference_].body];
    return {half_ * (load3(own.linear) - load3(base.linear)),
            half_ * (load3(own.angular) - load3(base.angular))};
  }

  /// m, along a unit vector. Lemma: the bodies' points are at x + s g + w, with |w| within what
  /// `required_` counts, and what the errors add. n . (x + s g) of the one is below that of the
  /// other by the gap for s = -1 and s = 1, so between them too: the maximum over a body is convex
  /// in s.
  F8 gap(const V3& n, const JointErrors& errorsA, const JointErrors& errorsB) const {
    const Reach ofA = reachOf(*model_.hulls, model_.hulls->of[source_.geometry], n,
                              block_.states[bodyA_], motionOf(bodyA_), errorsA);
    const V3 back = {-n.x, -n.y, -n.z};
    if (!self_) {
      const SimdObstacle& obstacle = model_.obstacles.obstacles[source_.obstacle];
      return -(larger(ofA.before, ofA.after) + reachOf(model_.obstacles, obstacle, back));
    }
    const Reach ofB = reachOf(*model_.hulls, model_.hulls->of[source_.other], back,
                              block_.states[bodyB_], motionOf(bodyB_), errorsB);
    return -larger(ofA.before + ofB.before, ofA.after + ofB.after);
  }

  const SimdModel& model_;
  const SimdBlock& block_;
  const SimdPairSource& source_;
  const bool self_;
  const F8 half_;
  int bodyA_;
  int bodyB_ = 0;
  int reference_ = 0;
  F8 required_;
  bool errsByTurns_ = false;  ///< so do all joints between the two: errors are known along n
  F8 requiredInTube_;
};

std::uint32_t Divide(const SimdModel& model, std::uint32_t pair, const SimdDirection& direction,
                     std::uint32_t lanes, SimdScratch& scratch) {
  return DividedPair(model, pair, scratch).divide(direction.towards, direction.lane, lanes);
}

std::uint32_t Outward(const SimdModel& model, std::uint32_t pair, std::uint32_t lanes,
                      SimdScratch& scratch) {
  return DividedPair(model, pair, scratch).divideOutward(lanes);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(Divide);
SWEPT_DISPATCH_TABLE(Outward);

bool canDivide(const SimdModel& model, std::uint32_t pair) {
  const SimdPairSource& source = model.sources[pair];
  if (model.hulls->of[source.geometry].count == 0) return false;
  if (source.obstacle < 0) return model.hulls->of[source.other].count > 0;
  const ObstacleKind kind = model.obstacles.obstacles[source.obstacle].kind;
  return kind == ObstacleKind::Box || kind == ObstacleKind::Ball || kind == ObstacleKind::Capsule ||
         kind == ObstacleKind::Cylinder;
}

std::uint32_t lanesDivided(const SimdModel& model, std::uint32_t pair,
                           const SimdDirection& direction, std::uint32_t lanes,
                           SimdScratch& scratch) {
  return SWEPT_DISPATCH(Divide)(model, pair, direction, lanes, scratch);
}

std::uint32_t lanesOutward(const SimdModel& model, std::uint32_t pair, std::uint32_t lanes,
                           SimdScratch& scratch) {
  return SWEPT_DISPATCH(Outward)(model, pair, lanes, scratch);
}

}  // namespace swept::detail
#endif
