// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "swept/core/broadphase/broadphase.hpp"
#include "swept/core/broadphase/visits.hpp"
#include "swept/core/bv/aabb.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

/// The `Broadphase` for many boxes; `BruteForce` gives the same answers.
///
/// It relies on coherence. Each box has a larger box around it, its room, which is larger the
/// faster the box moves. The boxes whose rooms overlap are remembered. A box that stays in its room
/// costs only a test of those few. A tree finds the rooms that overlap; a box that left its room
/// goes to a small separate part of the tree for a while. If many boxes leave at once, everything
/// is rebuilt. The pairs are kept sorted and up to date after every change.
///
/// Exact: rooms only add candidates, and the boxes themselves decide, in double. An update
/// allocates nothing if there was enough memory before. Throws std::length_error for more than 2^30
/// boxes, or 2^32 entries in their lists of near boxes, where a pair takes at least two.
class SweepAndPrune {
 public:
  SweepAndPrune();
  ~SweepAndPrune();
  SweepAndPrune(SweepAndPrune&& other) noexcept;
  SweepAndPrune& operator=(SweepAndPrune&& other) noexcept;
  SweepAndPrune(const SweepAndPrune& other);
  SweepAndPrune& operator=(const SweepAndPrune& other);

  /// See `Broadphase`.
  BoxHandle registerBox(const Aabb& box);
  /// Much cheaper than one by one. The handles are in the order of the boxes.
  std::vector<BoxHandle> registerBoxes(std::span<const Aabb> boxes);
  /// See `Broadphase`.
  void unregisterBox(BoxHandle handle);

  /// See `Broadphase`.
  void update(BoxHandle handle, const Aabb& box);
  /// If a handle comes twice, its last box counts.
  void update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes);
  /// See `Broadphase`.
  void updateAll(std::span<const Aabb> boxes);

  /// Number of registered boxes.
  std::size_t size() const;
  /// Whether the handle is in use.
  bool contains(BoxHandle handle) const;
  const Aabb& box(BoxHandle handle) const;  ///< m, see `boundedOrEverywhere`
  std::size_t bytes() const;                ///< on the heap

  /// See `Broadphase`. The pairs are known already: the time is proportional to their number.
  template <typename Visitor>
  bool collide(Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return collide(visitor); });
    }
    const Pairs pairs = this->pairs();
    const detail::Unchanged unchanged(changes_);
    auto from = pairs.sorted.begin();
    for (const std::uint64_t changed : pairs.changed) {
      for (; from != pairs.sorted.end() && *from < changed; ++from)
        if (visit(*from, unchanged, visitor)) return true;
      if (from != pairs.sorted.end() && *from == changed)
        ++from;
      else if (visit(changed, unchanged, visitor))
        return true;
    }
    for (; from != pairs.sorted.end(); ++from)
      if (visit(*from, unchanged, visitor)) return true;
    return false;
  }

  /// See `Broadphase`.
  template <typename Visitor>
  bool collide(const Aabb& box, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return collide(box, scratch, visitor); });
    }
    findOverlapping(box, scratch);
    const detail::Unchanged unchanged(changes_);
    detail::Lent handles(scratch.handles);
    for (const BoxHandle handle : handles.items()) {
      if (visitor(handle)) return true;
      unchanged.require();
    }
    return false;
  }

  /// See `Broadphase`: a search in `other` for each box.
  template <typename Visitor>
  bool collide(const SweepAndPrune& other, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return collide(other, scratch, visitor); });
    }
    const detail::Unchanged unchanged(changes_);
    for (BoxHandle handle = 0; handle < handleEnd(); ++handle) {
      if (!contains(handle)) continue;
      const auto visitPair = [&](BoxHandle found) {
        if (visitor(handle, found)) return true;
        unchanged.require();
        return false;
      };
      if (other.collide(box(handle), scratch, visitPair)) return true;
    }
    return false;
  }

  /// See `Broadphase`.
  template <typename Visitor>
  double distance(const Aabb& box, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return distance(box, scratch, visitor); });
    }
    double bound = std::numeric_limits<double>::infinity();
    Near near;
    const detail::Unchanged unchanged(changes_);
    detail::Lent heap(scratch.nearest);
    startNearest(heap.items());
    while (nextNearest(box, bound, heap.items(), near)) {
      const double enough = visitor(near.handle, near.distance);
      if (enough < bound) bound = enough;
      if (!(near.distance < bound)) break;  // the next ones are no nearer
      unchanged.require();
    }
    return bound;
  }

  /// See `Broadphase`. Overlapping pairs take no memory; the others up to eight times that of the
  /// visited ones.
  template <typename Visitor>
  double distance(BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return distance(scratch, visitor); });
    }
    double bound = std::numeric_limits<double>::infinity();
    const auto visitPair = [&](BoxHandle a, BoxHandle b) {
      return !visitNear({0.0, a, b}, bound, visitor);
    };
    if (!collide(visitPair)) visitApart(nullptr, bound, scratch, visitor);
    return bound;
  }

  /// See `Broadphase`; memory as above.
  template <typename Visitor>
  double distance(const SweepAndPrune& other, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return distance(other, scratch, visitor); });
    }
    double bound = std::numeric_limits<double>::infinity();
    const auto visitPair = [&](BoxHandle a, BoxHandle b) {
      return !visitNear({0.0, a, b}, bound, visitor);
    };
    if (!collide(other, scratch, visitPair)) visitApart(&other, bound, scratch, visitor);
    return bound;
  }

 private:
  class State;
  /// `sorted`, corrected by `changed`: a pair in `changed` overlaps exactly if it is not in
  /// `sorted`.
  struct Pairs {
    std::span<const std::uint64_t> sorted, changed;
  };
  struct Near {
    BoxHandle handle;
    double distance;  ///< m
  };

  template <typename Visitor>
  static bool visit(std::uint64_t pair, const detail::Unchanged& unchanged, Visitor&& visitor) {
    if (visitor(static_cast<BoxHandle>(pair >> 32), static_cast<BoxHandle>(pair))) return true;
    unchanged.require();
    return false;
  }
  /// Visits this pair; returns whether pairs as near as this one still matter.
  template <typename Visitor>
  static bool visitNear(const BroadphaseScratch::Pair& pair, double& bound, Visitor&& visitor) {
    const double enough = visitor(pair.a, pair.b, pair.distance);
    if (enough < bound) bound = enough;
    return pair.distance < bound;
  }
  /// Visits the pairs that do not overlap; if `other` is null, of these boxes among themselves. It
  /// finds more pairs at a time the more there have been, since each search starts over.
  template <typename Visitor>
  void visitApart(const SweepAndPrune* other, double& bound, BroadphaseScratch& scratch,
                  Visitor&& visitor) const {
    constexpr BoxHandle kLast = std::numeric_limits<BoxHandle>::max();
    const detail::Unchanged unchanged(changes_);
    const detail::Unchanged otherUnchanged(other == nullptr ? changes_ : other->changes_);
    detail::Lent pairs(scratch.pairs);
    BroadphaseScratch::Pair after{0.0, kLast, kLast};
    for (std::size_t most = 32; 0.0 < bound; most *= 8) {
      findNearestPairs(other, after, bound, most, pairs.items());
      for (const BroadphaseScratch::Pair& pair : pairs.items()) {
        if (!(pair.distance < bound) || !visitNear(pair, bound, visitor)) return;
        unchanged.require();
        otherUnchanged.require();
      }
      if (pairs.items().size() < most) return;
      after = pairs.items().back();
    }
  }
  Pairs pairs() const;
  BoxHandle handleEnd() const;  ///< all handles in use are below
  void findOverlapping(const Aabb& box, BroadphaseScratch& scratch) const;
  void startNearest(std::vector<BroadphaseScratch::Candidate>& heap) const;
  /// The next box that is nearer than the bound; false if there is none.
  bool nextNearest(const Aabb& box, double bound, std::vector<BroadphaseScratch::Candidate>& heap,
                   Near& near) const;
  /// The first `most` pairs after this one that are nearer than the bound, in their order.
  void findNearestPairs(const SweepAndPrune* other, const BroadphaseScratch::Pair& after,
                        double bound, std::size_t most,
                        std::vector<BroadphaseScratch::Pair>& pairs) const;

  std::unique_ptr<State> state_;
  detail::ChangeCount changes_;
};

}  // namespace swept
