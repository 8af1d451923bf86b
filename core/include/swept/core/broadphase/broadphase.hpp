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

/// Names a registered box. The least free number is given out first, so the boxes of a world that
/// only grows are numbered in order.
using BoxHandle = std::uint32_t;

/// The box that a broadphase uses for `box`: itself, or all of space if it has a NaN or a lower
/// above its upper coordinate. Such a box bounds nothing, and must not hide a contact. Infinite
/// coordinates are allowed.
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

/// m. Proven lower bound of the distance of two boxes, off by a few roundings; 0 exactly if they
/// overlap. If it does not fit into a double: the largest double.
double boxDistance(const Aabb& a, const Aabb& b);

/// Memory that queries reuse; one per thread. Its content never matters. A visitor may start a
/// query with the scratch of the query that calls it; that allocates memory, which a second scratch
/// avoids.
struct BroadphaseScratch {
  /// What the search for the nearest box has yet to visit.
  struct Candidate {
    double distance;      ///< m
    std::uint64_t order;  ///< at equal distance: blocks first, then boxes by handle
  };
  /// Two boxes, ordered as they are visited.
  struct Pair {
    double distance;  ///< m
    ///@{
    /// Within one broadphase a < b.
    BoxHandle a, b;
    ///@}
    /// By distance, then by a, then by b.
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<BoxHandle> handles;  ///< boxes that overlap the query box
  std::vector<Candidate> nearest;  ///< found by a search for the nearest, and not yet visited
  std::vector<Pair> pairs;         ///< nearest first
};

/// Boxes that are added, moved and removed, and the pairs that overlap. Touching counts.
///
/// What is visited, and in which order, depends only on the boxes and their handles, not on their
/// history. A visitor that returns true stops the visit, and the function returns true. Const
/// functions may run in any number of threads. Visitors may start other queries, and may change
/// other managers. A visitor that changes the boxes it visits must end the visit, by returning true
/// or a bound that nothing is nearer than; otherwise the query throws std::logic_error. The change
/// is made in either case. Boxes may be the manager's own (`update(a, manager.box(b))`), and
/// `other` may be the manager itself: each box then also meets itself.
///
/// - `registerBox(box)`, `registerBoxes(boxes)`, `unregisterBox(handle)`
/// - `update(handle, box)`, `update(handles, boxes)`; `updateAll(boxes)`: in the order of handles
/// - `collide(visitor)`: `visitor(a, b)` for each pair, a < b, in lexicographic order
/// - `collide(box, scratch, visitor)`: `visitor(a)` for each box that overlaps, ascending
/// - `collide(other, scratch, visitor)`: `visitor(a, b)`, a of this one and b of the other,
///   lexicographic
/// - `distance(box, scratch, visitor)`: `visitor(a, d)`, nearest first, and by handle if equally
/// near; d is `boxDistance`, m. The visitor returns a bound, m: from then on only boxes nearer than
/// the least bound so far are visited. Returns that bound, or infinity.
/// - `distance(scratch, visitor)`: `visitor(a, b, d)` for pairs, a < b, nearest first, and
/// lexicographic if equally near, so overlapping pairs come as in `collide`. The visitor returns a
/// bound of the same kind. If it returns the exact distance of the contents of the boxes, the least
/// bound is the exact distance of the nearest pair of all
/// - `distance(other, scratch, visitor)`: the same, a of this manager and b of the other
///
/// Each function throws std::invalid_argument for a handle that is not in use, or a wrong number of
/// boxes, and then has changed nothing.
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
