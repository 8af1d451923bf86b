// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/leaf_contact.hpp"

#include <algorithm>
#include <limits>

#include "narrowphase/convex_pair.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Cap on the steps. Smooth contacts take four or five.
constexpr int kMaxSteps = 12;

}  // namespace

/// Points in a's frame.
GjkResult LeafContact::measure(const OpenPair& pair, const RelativeState& state,
                               const Vector3d& guess) const {
  const PiecePair pieces(a_, b_, state.a_from_b);
  PiecePair::Leaves leaves;
  pieces.place(pieces.piece(true, pair.placeA), pieces.piece(false, pair.placeB), leaves);
  const Goal unreachable(std::numeric_limits<double>::infinity());
  GjkResult gap = convexPair(leaves.a, leaves.b, leaves.a_from_b, guess, unreachable, margin_,
                             accuracy_, GjkMode::Exact);
  gap.pointA += leaves.centerA;
  gap.pointB += leaves.centerA;
  return gap;
}

// A step that ends in contact passed the first contact by at most what the acceleration can do
// during the step. That far back the leaves are apart again, as long as their normal is one
// direction, and a step from there ends nearer by that much.
std::optional<LeafContact::Found> LeafContact::find(const OpenPair& pair, const Range& range,
                                                    ContinuousEffort& effort) const {
  std::optional<Found> found;
  Vector3d normal = pair.direction.cast<double>();
  bool touching = range.touching;
  double from = range.from, to = range.to;
  double t = from, passed = to - from;
  for (int step = 0; step < kMaxSteps; ++step) {
    const RelativeState state = motion_.at(t);
    const GjkResult gap = measure(pair, state, normal);
    ++effort.leafTests;
    if (gap.upper <= margin_) {
      found = Found{t, state.world_from_a, gap.pointA, gap.pointB};
      touching = true;
      to = t;
      passed = std::min(0.5 * (to - from), passed);
      if (passed <= 0.5 * range.resolution) break;
      t = to - passed;
      continue;
    }
    from = t;
    normal = gap.normal;
    const double closing = state.closing(normal, gap.pointA);
    const double length = (gap.upper - margin_) / closing;
    const double next = from + length + 0.25 * range.resolution;
    if (closing > 0.0 && next < to) {
      passed = range.bend * length * length / closing;
      t = next;
    } else if (touching && !(found && to - from <= range.resolution)) {
      passed = 0.5 * (to - from);
      t = 0.5 * (from + to);
    } else {
      break;
    }
  }
  return found;
}

}  // namespace swept::detail
