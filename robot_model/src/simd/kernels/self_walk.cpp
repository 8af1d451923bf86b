// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/self_walk.hpp"

#include "rounding/error_model.hpp"
#include "simd/kernels/state_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels/self_walk.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/kernels/f8.hpp"
#include "simd/kernels/placed_ball.hpp"
#include "simd/kernels/self_contacts.hpp"
#include "simd/kernels/self_tables.hpp"
#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

class SelfWalk {
 public:
  SelfWalk(const SimdModel& model, SimdScratch& scratch)
      : model_(model),
        scratch_(scratch),
        block_(scratch.block),
        tables_(model, scratch),
        contacts_(model, scratch, states_),
        half_(load(scratch.block.half)),
        moving_(scratch.block.mode == SimdMode::Motion) {}

  /// The root balls of all pairs, and balls inside the links, before the rest of their covers.
  bool all() {
    scratch_.selfVisits.clear();
    first_ = true;
    for (std::size_t i = 0; i < model_.bodyPairs.size(); ++i) {
      const SimdBodyPair& bodies = model_.bodyPairs[i];
      bodyPair_ = static_cast<int>(i);
      Lanes lanes = kAllLanes;
      if (bodies.table != nullptr && scratch_.withinLimits) {
        const PairSeparationTable& table = *bodies.table;
        lanes ^= tables_.proven(table);
        if (lanes == 0) continue;
        start(bodies);
        if (tables_.meets(table, states_, contacts_, lanes)) return true;
        lanes &= ~block_.contactLanes;
        // If the table knows no proof, covers have none either.
        lanes = tables_.markUnresolvedOf(table, lanes);
        if (lanes == 0) continue;
      }
      start(bodies);
      if (visit(model_.nodes[model_.rootOfBody[bodies.bodyA]], rootOf(bodies.bodyA),
                model_.nodes[model_.rootOfBody[bodies.bodyB]], rootOf(bodies.bodyB), lanes))
        return true;
    }
    first_ = false;
    for (const SimdScratch::SelfVisit& later : scratch_.selfVisits) {
      const SimdBodyPair& bodies = model_.bodyPairs[later.bodyPair];
      start(bodies);
      const SimdNode& a = model_.nodes[later.nodeA];
      const SimdNode& b = model_.nodes[later.nodeB];
      if (visit(a, placed(a, *states_.a), b, placed(b, *states_.b), later.lanes)) return true;
    }
    return false;
  }

  bool one(std::uint32_t pair, Lanes lanes) {
    const SimdPairSource& source = model_.sources[pair];
    start(model_.bodyPairs[source.bodyPair]);
    const SimdNode& a = model_.nodes[model_.rootOfGeometry[source.geometry]];
    const SimdNode& b = model_.nodes[model_.rootOfGeometry[source.other]];
    return visit(a, placed(a, *states_.a), b, placed(b, *states_.b), lanes);
  }

 private:
  void start(const SimdBodyPair& bodies) {
    const SimdReference& reference = model_.references[bodies.reference];
    const SimdBounds& bounds = scratch_.bounds[bodies.reference];
    looks_ = kMostLooks;
    states_.a = &block_.states[bodies.bodyA];
    states_.b = &block_.states[bodies.bodyB];
    turning_ = moving_ && reference.body != 0;
    if (turning_) angular_ = half_ * load3(block_.states[reference.body].angular);
    // Both balls' positions are rounded.
    tube_ = bodies.tube;
    extra_ = set(2.0F * scratch_.rounding + (model_.margin + bodies.extra) * kMarginOutward);
    if (moving_)
      extra_ = extra_ + inflation(half_, accelerationOf(reference, bounds, bodies.bodyA) +
                                             accelerationOf(reference, bounds, bodies.bodyB));
  }

  Segment rootOf(int body) const { return segmentOf(block_.roots[body], moving_ && body != 0); }

  HWY_INLINE Segment placed(const SimdNode& node, const SimdBodyState& state) const {
    return segmentOf(node, state, half_, moving_);
  }

  HWY_INLINE Lanes notApart(const SimdNode& a, const Segment& atA, const SimdNode& b,
                            const Segment& atB) const {
    const V3 between = atB.x - atA.x;
    V3 by = atB.g - atA.g;
    if (turning_) by = addCross(by, between, angular_);  // - angular x between
    const F8 radius = (set(a.radius + b.radius) + extra_) * set(kPairOutward);
    return ~above(nearestSquared(between, by), radius * radius) & kAllLanes;
  }

  bool visit(const SimdNode& a, const Segment& atA, const SimdNode& b, const Segment& atB,
             Lanes lanes) {
    lanes &= notApart(a, atA, b, atB) & ~block_.contactLanes;
    if (lanes == 0) return false;
    const bool known = a.geometry >= 0 && b.geometry >= 0;
    if (known) {
      const std::int32_t pair =
          model_.pairOfGeometries[a.geometry * model_.geometryBody.size() + b.geometry];
      if (pair < 0) return false;
      if (pair_ != static_cast<std::uint32_t>(pair)) looks_ = kMostLooks;
      pair_ = static_cast<std::uint32_t>(pair);
      lanes &= ~static_cast<Lanes>(block_.openLanes[pair_]);
      if (lanes == 0) return false;
      if (first_) {
        if (contacts_.probe(pair_, a, atA, b, atB, lanes)) return true;
        scratch_.selfVisits.push_back({bodyPair_, indexOf(a), indexOf(b), lanes});
        return false;
      }
      if (a.inside > 0.0F && b.inside > 0.0F &&
          contacts_.touches(pair_, a.inside, atA.x, b.inside, atB.x, lanes))
        return true;
      lanes &= ~block_.contactLanes;
      if (lanes == 0) return false;
    }
    const bool splitA = splitsFirst(a, b);
    const SimdNode& parent = splitA ? a : b;
    const bool coarse = a.beyond + b.beyond > 0.5F * (largestLane(extra_) - tube_);
    if (known && (!coarse || parent.childCount == 0 || --looks_ < 0)) {
      const V3 between = atB.x - atA.x;
      const float reach = a.radius + b.radius - 0.5F * (a.beyond + b.beyond);
      markUnresolved(block_, pair_, lanes, coarse, set(reach) - root(dot(between, between)));
      return false;
    }
    for (int i = 0; i < parent.childCount; ++i) {
      const SimdNode& child = model_.nodes[parent.firstChild + i];
      const bool contact = splitA ? visit(child, placed(child, *states_.a), b, atB, lanes)
                                  : visit(a, atA, child, placed(child, *states_.b), lanes);
      if (contact) return true;
    }
    return false;
  }

  std::int32_t indexOf(const SimdNode& node) const {
    return static_cast<std::int32_t>(&node - model_.nodes.data());
  }

  const SimdModel& model_;
  SimdScratch& scratch_;
  SimdBlock& block_;
  const SelfTables tables_;
  SelfContacts contacts_;
  const F8 half_;
  const bool moving_;
  LinkStates states_;
  bool turning_ = false;
  V3 angular_;          ///< of the reference, times the half width
  F8 extra_;            ///< m, what balls must keep
  float tube_ = 0.0F;   ///< m, the part of it that shorter intervals do not change
  bool first_ = false;  ///< only the root balls of two links
  int bodyPair_ = 0;
  std::uint32_t pair_ = 0;
  int looks_ = 0;
};

bool All(const SimdModel& model, SimdScratch& scratch) {
  return SelfWalk(model, scratch).all();
}

bool One(const SimdModel& model, std::uint32_t pair, std::uint32_t lanes, SimdScratch& scratch) {
  return SelfWalk(model, scratch).one(pair, lanes);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(All);
SWEPT_DISPATCH_TABLE(One);

bool walkSelf(const SimdModel& model, SimdScratch& scratch) {
  if (scratch.block.mode == SimdMode::State) return walkState(model, scratch);
  return SWEPT_DISPATCH(All)(model, scratch);
}

bool walkPair(const SimdModel& model, std::uint32_t pair, std::uint32_t lanes,
              SimdScratch& scratch) {
  return SWEPT_DISPATCH(One)(model, pair, lanes, scratch);
}

}  // namespace swept::detail
#endif
