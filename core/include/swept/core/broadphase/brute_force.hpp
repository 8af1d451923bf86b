// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "swept/core/broadphase/broadphase.hpp"
#include "swept/core/broadphase/visits.hpp"
#include "swept/core/bv/aabb.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

/// The `Broadphase` that tests every box, or pair, in each query: a reference for the others, and
/// quick for a handful of boxes.
class BruteForce {
 public:
  ///@{
  /// See `Broadphase`; each takes time proportional to the number of boxes, or pairs.
  BoxHandle registerBox(const Aabb& box);
  std::vector<BoxHandle> registerBoxes(std::span<const Aabb> boxes);
  void unregisterBox(BoxHandle handle);

  void update(BoxHandle handle, const Aabb& box);
  void update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes);
  void updateAll(std::span<const Aabb> boxes);

  std::size_t size() const;
  bool contains(BoxHandle handle) const {
    return handle < boxes_.size() && boxes_[handle].has_value();
  }
  const Aabb& box(BoxHandle handle) const;  ///< m, see `boundedOrEverywhere`

  template <typename Visitor>
  bool collide(Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return collide(visitor); });
    }
    const detail::Unchanged unchanged(changes_);
    for (BoxHandle a = 0; a < boxes_.size(); ++a) {
      for (BoxHandle b = a + 1; b < boxes_.size(); ++b) {
        if (!contains(a) || !contains(b) || !boxes_[a]->overlaps(*boxes_[b])) continue;
        if (visitor(a, b)) return true;
        unchanged.require();
      }
    }
    return false;
  }

  template <typename Visitor>
  bool collide(const Aabb& box, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return collide(box, scratch, visitor); });
    }
    const detail::Unchanged unchanged(changes_);
    const Aabb bounded = boundedOrEverywhere(box);
    for (BoxHandle a = 0; a < boxes_.size(); ++a) {
      if (!contains(a) || !boxes_[a]->overlaps(bounded)) continue;
      if (visitor(a)) return true;
      unchanged.require();
    }
    return false;
  }

  template <typename Visitor>
  bool collide(const BruteForce& other, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return collide(other, scratch, visitor); });
    }
    const detail::Unchanged unchanged(changes_);
    for (BoxHandle a = 0; a < boxes_.size(); ++a) {
      if (!contains(a)) continue;
      const auto visitPair = [&](BoxHandle b) {
        if (visitor(a, b)) return true;
        unchanged.require();
        return false;
      };
      if (other.collide(*boxes_[a], scratch, visitPair)) return true;
    }
    return false;
  }

  template <typename Visitor>
  double distance(const Aabb& box, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return distance(box, scratch, visitor); });
    }
    sortByDistance(box, scratch);
    const detail::Unchanged unchanged(changes_);
    detail::Lent nearest(scratch.nearest);
    double bound = std::numeric_limits<double>::infinity();
    for (const BroadphaseScratch::Candidate& next : nearest.items()) {
      if (!(next.distance < bound)) break;
      const double enough = visitor(static_cast<BoxHandle>(next.order), next.distance);
      if (enough < bound) bound = enough;
      if (next.distance < bound) unchanged.require();
    }
    return bound;
  }

  template <typename Visitor>
  double distance(BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return distance(scratch, visitor); });
    }
    scratch.pairs.clear();
    for (BoxHandle a = 0; a < boxes_.size(); ++a) {
      for (BoxHandle b = a + 1; b < boxes_.size(); ++b)
        if (contains(a) && contains(b)) addPair(a, b, *boxes_[b], scratch);
    }
    return visitPairs(*this, scratch, visitor);
  }

  template <typename Visitor>
  double distance(const BruteForce& other, BroadphaseScratch& scratch, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return distance(other, scratch, visitor); });
    }
    scratch.pairs.clear();
    for (BoxHandle a = 0; a < boxes_.size(); ++a) {
      for (BoxHandle b = 0; b < other.boxes_.size(); ++b)
        if (contains(a) && other.contains(b)) addPair(a, b, *other.boxes_[b], scratch);
    }
    return visitPairs(other, scratch, visitor);
  }
  ///@}

 private:
  void require(BoxHandle handle) const;
  void sortByDistance(const Aabb& box, BroadphaseScratch& scratch) const;
  void addPair(BoxHandle a, BoxHandle b, const Aabb& boxB, BroadphaseScratch& scratch) const {
    scratch.pairs.push_back({boxDistance(*boxes_[a], boxB), a, b});
  }
  template <typename Visitor>
  double visitPairs(const BruteForce& other, BroadphaseScratch& scratch, Visitor&& visitor) const {
    std::sort(scratch.pairs.begin(), scratch.pairs.end());
    const detail::Unchanged unchanged(changes_), otherUnchanged(other.changes_);
    detail::Lent pairs(scratch.pairs);
    double bound = std::numeric_limits<double>::infinity();
    for (const BroadphaseScratch::Pair& next : pairs.items()) {
      if (!(next.distance < bound)) break;
      const double enough = visitor(next.a, next.b, next.distance);
      if (enough < bound) bound = enough;
      if (!(next.distance < bound)) continue;
      unchanged.require();
      otherUnchanged.require();
    }
    return bound;
  }

  std::vector<std::optional<Aabb>> boxes_;
  detail::ChangeCount changes_;
};

}  // namespace swept
