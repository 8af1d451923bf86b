// SPDX-License-Identifier: BSD-3-Clause
// Balls of covers against clearance fields. Included once per instruction set.
#if defined(SWEPT_SIMD_FIELD_WALK) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEPT_SIMD_FIELD_WALK
#undef SWEPT_SIMD_FIELD_WALK
#else
#define SWEPT_SIMD_FIELD_WALK
#endif

#include <bit>
#include <cstdint>

#include "simd/kernels/exact_oracle.hpp"
#include "simd/kernels/f8.hpp"
#include "simd/kernels/obstacle_kernels.hpp"
#include "simd/kernels/placed_ball.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {

class FieldWalk {
 public:
  FieldWalk(const SimdModel& model, SimdScratch& scratch)
      : model_(model), scratch_(scratch), block_(scratch.block) {}

  void clear() { scratch_.queries.clear(); }

  /// A ball and the lanes in which it is not proven apart yet. Leaves that only a query can settle
  /// are postponed: if something else is in contact, they need no query. Adds to the hits those
  /// that the children of a node that `divides` must test; `final`: shorter intervals would not
  /// help. True: the walk is over.
  bool visit(const SimdNode& node, const Segment& segment, const F8& radius, SimdHit hit,
             std::uint32_t pair, bool divides, bool final) {
    const std::int32_t index = model_.obstacles.obstacles[hit.index].first;
    const SimdField& field = model_.obstacles.fields[index];
    const FieldAnswer answer = askField(field, segment, radius, hit.lanes);
    hit.lanes &= ~answer.apart;
    if (hit.lanes == 0) return false;
    if (node.inside > 0.0F && touches(node, segment, field, answer.middle, hit.lanes, pair))
      return true;
    hit.lanes &= ~block_.contactLanes;
    if (hit.lanes == 0) return false;
    if (divides) {
      // A query that succeeds spares all balls below the node.
      const Lanes worth = hit.lanes & answer.worthQuery;
      if (node.geometry >= 0 && worth != 0 && scratch_.queries.size() < kMostQueries) {
        postpone(node, segment, radius, {hit.index, worth}, pair, true, final, answer, set(0.0F));
        hit.lanes &= ~worth;
      }
      if (hit.lanes != 0) scratch_.hits.push_back(hit);
      return false;
    }
    // A field's value may be up to about a cell less than the distance.
    const F8 depths = set(node.radius - 0.5F * node.beyond - field.cell) - answer.middle;
    if (scratch_.queries.size() < kMostQueries && (hit.lanes & ~answer.worthQuery) != hit.lanes) {
      const Lanes worth = hit.lanes & answer.worthQuery;
      postpone(node, segment, radius, {hit.index, worth}, pair, false, final, answer, depths);
      hit.lanes &= ~worth;
    }
    if (hit.lanes != 0) markUnresolved(block_, pair, hit.lanes, final, depths);
    return false;
  }

  /// Tests balls inside the link against the field's shape, in the lane in which the link's centre
  /// seems nearest to it. True: the walk is over.
  bool probe(const SimdNode& node, const V3& middle, float within, const SimdBodyState& state,
             const SimdHit& hit, std::uint32_t pair) {
    const SimdField& field = model_.obstacles.fields[model_.obstacles.obstacles[hit.index].first];
    const F8 near = set(within);
    const F8 bounds = clearance(field, inFrame(field, middle, true), near, hit.lanes);
    const Lanes lanes = hit.lanes & below(bounds, near);
    if (lanes == 0) return false;
    const int best = lowestLane(bounds, lanes);
    const SimdModel::InnerBalls& probes = model_.probesOf[node.geometry];
    for (std::int32_t i = probes.first; i < probes.first + probes.count; ++i) {
      const SimdModel::Probes& eight = model_.probes[i];
      const V3 x = placedAt(state, best, eight);
      const F8 inside = load(eight.inside) - set(scratch_.rounding);
      const F8 away = clearance(field, inFrame(field, x, true), inside, kAllLanes);
      const Lanes deep = above(inside, set(0.0F)) & below(away, inside - set(0.25F * field.cell));
      if (deep == 0) continue;
      const int which = lowestLane(away - inside, deep);
      Row at[3];
      Row radii;
      Row bound;
      store3(x, at);
      store(inside, radii);
      store(away, bound);
      const Row still[3] = {};
      const MovingPoint center = pointOf(at, still, which);
      if (!reaches(field, center, radii.lane[which], bound.lane[which] > 0.0F)) continue;
      return claim(block_, pair, 1U << best, set3(center.x), radii.lane[which]);
    }
    return false;
  }

  /// Answers the postponed queries. `divide(node, hit)` visits the balls below a node whose query
  /// failed, and may postpone more. True: the walk is over.
  template <typename Divide>
  bool settle(const Divide& divide) {
    for (std::size_t i = 0; i < scratch_.queries.size(); ++i) {
      const SimdQuery& query = scratch_.queries[i];
      Lanes left = query.lanes & ~block_.contactLanes;
      left &= ~static_cast<Lanes>(block_.openLanes[query.pair]);
      if (left == 0) continue;
      const SimdNode& node = model_.nodes[query.node];
      if (query.divides) {
        Lanes open = 0;
        for (; left != 0; left &= left - 1)
          if (!settled(query, std::countr_zero(left))) open |= left & -left;
        if (open != 0 && divide(node, SimdHit{query.obstacle, open})) return true;
        continue;
      }
      // If one stays open, the pair stays open: the others are not worth the time.
      while (left != 0 && settledOrProven(query, std::countr_zero(left))) left &= left - 1;
      if (left != 0) markUnresolved(block_, query.pair, left, query.final, load(query.depth));
    }
    return false;
  }

 private:
  void postpone(const SimdNode& node, const Segment& segment, const F8& radius, const SimdHit& hit,
                std::uint32_t pair, bool divides, bool final, const FieldAnswer& answer,
                const F8& depths) {
    SimdQuery& query = scratch_.queries.emplace_back();
    query.node = static_cast<std::int32_t>(&node - &model_.nodes[0]);
    query.obstacle = hit.index;
    query.pair = pair;
    query.lanes = hit.lanes;
    query.outside = above(answer.middle, set(0.0F));
    query.final = final;
    query.divides = divides;
    store3(segment.x, query.x);
    store3(segment.g, query.g);
    store(radius, query.radius);
    store(depths, query.depth);
  }

  /// What the ball cannot prove, the link itself may.
  bool settledOrProven(const SimdQuery& query, int lane) const {
    if (settled(query, lane)) return true;
    return query.final && scratch_.oracle != nullptr &&
           scratch_.oracle->staysApart(query.pair, static_cast<double>(block_.time.lane[lane]),
                                       static_cast<double>(block_.half.lane[lane]),
                                       pointOf(query.x, query.g, lane), reachOf(query, lane));
  }

  /// m, around the segment: what is farther is apart from the ball.
  double reachOf(const SimdQuery& query, int lane) const {
    const SimdField& field =
        model_.obstacles.fields[model_.obstacles.obstacles[query.obstacle].first];
    return static_cast<double>(query.radius.lane[lane]) + static_cast<double>(field.slack);
  }

  bool settled(const SimdQuery& query, int lane) const {
    const SimdField& field =
        model_.obstacles.fields[model_.obstacles.obstacles[query.obstacle].first];
    const bool outside = (query.outside >> lane & 1U) != 0;
    return isApart(field, pointOf(query.x, query.g, lane), query.radius.lane[lane], outside);
  }

  /// Tests a ball inside the link against the field's shape: in the first lane, a query confirms
  /// contact. `bounds`: m, on the distance.
  bool touches(const SimdNode& node, const Segment& segment, const SimdField& field,
               const F8& bounds, Lanes lanes, std::uint32_t pair) {
    if (!block_.stopAtContact) return false;
    const float within = node.inside - scratch_.rounding;
    if (!(within > 0.0F)) return false;
    const Lanes outside = above(bounds, set(0.0F));
    // Not certain, but a query costs less than an open pair.
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

  /// Largest number of postponed leaves: a query takes as long as several nodes.
  static constexpr std::size_t kMostQueries = 256;

  const SimdModel& model_;
  SimdScratch& scratch_;
  SimdBlock& block_;
};

}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
