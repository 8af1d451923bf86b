// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

/// Names a registered box. The least number that is free is given out first, so the boxes of a
/// world that only grows are numbered as they came.
using BoxHandle = std::uint32_t;

/// What a broadphase takes a box for: itself, or all of space if it has a NaN or a lower above its
/// upper coordinate. Such a box bounds nothing, and it must not hide a contact. Infinite
/// coordinates are like any other.
inline Aabb boundedOrEverywhere(const Aabb& box) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return boundedOrEverywhere(box); });
  }
  int ordered = 1;
  for (int k = 0; k < 3; ++k) ordered &= static_cast<int>(box.lower[k] <= box.upper[k]);
  if (ordered != 0) return box;
  const auto all = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  return {-all, all};
}

/// m. Lower bound of the distance of two boxes, proven, and off by a few roundings; 0 exactly if
/// they overlap. Of what does not fit into a double: the largest one.
double boxDistance(const Aabb& a, const Aabb& b);

/// Memory that queries use again; one for each thread. Its content never matters. A visitor may ask
/// with the scratch of the query that visits; memory is then allocated, which another one spares.
struct BroadphaseScratch {
  /// What the search for the nearest has yet to look at.
  struct Candidate {
    double distance;      ///< m
    std::uint64_t order;  ///< at the same distance: blocks first, then boxes by handle
  };
  /// Two boxes; ordered as they are visited.
  struct Pair {
    double distance;  ///< m
    ///@{
    /// Within one broadphase a < b.
    BoxHandle a, b;
    ///@}
    /// By distance, then by a, then by b.
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<BoxHandle> handles;  ///< of boxes that overlap the one that is asked about
  std::vector<Candidate> nearest;  ///< what a search for the nearest has found and not visited
  std::vector<Pair> pairs;         ///< nearest first
};

/// Boxes that come, move and go, and which of them overlap. Touching counts.
///
/// What is visited, and in which order, depends on the boxes and their handles alone, not on how
/// they got there. A visitor that returns true stops the visit, and the function returns true.
/// Everything const may run in any number of threads. Visitors may ask again, and may change other
/// managers. One that changes the boxes it visits has to end the visit, by returning true or a
/// bound that nothing is nearer than; else std::logic_error. The change is made in either case.
/// Boxes may be the manager's own (`update(a, manager.box(b))`), and `other` the manager itself:
/// each box then meets itself, too.
///
/// - `registerBox(box)`, `registerBoxes(boxes)`, `unregisterBox(handle)`
/// - `update(handle, box)`, `update(handles, boxes)`; `updateAll(boxes)`: in the order of handles
/// - `collide(visitor)`: `visitor(a, b)` for each pair, a < b, in lexicographic order
/// - `collide(box, scratch, visitor)`: `visitor(a)` for each box that overlaps, ascending
/// - `collide(other, scratch, visitor)`: `visitor(a, b)`, a of this one and b of the other,
///   lexicographic
/// - `distance(box, scratch, visitor)`: `visitor(a, d)`, nearest first, and by handle if equally
///   near; d is `boxDistance`, m. What the visitor returns is a bound, m: from then on only boxes
///   nearer than the least bound so far are visited. Returns that, or infinity.
/// - `distance(scratch, visitor)`: `visitor(a, b, d)` for pairs, a < b, nearest first, and
///   lexicographic if equally near, so pairs that overlap come as in `collide`. What the visitor
///   returns is a bound of the same kind: the exact distance of what is in the boxes makes the
///   least one the exact distance of the nearest pair of all
/// - `distance(other, scratch, visitor)`: the same, a of this one and b of the other
///
/// A handle that is not in use, or a number of boxes that does not fit: std::invalid_argument, and
/// nothing has changed.
template <typename Manager>
concept Broadphase = requires(Manager manager, const Manager fixed, const Aabb box,
                              BoxHandle handle, std::span<const BoxHandle> handles,
                              std::span<const Aabb> boxes, BroadphaseScratch& scratch,
                              bool (*one)(BoxHandle), bool (*two)(BoxHandle, BoxHandle),
                              double (*near)(BoxHandle, double),
                              double (*nearPair)(BoxHandle, BoxHandle, double)) {
  { manager.registerBox(box) } -> std::same_as<BoxHandle>;
  { manager.registerBoxes(boxes) } -> std::same_as<std::vector<BoxHandle>>;
  manager.unregisterBox(handle);
  manager.update(handle, box);
  manager.update(handles, boxes);
  manager.updateAll(boxes);
  { fixed.size() } -> std::same_as<std::size_t>;
  { fixed.contains(handle) } -> std::same_as<bool>;
  { fixed.box(handle) } -> std::convertible_to<const Aabb&>;
  { fixed.collide(two) } -> std::same_as<bool>;
  { fixed.collide(box, scratch, one) } -> std::same_as<bool>;
  { fixed.collide(fixed, scratch, two) } -> std::same_as<bool>;
  { fixed.distance(box, scratch, near) } -> std::same_as<double>;
  { fixed.distance(scratch, nearPair) } -> std::same_as<double>;
  { fixed.distance(fixed, scratch, nearPair) } -> std::same_as<double>;
};

}  // namespace swept
