// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/state_walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "rounding/error_model.hpp"
#include "simd/kernels/self_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels/state_walk.cpp"  // compiled once for each instruction set
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

/// The lane of a block that is read.
constexpr Lanes kFirst = 1U;

class StateWalk {
 public:
  using BallPair = SimdScratch::BallPair;

  StateWalk(const SimdModel& model, SimdScratch& scratch)
      : model_(model),
        scratch_(scratch),
        block_(scratch.block),
        tables_(model, scratch),
        contacts_(model, scratch, states_) {}

  /// As SelfWalk::all.
  bool all() {
    scratch_.stateVisits.clear();
    gatherRoots();
    for (const SimdRootRow& row : model_.rootRows)
      if (roots(row)) return true;
    // Pairs whose root balls overlap most are in contact most often.
    std::ranges::sort(scratch_.stateVisits, {}, &SimdScratch::StateVisit::spread);
    std::size_t probed = 0;
    for (; probed < scratch_.stateVisits.size(); ++probed) {
      const SimdScratch::StateVisit& visit = scratch_.stateVisits[probed];
      if (visit.spread > kProbeSpread) break;
      start(visit.bodyPair);
      if (probe(visit)) return true;
    }
    for (std::size_t i = 0; i < scratch_.stateVisits.size(); ++i) {
      const SimdScratch::StateVisit& visit = scratch_.stateVisits[i];
      start(visit.bodyPair);
      pair_ = visit.pair;
      looks_ = kMostLooks;
      const Found found = deep(visit.balls);
      if (found == Found::Contact || (found == Found::Open && i >= probed && probe(visit)))
        return true;
    }
    return false;
  }

 private:
  /// Links with a larger value are hardly in contact: covers are tested first.
  static constexpr float kProbeSpread = 0.5625F;

  enum class Found : std::uint8_t { Apart, Open, Contact };

  void gatherRoots() {
    for (std::size_t body = 0; body < block_.roots.size(); ++body)
      for (int i = 0; i < 3; ++i)
        scratch_.rootsOfEight[body / kLanes].at[i].lane[body % kLanes] =
            block_.roots[body].at[i].lane[0];
  }

  void start(int bodyPair) {
    bodyPair_ = bodyPair;
    const SimdBodyPair& bodies = model_.bodyPairs[bodyPair];
    states_.a = &block_.states[bodies.bodyA];
    states_.b = &block_.states[bodies.bodyB];
    tube_ = bodies.tube;
    extra_ = 2.0F * scratch_.rounding + (model_.margin + bodies.extra) * kMarginOutward;
  }

  /// The pairs, among eight pairs of balls, that are not proven apart. Radii are sums; `keep` is
  /// added to them, rounding included.
  HWY_INLINE static Lanes notApart(const F8& squared, const F8& radii, const F8& keep) {
    const F8 radius = (radii + keep) * set(kPairOutward);
    return ~above(squared, radius * radius) & kAllLanes;
  }

  /// Eight pairs of bodies. True: the walk is over.
  HWY_INLINE bool roots(const SimdRootRow& row) {
    const Row(&ofA)[3] = block_.roots[row.body].at;
    const V3 a = load3(ofA);
    const V3 b = load3(scratch_.rootsOfEight[row.eight].at);
    const V3 between = b - a;
    const F8 squared = dot(between, between);
    const F8 keep = set(2.0F * scratch_.rounding) + load(row.keep);
    Lanes left = notApart(squared, load(row.radii), keep) & row.checked;
    if (left == 0) return false;
    Row squares;
    store(squared, squares);
    const SimdScratch::Roots& atB = scratch_.rootsOfEight[row.eight];
    for (; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const SimdBodyPair& bodies = model_.bodyPairs[row.pairs[lane]];
      const BallPair balls = {model_.rootOfBody[bodies.bodyA],
                              model_.rootOfBody[bodies.bodyB],
                              {ofA[0].lane[0], ofA[1].lane[0], ofA[2].lane[0]},
                              {atB.at[0].lane[lane], atB.at[1].lane[lane], atB.at[2].lane[lane]},
                              squares.lane[lane]};
      if (links(row.pairs[lane], balls)) return true;
    }
    return false;
  }

  /// Two bodies whose root balls are not proven apart.
  bool links(int bodyPair, const BallPair& balls) {
    const SimdBodyPair& bodies = model_.bodyPairs[bodyPair];
    start(bodyPair);
    if (bodies.table != nullptr && scratch_.withinLimits) {
      const PairSeparationTable& table = *bodies.table;
      if ((tables_.proven(table) & kFirst) != 0) return false;
      if (tables_.meets(table, states_, contacts_, kFirst)) return true;
      // If the table knows no proof, covers have none either.
      if (tables_.markUnresolvedOf(table, kFirst) == 0) return false;
    }
    return shallow(balls);
  }

  /// Down to the first ball of either link's geometry.
  bool shallow(const BallPair& balls) {
    const SimdNode& a = model_.nodes[balls.nodeA];
    const SimdNode& b = model_.nodes[balls.nodeB];
    if (a.geometry < 0 || b.geometry < 0)
      return split(balls, [this](const BallPair& children) {
               return shallow(children) ? Found::Contact : Found::Apart;
             }) == Found::Contact;
    const std::int32_t pair =
        model_.pairOfGeometries[a.geometry * model_.geometryBody.size() + b.geometry];
    if (pair < 0 || (block_.openLanes[pair] & kFirst) != 0) return false;
    const float radii = a.radius + b.radius;
    scratch_.stateVisits.push_back(
        {bodyPair_, static_cast<std::uint32_t>(pair), balls.squared / (radii * radii), balls});
    return false;
  }

  bool probe(const SimdScratch::StateVisit& visit) {
    return block_.stopAtContact &&
           contacts_.probe(visit.pair, model_.nodes[visit.balls.nodeA].geometry,
                           model_.nodes[visit.balls.nodeB].geometry, 0);
  }

  /// Two balls of the covers of two pieces of geometry. Open: stop testing these pieces.
  Found deep(const BallPair& balls) {
    const SimdNode& a = model_.nodes[balls.nodeA];
    const SimdNode& b = model_.nodes[balls.nodeB];
    const float insides = a.inside + b.inside;
    if (a.inside > 0.0F && b.inside > 0.0F && balls.squared < insides * insides &&
        contacts_.touches(pair_, a.inside, set3(balls.atA), b.inside, set3(balls.atB), kFirst))
      return Found::Contact;
    const SimdNode& parent = splitsFirst(a, b) ? a : b;
    const bool coarse = a.beyond + b.beyond > 0.5F * (extra_ - tube_);
    if (coarse && parent.childCount > 0 && --looks_ >= 0)
      return split(balls, [this](const BallPair& children) { return deep(children); });
    const float reach = a.radius + b.radius - 0.5F * (a.beyond + b.beyond);
    markUnresolved(block_, pair_, kFirst, coarse, set(reach - std::sqrt(balls.squared)));
    return Found::Open;
  }

  /// Tests one ball's children against the other ball, those not proven apart one after the other,
  /// until one of them is not Apart.
  template <typename Visit>
  Found split(const BallPair& balls, const Visit& visit) {
    const bool ofA = splitsFirst(model_.nodes[balls.nodeA], model_.nodes[balls.nodeB]);
    const SimdNode& parent = model_.nodes[ofA ? balls.nodeA : balls.nodeB];
    const SimdNode& other = model_.nodes[ofA ? balls.nodeB : balls.nodeA];
    const SimdBodyState& state = ofA ? *states_.a : *states_.b;
    const V3 rest = set3(ofA ? balls.atB : balls.atA);
    for (std::int32_t first = 0; first < parent.childCount; first += kLanes) {
      const SimdModel::Children& eight = model_.children[parent.childRow + first / kLanes];
      const V3 x = placedAt(state, 0, eight);
      const V3 between = rest - x;
      const F8 squared = dot(between, between);
      Lanes left = notApart(squared, load(eight.radius) + set(other.radius), set(extra_));
      left &= kAllLanes >> (kLanes - std::min(parent.childCount - first, kLanes));
      if (left == 0) continue;
      Row centers[3];
      Row squares;
      store3(x, centers);
      store(squared, squares);
      for (; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        BallPair children = balls;
        (ofA ? children.nodeA : children.nodeB) = parent.firstChild + first + lane;
        for (int i = 0; i < 3; ++i) (ofA ? children.atA : children.atB)[i] = centers[i].lane[lane];
        children.squared = squares.lane[lane];
        const Found found = visit(children);
        if (found != Found::Apart) return found;
      }
    }
    return Found::Apart;
  }

  const SimdModel& model_;
  SimdScratch& scratch_;
  SimdBlock& block_;
  const SelfTables tables_;
  SelfContacts contacts_;
  LinkStates states_;
  float tube_ = 0.0F;   ///< m, SimdBodyPair::tube
  float extra_ = 0.0F;  ///< m, that the balls of the pair of links must keep; rounding included
  int bodyPair_ = 0;
  std::uint32_t pair_ = 0;
  int looks_ = 0;
};

bool AllOfState(const SimdModel& model, SimdScratch& scratch) {
  return StateWalk(model, scratch).all();
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(AllOfState);

bool walkState(const SimdModel& model, SimdScratch& scratch) {
  return SWEPT_DISPATCH(AllOfState)(model, scratch);
}

}  // namespace swept::detail
#endif
